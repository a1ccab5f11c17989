#include "harness/regions.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>

#include "harness/metrics/metrics.h"
#include "methods/reference/isosurface.h"
#include "methods/reference/lattice.h"
#include "methods/reference/transfer_pieces.h"

namespace volumark {
namespace {

// The trilinear weights of a place in its cell, for values at the cell's corners.
double interpolate(const Lattice::Corners& corner, const glm::dvec3& f) {
  const auto mix = [](double a, double b, double t) { return a + (b - a) * t; };
  const double y0z0 = mix(corner[0], corner[1], f.x), y1z0 = mix(corner[2], corner[3], f.x);
  const double y0z1 = mix(corner[4], corner[5], f.x), y1z1 = mix(corner[6], corner[7], f.x);
  return mix(mix(y0z0, y1z0, f.y), mix(y0z1, y1z1, f.y), f.z);
}

// The span of a ray that box, near plane and clip planes leave.
struct Span {
  double t0, t1;
};

// Where rays contribute most, and how the data slopes there.
class Slopes {
 public:
  explicit Slopes(const Scene& scene)
      : scene_(scene), volume_(*scene.volume), lattice_(volume_), step_(0.5 * smallest(volume_.spacing)) {
    if (scene.display == Display::Isosurface) surface_.emplace(scene, true);
    if (scene.display == Display::Direct)
      lattice_.mark_empty_bricks(
          [pieces = TransferPieces(scene.transfer)](double lo, double hi) { return pieces.empty_range(lo, hi); });
    // Below it a gradient is rounding alone.
    least_slope_ = 1e-9 * (scene.transfer.hi - scene.transfer.lo) / smallest(volume_.spacing);
  }

  // |n . v| where the ray contributes most; 1 in a slice plane, and where nothing contributes or the gradient vanishes.
  double cosine(const Ray& ray) const {
    const glm::dvec3 origin = lattice_.index_of_point(ray.origin);
    const glm::dvec3 direction = lattice_.index_of_vector(ray.direction);
    std::optional<double> t;
    if (surface_) t = surface_->trace(ray).distance;
    if (scene_.display == Display::Direct) t = largest_contribution(ray, origin, direction);
    if (!t) return 1;
    const glm::dvec3 gradient = volume_.axes * gradient_at(origin + *t * direction);
    const double length = glm::length(gradient);
    return length > least_slope_ ? std::abs(glm::dot(gradient, ray.direction)) / length : 1;
  }

 private:
  static double smallest(const glm::dvec3& v) { return std::min({v.x, v.y, v.z}); }

  Span clip(const Ray& ray, const glm::dvec3& origin, const glm::dvec3& direction) const {
    const double infinity = std::numeric_limits<double>::infinity();
    Span span{ray.t_near, infinity};
    const auto keep = [&](double from, double rate) {  // where from + t rate >= 0
      if (rate > 0) span.t0 = std::max(span.t0, -from / rate);
      if (rate < 0) span.t1 = std::min(span.t1, -from / rate);
      if (rate == 0 && from < 0) span.t1 = -infinity;
    };
    for (int a = 0; a < 3; ++a) {
      keep(origin[a], direction[a]);
      keep(lattice_.cells()[a] - origin[a], -direction[a]);
    }
    for (const ClipPlane& plane : scene_.effects.clip_planes)
      keep(glm::dot(plane.normal, ray.origin) - plane.distance, glm::dot(plane.normal, ray.direction));
    return span;
  }

  glm::ivec3 cell_of(const glm::dvec3& index) const {
    return glm::clamp(glm::ivec3(glm::floor(index)), glm::ivec3(0), lattice_.cells() - 1);
  }

  std::optional<double> largest_contribution(const Ray& ray, const glm::dvec3& origin,
                                             const glm::dvec3& direction) const {
    const Span span = clip(ray, origin, direction);
    std::optional<double> place;
    double transmittance = 1, largest = 0;
    glm::ivec3 loaded(-1);
    Lattice::Corners corner{};
    // Nothing that follows can contribute more than what is still transmitted.
    for (int64_t i = 0; transmittance > largest; ++i) {
      const double t = span.t0 + (static_cast<double>(i) + 0.5) * step_;
      if (!(t < span.t1)) break;
      const glm::dvec3 index = origin + t * direction;
      const glm::ivec3 cell = cell_of(index);
      if (lattice_.brick_empty(cell / Lattice::kBrick)) continue;
      if (cell != loaded) lattice_.load(cell, corner);
      loaded = cell;
      const double extinction = scene_.transfer.at(interpolate(corner, index - glm::dvec3(cell))).a;
      const double contribution = -transmittance * std::expm1(-extinction * step_);
      if (contribution > largest) {
        largest = contribution;
        place = t;
      }
      transmittance -= contribution;
    }
    return place;
  }

  // Along the volume's axes, data units a world unit.
  glm::dvec3 gradient_at(const glm::dvec3& index) const {
    const glm::ivec3 cell = cell_of(index);
    Lattice::CornerGradients corners;
    lattice_.load_gradients(cell, corners);
    const glm::dvec3 place = index - glm::dvec3(cell);
    return {interpolate(corners[0], place), interpolate(corners[1], place), interpolate(corners[2], place)};
  }

  const Scene& scene_;
  const Volume& volume_;
  Lattice lattice_;
  std::optional<SurfaceTracer> surface_;  // of scenes that show one
  double step_, least_slope_ = 0;
};

// A pixel of which rounding decides whether it shows anything is taken as the reference shows it.
double bound_of(const Reference& reference, size_t pixel) {
  return std::min(static_cast<double>(reference.bound[pixel]), kSilhouetteSpan);
}

// Least and largest alpha of the 3 x 3 neighbourhood, and whether it is 0 within the bound.
struct Neighbourhood {
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  bool empty = true;
};
Neighbourhood neighbourhood(const Reference& reference, int x, int y) {
  const Image& image = reference.image;
  Neighbourhood out;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, image.height - 1); ++v) {
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, image.width - 1); ++u) {
      const auto alpha = static_cast<double>(image.pixel(u, v)[3]);
      const size_t i = static_cast<size_t>(v) * static_cast<size_t>(image.width) + static_cast<size_t>(u);
      out.lo = std::min(out.lo, alpha);
      out.hi = std::max(out.hi, alpha);
      out.empty &= alpha <= bound_of(reference, i);
    }
  }
  return out;
}

// `slopes` null: nothing is grazing.
Region region_of(const Slopes* slopes, const View& view, const Reference& reference, int x, int y) {
  const Neighbourhood around = neighbourhood(reference, x, y);
  if (around.empty) return Region::Background;
  if (around.hi - around.lo > kSilhouetteSpan) return Region::Silhouette;
  if (slopes == nullptr) return Region::Interior;
  const Ray ray = pixel_ray(view, reference.image.width, reference.image.height, x, y);
  return slopes->cosine(ray) < kGrazingCosine ? Region::Grazing : Region::Interior;
}

bool equals_background(const Reference& reference, const glm::dvec3& background) {
  for (size_t i = 0; i < reference.bound.size(); ++i) {
    const float* p = reference.image.rgba.data() + 4 * i;
    for (int c = 0; c < 3; ++c) {
      const double change = static_cast<double>(p[c]) - static_cast<double>(p[3]) * background[c];
      if (!(std::abs(change) <= bound_of(reference, i) * (1 + background[c]))) return false;
    }
  }
  return true;
}

}  // namespace

const char* to_string(Region region) {
  constexpr const char* kNames[] = {"background", "silhouette", "grazing", "interior"};
  return kNames[static_cast<size_t>(region)];
}

RegionMap region_map(const Scene& scene, const View& view, const Reference& reference, int threads) {
  RegionMap out;
  out.width = reference.image.width;
  out.height = reference.image.height;
  out.pixels.resize(reference.bound.size());
  out.shows_nothing = equals_background(reference, scene.background);
  const int available = tbb::info::default_concurrency();
  tbb::task_arena arena(threads > 0 ? std::min(threads, available) : available);
  arena.execute([&] {
    std::optional<Slopes> slopes;
    if (scene.volume) slopes.emplace(scene);
    tbb::parallel_for(0, out.height, [&](int y) {
      for (int x = 0; x < out.width; ++x)
        out.pixels[static_cast<size_t>(y) * static_cast<size_t>(out.width) + static_cast<size_t>(x)] =
            region_of(slopes ? &*slopes : nullptr, view, reference, x, y);
    });
  });
  return out;
}

std::map<std::string, RegionError> region_errors(const Image& test, const Image& reference, const RegionMap& map,
                                                 const glm::dvec3& background) {
  std::map<std::string, RegionError> out;
  std::vector<uint8_t> mask(map.pixels.size());
  for (const Region region : kRegions) {
    std::transform(map.pixels.begin(), map.pixels.end(), mask.begin(),
                   [region](Region r) { return static_cast<uint8_t>(r == region); });
    CompareOptions options;
    options.background = background;
    options.mask = mask;
    options.perceptual = false;
    const Errors errors = compare_images(test, reference, options);
    if (errors.pixels > 0) out[to_string(region)] = {errors.pixels, errors.rmse, errors.max, errors.mae};
  }
  return out;
}

}  // namespace volumark
