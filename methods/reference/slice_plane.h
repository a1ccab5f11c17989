// What a ray shows of a scene's slice plane (scenes/scene.h): one point, in closed form. A ray along the plane shows
// nothing. Const and safe to share between threads.
#pragma once

#include "methods/reference/lattice.h"
#include "methods/reference/ray_result.h"
#include "scenes/scene.h"

namespace volumark {

class PlaneTracer {
 public:
  // The scene must outlive the tracer, show a slice plane and have its volume.
  explicit PlaneTracer(const Scene& scene);
  // The bound is proved: the colours of all values within rounding of the one met, and alpha where rounding decides
  // whether the point lies in the box.
  RayResult trace(const Ray& ray) const;

 private:
  double colour_error(double value, double error) const;

  const Scene& scene_;
  const SlicePlane& plane_;
  Lattice lattice_;
};

}  // namespace volumark
