#include "harness/scene_data.h"

#include <glm/geometric.hpp>

#include "scenes/shell.h"

namespace volumark {

SceneData data_of(const Scene& scene) {
  if (scene.volume) {
    const Volume& volume = *scene.volume;
    return {volume.size, to_string(volume.type), static_cast<int64_t>(volume.voxels.size()),
            glm::length(volume.extent())};
  }
  if (scene.shell) {
    const ShellTexture& texture = *scene.shell->colours;
    const ShellBounds bounds = bounds_of(*scene.shell);
    return {texture.size, "rgba32f", static_cast<int64_t>(texture.texels.size() * sizeof(glm::vec4)),
            glm::length(bounds.hi - bounds.lo)};
  }
  return {};
}

}  // namespace volumark
