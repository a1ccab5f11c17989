// One prism of a shell (scenes/shell.h) in double precision: where a ray passes through it, and the coordinates of a
// point in it.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "scenes/scene.h"

namespace volumark {

// (b_1, b_2, w) of the map X(b, w) = p_0 + b_1 (p_1 - p_0) + b_2 (p_2 - p_0) + w (d_0 + b_1 (d_1 - d_0) + ...).
using PrismPoint = glm::dvec3;

class PrismMap {
 public:
  // Corners 0..2 of the triangle, 3..5 of the offset triangle; the map keeps the sign of its Jacobian.
  explicit PrismMap(const std::array<glm::dvec3, 6>& corners);

  glm::dvec3 at(const PrismPoint& point) const;
  // Columns: derivatives of X by b_1, b_2 and w.
  glm::dmat3 jacobian(const PrismPoint& point) const;

  // How far the point of the map nearest to `position` lies inside: the least of b_0, b_1, b_2, w and 1 - w, negative
  // outside. `point` is where; unchanged where the position is not on any of the triangles at heights 0..1.
  double locate(const glm::dvec3& position, PrismPoint& point) const;
  // Newton's method from `point`, which lies near. False where it does not converge to a point of the prism.
  bool refine(const glm::dvec3& position, PrismPoint& point) const;

  // Appends the distances at which the ray meets a face of the prism. There may be others among them, never fewer: a
  // face that the ray runs along apart.
  void append_crossings(const Ray& ray, std::vector<double>& t) const;

 private:
  void append_side(const Ray& ray, int i, int j, std::vector<double>& t) const;

  std::array<glm::dvec3, 3> p_, d_;
  glm::dvec3 e1_, e2_, g1_, g2_;  // p_i - p_0, d_i - d_0
};

// What the six corners of a prism have, at a point: sum_i b_i ((1 - w) lower_i + w upper_i).
template <class T>
T over_prism(const std::array<T, 6>& corner, const PrismPoint& point) {
  const double b0 = 1 - point.x - point.y, up = point.z, down = 1 - up;
  return (b0 * down) * corner[0] + (point.x * down) * corner[1] + (point.y * down) * corner[2] + (b0 * up) * corner[3] +
         (point.x * up) * corner[4] + (point.y * up) * corner[5];
}

}  // namespace volumark
