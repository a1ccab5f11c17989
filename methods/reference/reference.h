// The high-precision image of a scene and view: every pixel's ray integrated in double precision, with an error bound
// for each pixel. What scenes show (Display) is drawn as scenes/scene.h defines it. Direct: cells are cut at turning
// points of the field and control points of the transfer function; on each piece the optical depth is a quartic, and
// one moment of exp(-D), by Gauss-Legendre with a proved error, serves all channels.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenes/image.h"
#include "scenes/scene.h"

namespace volumark {

struct ReferenceOptions {
  double tolerance = 1e-6;  // wanted bound of each channel of a pixel
  int threads = 0;          // 0 = all; the image does not depend on it, bit for bit
};

struct Reference {
  Image image;               // premultiplied, over transparent black
  std::vector<float> bound;  // per pixel: largest error of any channel (rounding to float included)
  double max_bound = 0;      // of all pixels but the undecided ones
  int64_t undecided = 0;  // pixels of bound 1 or more: within rounding, the ray hits or misses an isosurface or plane
  bool estimate = false;  // lighting and shells: the bound is an error estimate, not a proof
  int64_t cells = 0, pieces = 0;
};

// Bumped whenever an image may change: part of the cache key.
inline constexpr int kReferenceVersion = 3;

Reference render_reference(const Scene& scene, const View& view, int width, int height,
                           const ReferenceOptions& options = {});

// One ray, for tests and probes: premultiplied rgba and its bound.
struct RayIntegral {
  double rgba[4];
  double bound;
  std::optional<double> distance = {};  // of the one point that it shows, along the ray: isosurfaces and slice planes
};
RayIntegral integrate_ray(const Scene& scene, const View& view, const Ray& ray, double tolerance = 1e-9);

}  // namespace volumark
