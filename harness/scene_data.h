// What a scene shows as one lattice of samples, whether they stand in a volume or in the texture of a shell.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "scenes/scene.h"

namespace volumark {

struct SceneData {
  glm::ivec3 size{0};   // samples along each axis; 0: not loaded
  std::string type;     // "u8", ...; "rgba32f" of a shell's texture; empty: not loaded
  int64_t bytes = 0;    // of all samples
  double diameter = 0;  // diagonal of the volume's box or of the shell's bounds, world units
};
SceneData data_of(const Scene& scene);

}  // namespace volumark
