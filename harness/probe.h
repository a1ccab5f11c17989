// Ray profile: what a pixel holds when only the part of the volume nearer than a depth d is there, for growing d. The
// far part is cut away by one more clip plane, perpendicular to the view direction; everything else of the scene, the
// view and the picture stays as it is, so that methods need no code of their own for it.
// Depths count along the view direction from the eye, in world units, as View::near does.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "backends/device.h"
#include "methods/method.h"
#include "scenes/scene.h"

namespace volumark {

// What was asked has no profile: the pixel is not in the picture, its ray misses the volume, a method does not simulate
// clip planes.
class ProbeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// One curve: a method with its values, or the reference (method == nullptr).
struct ProbeSubject {
  std::string label;
  const Method* method = nullptr;
  Values values = {};
};

struct ProbeOptions {
  int width = 192, height = 192;
  int x = 0, y = 0;         // the pixel, row 0 on top
  int depths = 64;          // at least 2: from where the ray enters the volume to where it leaves it, evenly
  double threshold = 2e-3;  // two curves part where any channel, or T, differs by more
  double precision = 1e-3;  // of that depth, in the smallest voxel spacing
  double tolerance = 1e-9;  // of the reference
};

// The scene at one point of the ray.
struct ProbePoint {
  double depth = 0;
  double value = 0;       // data units, trilinear
  glm::dvec3 colour{0};   // of the transfer function: not lit
  double extinction = 0;  // 1 / world unit
};

// The pixel with everything beyond a depth cut away: premultiplied colour C(d), transmittance T(d) = 1 - alpha(d).
struct ProbeSample {
  glm::dvec3 colour{0};
  double transmittance = 1;
  double bound = 0;  // the reference's own; 0 for methods
};

// The largest difference of T or of a channel of C; not a number where a sample is not.
double difference_of(const ProbeSample& a, const ProbeSample& b);

struct ProbeCurve {
  std::string label, method;
  Values values;
  std::vector<ProbeSample> samples;  // one a depth
};

// The first depth where curves `a` and `b` differ by more than the threshold: looked for between the depths of the
// profile, then by bisection, so that it is where the difference crosses the threshold.
struct Parting {
  double depth = 0;
  size_t a = 0, b = 0;  // curves
  ProbeSample at_a, at_b;
  ProbePoint point;
  glm::dvec3 gradient{0};  // the scene's central-difference gradient there, world space, data units a world unit
};

struct Probe {
  ProbeOptions options;
  double first = 0, last = 0;  // depths where the ray enters and leaves the (clipped) volume
  std::vector<ProbePoint> ray;
  std::vector<ProbeCurve> curves;
  std::optional<Parting> parting;  // of the first two curves; none with one curve
};

// The scene without what lies further than `depth`; throws nothing. With it a far plane, which views do not have.
Scene scene_up_to(const Scene& scene, const View& view, double depth);

// Draws `depths` pictures for each subject, and some more for the bisection. `device` may be null where all subjects
// are the reference. Throws ProbeError, and what methods throw.
Probe probe(const Scene& scene, const View& view, const std::vector<ProbeSubject>& subjects, Device* device,
            const ProbeOptions& options);

}  // namespace volumark
