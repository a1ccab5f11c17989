// The part of a ray that a scene's box, near plane and clip planes leave, and how far rounding may have moved its ends.
#pragma once

#include <optional>

#include "methods/reference/grid_walk.h"
#include "methods/reference/lattice.h"
#include "scenes/scene.h"

namespace volumark {

struct RaySpan {
  double t0, t1;                      // empty where t0 >= t1
  double error0, error1;              // how far rounding may have moved either end; at most the box's diagonal
  double earliest_exit, latest_exit;  // t1 as rounding leaves it; -infinity where the ray runs along a face
};

// Index units, over all axes: what rounding can shift a point of the ray by.
double position_error(const Lattice& lattice, const Ray& ray);

// `grid`: the ray in index space; `error`: its position_error(). Nothing where the ray certainly misses.
std::optional<RaySpan> clip_ray(const Scene& scene, const Lattice& lattice, const Ray& ray, const GridRay& grid,
                                double error);

}  // namespace volumark
