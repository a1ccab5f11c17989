#include "scenes/prism_faults.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace volumark {
namespace {

// c0 + c1 w + c2 w^2 on [0, 1], with a bound on the rounding in it.
struct Quadratic {
  double c0, c1, c2, error;
};

// N(w) . d with N(w) = (e1 + w f1) x (e2 + w f2).
Quadratic volume_density(const glm::dvec3& e1, const glm::dvec3& f1, const glm::dvec3& e2, const glm::dvec3& f2,
                         const glm::dvec3& d) {
  const double largest1 = glm::length(e1) + glm::length(f1), largest2 = glm::length(e2) + glm::length(f2);
  // Differences, two products and sums of a few terms each: below 32 roundings of the largest term.
  const double error = 32 * std::numeric_limits<double>::epsilon() * largest1 * largest2 * glm::length(d);
  return {glm::dot(glm::cross(e1, e2), d), glm::dot(glm::cross(e1, f2) + glm::cross(f1, e2), d),
          glm::dot(glm::cross(f1, f2), d), error};
}

// The least of sign * q over [0, 1], less the error of q.
double least_of(const Quadratic& q, double sign) {
  const double c0 = sign * q.c0, c1 = sign * q.c1, c2 = sign * q.c2;
  double least = std::min(c0, c0 + c1 + c2);
  if (c2 > 0 && c1 < 0 && -c1 < 2 * c2) least = std::min(least, c0 - c1 * c1 / (4 * c2));
  return least - q.error;
}

bool has_volume(const std::array<glm::dvec3, 3>& lower, const std::array<glm::dvec3, 3>& upper) {
  const glm::dvec3 e1 = lower[1] - lower[0], e2 = lower[2] - lower[0];
  const glm::dvec3 g1 = upper[1] - upper[0], g2 = upper[2] - upper[0];
  for (size_t i = 0; i < 3; ++i) {
    const Quadratic q = volume_density(e1, g1 - e1, e2, g2 - e2, upper[i] - lower[i]);
    const double largest = std::max({std::abs(q.c0), std::abs(q.c0 + q.c1 / 2), std::abs(q.c0 + q.c1 + q.c2)});
    if (largest > q.error) return true;
  }
  return false;
}

}  // namespace

int jacobian_sign(const std::array<glm::dvec3, 3>& lower, const std::array<glm::dvec3, 3>& upper) {
  const glm::dvec3 e1 = lower[1] - lower[0], e2 = lower[2] - lower[0];
  const glm::dvec3 f1 = (upper[1] - upper[0]) - e1, f2 = (upper[2] - upper[0]) - e2;
  bool positive = true, negative = true, thick = false;
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 d = upper[i] - lower[i];
    if (d == glm::dvec3(0)) continue;
    thick = true;
    const Quadratic q = volume_density(e1, f1, e2, f2, d);
    positive = positive && least_of(q, 1) > 0;
    negative = negative && least_of(q, -1) > 0;
  }
  return !thick ? 0 : positive ? 1 : negative ? -1 : 0;
}

std::vector<PrismFault> prism_faults(const Shell& shell) {
  const ShellBounds bounds = bounds_of(shell);
  const glm::dvec3 middle = 0.5 * (bounds.lo + bounds.hi);
  std::vector<PrismFault> faults;
  for (const std::array<uint32_t, 3>& triangle : shell.mesh->triangles) {
    std::array<glm::dvec3, 3> lower, upper;
    for (size_t i = 0; i < 3; ++i) {
      const glm::dvec3 corner = shell.mesh->positions[triangle[i]] - middle;
      lower[i] = glm::dvec3(glm::vec3(corner));
      upper[i] = glm::dvec3(glm::vec3(corner + shell.offset(triangle[i])));
    }
    faults.push_back(jacobian_sign(lower, upper) != 0 ? PrismFault::None
                     : has_volume(lower, upper)       ? PrismFault::SelfIntersecting
                                                      : PrismFault::Degenerate);
  }
  return faults;
}

}  // namespace volumark
