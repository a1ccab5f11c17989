// Walks a ray through a regular grid, plane crossings computed as (plane - origin) / direction and never accumulated.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <limits>

namespace volumark {

struct GridRay {
  glm::dvec3 origin, direction;  // index space
};

// Visits, front to back, the boxes of edge `unit` with indices in [first, last] that the ray meets for t in [t0, t1]:
// visit(box, t_enter, t_leave) -> false to stop. Returns false when stopped. Boxes met in a single point are left out.
template <typename Visit>
bool walk_grid(const GridRay& ray, int unit, const glm::ivec3& first, const glm::ivec3& last, double t0, double t1,
               Visit&& visit) {
  glm::ivec3 box;
  double next[3];
  auto crossing = [&](int a) {
    const double d = ray.direction[a];
    if (d == 0) return std::numeric_limits<double>::infinity();
    const double plane = static_cast<double>(unit) * (box[a] + (d > 0 ? 1 : 0));
    return (plane - ray.origin[a]) / d;
  };
  for (int a = 0; a < 3; ++a) {
    const double at = std::floor((ray.origin[a] + t0 * ray.direction[a]) / unit);
    box[a] = static_cast<int>(std::clamp(at, static_cast<double>(first[a]), static_cast<double>(last[a])));
    next[a] = crossing(a);
  }
  double t = t0;
  while (t < t1) {
    const int a = next[0] <= next[1] ? (next[0] <= next[2] ? 0 : 2) : (next[1] <= next[2] ? 1 : 2);
    const double leave = std::min(next[a], t1);
    if (leave > t) {
      if (!visit(box, t, leave)) return false;
      t = leave;
    }
    box[a] += ray.direction[a] > 0 ? 1 : -1;
    // Beyond the grid only by rounding of t1: stay in the border box for the rest of the ray.
    if (box[a] < first[a] || box[a] > last[a]) {
      box[a] = std::clamp(box[a], first[a], last[a]);
      next[a] = std::numeric_limits<double>::infinity();
    } else {
      next[a] = crossing(a);
    }
  }
  return true;
}

}  // namespace volumark
