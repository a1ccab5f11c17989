// Integrates rays through a shell (scenes/shell.h): finds the stretches inside prisms, cuts them where they pass from
// texel to texel, and adds emission and absorption on each piece. Const and safe to share between threads.
//
// On a piece extinction and emission are polynomials of degree 4 through five samples. Along a straight line through
// the texture the trilinear interpolation is a cubic, which they meet exactly; the map bends the line a little, and
// light bends the emission: where the fifth sample is off the cubic through the other four, the piece is halved. The
// bound is an estimate: what those samples were off by, and what rounding does.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "methods/reference/ray_result.h"
#include "methods/reference/shell_boxes.h"
#include "methods/reference/shell_prism.h"
#include "scenes/scene.h"
#include "scenes/shell.h"

namespace volumark {

class ShellTracer {
 public:
  // The scene must outlive the tracer and show a shell, which is loaded. Prisms whose map does not keep the sign of its
  // Jacobian are left out.
  explicit ShellTracer(const Scene& scene);
  RayResult trace(const Ray& ray, double tolerance) const;
  size_t prisms() const { return prisms_.size(); }

 private:
  struct Prism {
    PrismMap map;
    std::array<glm::dvec3, 6> texture;
    std::array<glm::dmat3, 6> cotangents;  // where lit
  };
  struct Stretch {  // of a ray in a prism
    size_t prism;
    double t0, t1;
  };
  class Walk;  // of one ray

  std::vector<Stretch> stretches(const Ray& ray, double t0, double t1) const;

  const Scene& scene_;
  const Shell& shell_;
  std::vector<Prism> prisms_;
  std::optional<ShellBoxes> boxes_;
  glm::dvec3 middle_{0};  // of a sphere around all prisms
  double radius_ = 0;
  double floor_ = 0, max_radiance_ = 1;
};

}  // namespace volumark
