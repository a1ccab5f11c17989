#include "methods/reference/field_chord.h"

namespace volumark {

Cubic along_chord(const Lattice::Corners& corner, const glm::dvec3& start, const glm::dvec3& change) {
  double x0[4], x1[4];  // after interpolation along x: x0 + x1 u, for each (y, z)
  for (size_t k = 0; k < 4; ++k) {
    const double difference = corner[2 * k + 1] - corner[2 * k];
    x0[k] = corner[2 * k] + difference * start.x;
    x1[k] = difference * change.x;
  }
  double y0[2], y1[2], y2[2];
  for (size_t k = 0; k < 2; ++k) {
    const double d0 = x0[2 * k + 1] - x0[2 * k], d1 = x1[2 * k + 1] - x1[2 * k];
    y0[k] = x0[2 * k] + d0 * start.y;
    y1[k] = x1[2 * k] + d1 * start.y + d0 * change.y;
    y2[k] = d1 * change.y;
  }
  const double d0 = y0[1] - y0[0], d1 = y1[1] - y1[0], d2 = y2[1] - y2[0];
  return {y0[0] + d0 * start.z, y1[0] + d1 * start.z + d0 * change.z, y2[0] + d2 * start.z + d1 * change.z,
          d2 * change.z};
}

}  // namespace volumark
