#include "scenes/scene.h"

namespace volumark {

std::vector<std::string> effect_names(const Effects& effects) {
  std::vector<std::string> names;
  if (effects.lighting) names.emplace_back("lighting");
  if (!effects.clip_planes.empty()) names.emplace_back("clip_planes");
  return names;
}

}  // namespace volumark
