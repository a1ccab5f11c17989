#include "methods/reference/ray_span.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace volumark {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// An end of a span: the last of several entries (or, negated, the first of several exits), with the range that rounding
// leaves it.
struct End {
  double at, least, most;
  void raise(double t, double error) {
    at = std::max(at, t);
    least = std::max(least, t - error);
    most = std::max(most, t + error);
  }
  double error() const { return std::max(at - least, most - at); }
};

}  // namespace

double position_error(const Lattice& lattice, const Ray& ray) {
  const Volume& volume = lattice.volume();
  double size = 0;
  for (int a = 0; a < 3; ++a) {
    size += (std::abs(ray.origin[a]) + std::abs(volume.origin[a])) /
            std::min({volume.spacing.x, volume.spacing.y, volume.spacing.z});
    size += lattice.cells()[a];
  }
  return 8 * kEpsilon * size;
}

std::optional<RaySpan> clip_ray(const Scene& scene, const Lattice& lattice, const Ray& ray, const GridRay& grid,
                                double error) {
  const double infinity = std::numeric_limits<double>::infinity(), lowest = std::numeric_limits<double>::lowest();
  End entry{lowest, lowest, lowest}, exit = entry;  // exit: of -t
  entry.raise(ray.t_near, 4 * kEpsilon * std::abs(ray.t_near));
  // Keeps t where from + t * rate >= 0, with this absolute error along the whole ray.
  auto keep = [&](double from, double rate, double from_error) {
    if (rate != 0) {
      const double t = -from / rate, t_error = from_error / std::abs(rate) + 4 * kEpsilon * std::abs(t);
      rate > 0 ? entry.raise(t, t_error) : exit.raise(-t, t_error);
    } else if (std::abs(from) <= from_error) {  // in or out: rounding decides
      from < 0 ? exit.raise(infinity, infinity) : exit.raise(lowest, infinity);
    } else if (from < 0) {
      exit.raise(infinity, 0);
    }
  };
  for (int a = 0; a < 3; ++a) {
    keep(grid.origin[a], grid.direction[a], error);
    keep(lattice.cells()[a] - grid.origin[a], -grid.direction[a], error);
  }
  for (const ClipPlane& plane : scene.effects.clip_planes) {
    const double at = glm::dot(plane.normal, ray.origin);
    const double plane_error = 8 * kEpsilon * (2 * glm::length(ray.origin) + std::abs(plane.distance));
    keep(at - plane.distance, glm::dot(plane.normal, ray.direction), plane_error);
  }
  if (entry.least >= -exit.least) return std::nullopt;
  const double longest = glm::length(lattice.volume().extent());
  auto within = [&](double e) { return e < longest ? e : longest; };  // also where e is not a number
  return RaySpan{entry.at, -exit.at, within(entry.error()), within(exit.error()), -exit.most, -exit.least};
}

}  // namespace volumark
