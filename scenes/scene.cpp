#include "scenes/scene.h"

#include <algorithm>

namespace volumark {

std::vector<std::string> effect_names(const Effects& effects) {
  std::vector<std::string> names;
  if (effects.lighting) names.emplace_back("lighting");
  if (!effects.clip_planes.empty()) names.emplace_back("clip_planes");
  return names;
}

double gradient_floor(const Lighting& lighting, const TransferFunction& transfer, const Volume& volume) {
  const double smallest = std::min({volume.spacing.x, volume.spacing.y, volume.spacing.z});
  return lighting.gradient_floor * (transfer.hi - transfer.lo) / smallest;
}

}  // namespace volumark
