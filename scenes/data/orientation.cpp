#include "scenes/data/orientation.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "scenes/errors.h"

namespace volumark {

glm::dmat3 orthonormal(const glm::dmat3& columns) {
  const glm::dvec3 x = glm::normalize(columns[0]);
  const glm::dvec3 y = glm::normalize(columns[1] - x * glm::dot(x, columns[1]));
  const glm::dvec3 z = glm::cross(x, y);
  return {x, y, glm::dot(z, columns[2]) < 0 ? -z : z};
}

void set_steps(Volume& volume, const glm::dmat3& steps, const std::string& what) {
  glm::dmat3 unit(1);
  for (int a = 0; a < 3; ++a) {
    const double length = glm::length(steps[a]);
    if (!(length > 1e-30) || !(length < 1e30)) {
      throw DataError(fmt::format("{}: the step along axis {} is ({}, {}, {}): expected a finite one that is not zero",
                                  what, a, steps[a].x, steps[a].y, steps[a].z));
    }
    volume.spacing[a] = length;
    unit[a] = steps[a] / length;
  }
  for (int a = 0; a < 3; ++a) {
    const double cosine = glm::dot(unit[a], unit[(a + 1) % 3]);
    if (std::abs(cosine) > 1e-3) {
      throw DataError(
          fmt::format("{}: axes {} and {} are not at right angles (cosine {:.4g}): sheared lattices are not "
                      "supported; resample the volume",
                      what, a, (a + 1) % 3, cosine));
    }
  }
  volume.axes = orthonormal(unit);
}

void centre_at_origin(Volume& volume) {
  volume.origin = -(volume.axes * (volume.spacing * glm::dvec3(volume.size - 1) * 0.5));
}

}  // namespace volumark
