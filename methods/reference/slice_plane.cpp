#include "methods/reference/slice_plane.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

#include "methods/reference/field_chord.h"
#include "methods/reference/ray_span.h"

namespace volumark {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

const SlicePlane& plane_of(const Scene& scene) {
  if (!scene.slice_plane) throw std::invalid_argument("reference: the scene shows no slice plane");
  return *scene.slice_plane;
}

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

}  // namespace

PlaneTracer::PlaneTracer(const Scene& scene) : scene_(scene), plane_(plane_of(scene)), lattice_(*scene.volume) {}

// Largest change of a channel for values within `error` of this one: at its ends and at the control values between.
double PlaneTracer::colour_error(double value, double error) const {
  const glm::dvec3 colour(scene_.transfer.at(value));
  double change = 0;
  auto look_at = [&](const glm::dvec3& other) { change = std::max(change, largest(other - colour)); };
  look_at(glm::dvec3(scene_.transfer.at(value - error)));
  look_at(glm::dvec3(scene_.transfer.at(value + error)));
  for (const TransferPoint& point : scene_.transfer.points)
    if (std::abs(point.value - value) <= error) look_at(point.colour);
  return change;
}

RayResult PlaneTracer::trace(const Ray& ray) const {
  RayResult result;
  const GridRay grid{lattice_.index_of_point(ray.origin), lattice_.index_of_vector(ray.direction)};
  const double error = position_error(lattice_, ray);
  const auto span = clip_ray(scene_, lattice_, ray, grid, error);
  if (!span) return result;
  const double away = glm::dot(plane_.normal, plane_.point - ray.origin);
  const double away_error = 8 * kEpsilon * (glm::length(plane_.point) + glm::length(ray.origin));
  const double rate = glm::dot(plane_.normal, ray.direction);
  const double t = away / rate;
  if (!std::isfinite(t)) return result;  // along the plane, or as good as that
  const double t_error = away_error / std::abs(rate) + 8 * kEpsilon * std::abs(t) / std::min(1.0, std::abs(rate));
  if (t + t_error < span->t0 - span->error0 || t - t_error > span->latest_exit) return result;

  const glm::dvec3 place = glm::clamp(grid.origin + t * grid.direction, glm::dvec3(0), glm::dvec3(lattice_.cells()));
  const glm::ivec3 cell = glm::min(glm::ivec3(place), lattice_.cells() - 1);
  Lattice::Corners corner;
  lattice_.load(cell, corner);
  const auto [lo, hi] = std::minmax_element(corner.begin(), corner.end());
  const double shift = error + 3 * t_error * largest(grid.direction);
  // Rounding may have chosen the wrong one of two neighbouring cells: the bound must hold in the steeper of them.
  const double range = lattice_.volume().max_value - lattice_.volume().min_value;
  const double size = std::max(std::abs(*lo), std::abs(*hi));
  const double value = along_chord(corner, place - glm::dvec3(cell), glm::dvec3(0))[0];
  const double value_error = shift * range + 8 * kEpsilon * size;
  const glm::dvec3 colour(scene_.transfer.at(value));
  result.cells = result.pieces = 1;
  result.bound = colour_error(value, value_error) + 8 * kEpsilon * largest(colour);
  const bool inside = t >= span->t0 && t <= span->t1;
  const bool certain = t - t_error >= span->t0 + span->error0 && t + t_error <= span->earliest_exit;
  if (!certain) result.bound = std::max({result.bound, 1.0, largest(colour)});
  if (!inside) return result;
  result.rgb = colour;
  result.alpha = 1;
  result.distance = t;
  return result;
}

}  // namespace volumark
