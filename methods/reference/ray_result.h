// What a ray shows, and how wrong that may be.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

namespace volumark {

struct RayResult {
  glm::dvec3 rgb{0};  // premultiplied
  double alpha = 0;
  double bound = 0;  // of each channel
  std::optional<double>
      distance;  // along the ray, of the one point that it shows; nothing where it shows many, or none
  int64_t cells = 0, pieces = 0;
};

}  // namespace volumark
