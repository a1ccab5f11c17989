#include "methods/reference/shell_prism.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "methods/reference/polynomial.h"

namespace volumark {
namespace {

// Faces are looked for a little beyond their ends: a crossing too many only cuts a stretch of the ray in two.
constexpr double kBeyond = 1e-6;

double least(const PrismPoint& p) { return std::min({1 - p.x - p.y, p.x, p.y, p.z, 1 - p.z}); }

// Two directions that span the plane across a unit vector.
struct Across {
  glm::dvec3 u, v;
};
Across across(const glm::dvec3& direction) {
  const glm::dvec3 a = glm::abs(direction);
  const glm::dvec3 axis = a.x <= a.y && a.x <= a.z   ? glm::dvec3(1, 0, 0)
                          : a.y <= a.x && a.y <= a.z ? glm::dvec3(0, 1, 0)
                                                     : glm::dvec3(0, 0, 1);
  const glm::dvec3 u = glm::normalize(glm::cross(direction, axis));
  return {u, glm::cross(direction, u)};
}

double cross2(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// Real roots of a x^2 + b x + c, also where a or a and b are 0; no cancellation.
int roots_of(double a, double b, double c, std::array<double, 2>& roots) {
  const double discriminant = b * b - 4 * a * c;
  if (discriminant < 0) return 0;
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  int count = 0;
  if (a != 0) roots[static_cast<size_t>(count++)] = q / a;
  if (q != 0) roots[static_cast<size_t>(count++)] = c / q;
  return count;
}

}  // namespace

PrismMap::PrismMap(const std::array<glm::dvec3, 6>& corners) {
  for (size_t i = 0; i < 3; ++i) {
    p_[i] = corners[i];
    d_[i] = corners[i + 3] - corners[i];
  }
  e1_ = p_[1] - p_[0];
  e2_ = p_[2] - p_[0];
  g1_ = d_[1] - d_[0];
  g2_ = d_[2] - d_[0];
}

glm::dvec3 PrismMap::at(const PrismPoint& p) const {
  return p_[0] + p.x * e1_ + p.y * e2_ + p.z * (d_[0] + p.x * g1_ + p.y * g2_);
}

glm::dmat3 PrismMap::jacobian(const PrismPoint& p) const {
  return {e1_ + p.z * g1_, e2_ + p.z * g2_, d_[0] + p.x * g1_ + p.y * g2_};
}

bool PrismMap::refine(const glm::dvec3& position, PrismPoint& point) const {
  constexpr double kConverged = 1e-13;
  PrismPoint p = point;
  for (int i = 0; i < 12; ++i) {
    const glm::dmat3 j = jacobian(p);
    const glm::dvec3 rest = position - at(p), side = glm::cross(j[1], j[2]);
    const double determinant = glm::dot(j[0], side);
    const glm::dvec3 step(glm::dot(rest, side), glm::dot(j[0], glm::cross(rest, j[2])),
                          glm::dot(j[0], glm::cross(j[1], rest)));
    const glm::dvec3 change = step / determinant;
    p += change;
    const double size = std::max({std::abs(change.x), std::abs(change.y), std::abs(change.z)});
    if (!(size < 4)) return false;  // it has left the prism, or the map is singular here
    if (size < kConverged) {
      if (least(p) < -kBeyond) return false;  // a point that the map has beyond the prism
      point = p;
      return true;
    }
  }
  return false;
}

// The triangle at height w holds the position where det(e_1(w), e_2(w), position - p_0(w)) = 0: a cubic in w.
double PrismMap::locate(const glm::dvec3& position, PrismPoint& point) const {
  const glm::dvec3 r = position - p_[0];
  const glm::dvec3 c0 = glm::cross(e1_, e2_), c1 = glm::cross(e1_, g2_) + glm::cross(g1_, e2_),
                   c2 = glm::cross(g1_, g2_);
  const std::array<double, 4> cubic{glm::dot(c0, r), glm::dot(c1, r) - glm::dot(c0, d_[0]),
                                    glm::dot(c2, r) - glm::dot(c1, d_[0]), -glm::dot(c2, d_[0])};
  size_t terms = 4;
  while (terms > 1 && cubic[terms - 1] == 0) --terms;
  const Roots roots = roots_between(std::span(cubic).first(terms), -kBeyond, 1 + kBeyond);
  double best = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < roots.count; ++i) {
    const double w = roots.at[static_cast<size_t>(i)];
    const glm::dvec3 a = e1_ + w * g1_, b = e2_ + w * g2_, n = glm::cross(a, b), rest = r - w * d_[0];
    const double area = glm::dot(n, n);
    if (!(area > 0)) continue;
    const PrismPoint candidate(glm::dot(glm::cross(rest, b), n) / area, glm::dot(glm::cross(a, rest), n) / area, w);
    if (!(least(candidate) > best)) continue;  // NaN too
    best = least(candidate);
    point = candidate;
  }
  return best;
}

// The side over the edge i, j is the bilinear patch A + s B + w C + s w D. Seen along the ray it has two coordinates,
// both 0 where the ray meets it; without s that is a quadratic in w.
void PrismMap::append_side(const Ray& ray, int i, int j, std::vector<double>& t) const {
  const auto a = static_cast<size_t>(i), b = static_cast<size_t>(j);
  const Across plane = across(ray.direction);
  const auto flat = [&](const glm::dvec3& v) { return glm::dvec2(glm::dot(plane.u, v), glm::dot(plane.v, v)); };
  const glm::dvec3 A = p_[a] - ray.origin, B = p_[b] - p_[a], C = d_[a], D = d_[b] - d_[a];
  const glm::dvec2 fa = flat(A), fb = flat(B), fc = flat(C), fd = flat(D);
  std::array<double, 2> heights{};
  const int count = roots_of(cross2(fc, fd), cross2(fa, fd) + cross2(fc, fb), cross2(fa, fb), heights);
  for (int k = 0; k < count; ++k) {
    const double w = heights[static_cast<size_t>(k)];
    if (!(w >= -kBeyond && w <= 1 + kBeyond)) continue;
    const glm::dvec2 from = fa + w * fc, along = fb + w * fd;
    const double length = glm::dot(along, along);
    const double s = length > 0 ? -glm::dot(from, along) / length : 0;
    if (!(s >= -kBeyond && s <= 1 + kBeyond)) continue;
    t.push_back(glm::dot(ray.direction, A + s * B + w * (C + s * D)));
  }
}

void PrismMap::append_crossings(const Ray& ray, std::vector<double>& t) const {
  const auto plane = [&](const glm::dvec3& normal, const glm::dvec3& point) {
    const double at = glm::dot(normal, point - ray.origin) / glm::dot(normal, ray.direction);
    if (std::isfinite(at)) t.push_back(at);
  };
  plane(glm::cross(e1_, e2_), p_[0]);
  plane(glm::cross(e1_ + g1_, e2_ + g2_), p_[0] + d_[0]);
  append_side(ray, 0, 1, t);
  append_side(ray, 1, 2, t);
  append_side(ray, 2, 0, t);
}

}  // namespace volumark
