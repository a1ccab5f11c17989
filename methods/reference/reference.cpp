#include "methods/reference/reference.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>

#include "methods/reference/integrator.h"
#include "methods/reference/isosurface.h"
#include "methods/reference/shell_tracer.h"
#include "methods/reference/slice_plane.h"

namespace volumark {
namespace {

constexpr int kTile = 16;  // pixels along each edge

const Scene& checked(const Scene& scene) {
  if (scene.display == Display::Shell) return scene;
  if (!scene.volume) throw std::invalid_argument("reference: the scene's volume is not loaded");
  if (scene.transfer.points.empty()) throw std::invalid_argument("reference: the transfer function has no point");
  return scene;
}

// Rounds to float and returns how far that moved it.
double store(double value, float& out) {
  out = static_cast<float>(value);
  return std::abs(static_cast<double>(out) - value);
}

float round_up(double value) {
  const float rounded = static_cast<float>(value);
  return static_cast<double>(rounded) < value ? std::nextafter(rounded, std::numeric_limits<float>::infinity())
                                              : rounded;
}

using Draw = std::function<RayResult(const Ray&)>;

// What draws the rays of `scene`; it holds what it needs. `estimate`: its bound is not a proof.
Draw drawing(const Scene& scene, bool many_rays, double tolerance, bool& estimate) {
  switch (scene.display) {
    case Display::Isosurface: {
      auto tracer = std::make_shared<const SurfaceTracer>(scene, many_rays);
      estimate = tracer->lit();
      return [tracer](const Ray& ray) { return tracer->trace(ray); };
    }
    case Display::SlicePlane: {
      auto tracer = std::make_shared<const PlaneTracer>(scene);
      return [tracer](const Ray& ray) { return tracer->trace(ray); };
    }
    case Display::Shell: {
      auto tracer = std::make_shared<const ShellTracer>(scene);
      estimate = true;
      return [tracer, tolerance](const Ray& ray) { return tracer->trace(ray, tolerance); };
    }
    case Display::Direct:
      break;
  }
  auto integrator = std::make_shared<const Integrator>(scene, many_rays);
  estimate = integrator->lit();
  return [integrator, tolerance](const Ray& ray) { return integrator->integrate(ray, tolerance); };
}

struct TileWork {
  int64_t cells = 0, pieces = 0;
};

void render_tile(const Draw& draw, const View& view, int tile_x, int tile_y, Reference& out, TileWork& work) {
  Image& image = out.image;
  for (int y = tile_y; y < std::min(tile_y + kTile, image.height); ++y) {
    for (int x = tile_x; x < std::min(tile_x + kTile, image.width); ++x) {
      const RayResult ray = draw(pixel_ray(view, image.width, image.height, x, y));
      float* pixel = image.pixel(x, y);
      const double rounding = std::max({store(ray.rgb.x, pixel[0]), store(ray.rgb.y, pixel[1]),
                                        store(ray.rgb.z, pixel[2]), store(ray.alpha, pixel[3])});
      out.bound[static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x)] =
          round_up(ray.bound + rounding);
      work.cells += ray.cells;
      work.pieces += ray.pieces;
    }
  }
}

}  // namespace

Reference render_reference(const Scene& scene, const View& view, int width, int height,
                           const ReferenceOptions& options) {
  if (width <= 0 || height <= 0) throw std::invalid_argument("reference: the image has no pixel");
  if (!(options.tolerance > 0)) throw std::invalid_argument("reference: the tolerance must be positive");
  const int available = tbb::info::default_concurrency();
  tbb::task_arena arena(options.threads > 0 ? std::min(options.threads, available) : available);
  return arena.execute([&] {
    Reference out;
    const Draw draw = drawing(checked(scene), true, options.tolerance, out.estimate);
    out.image = Image(width, height);
    out.bound.resize(static_cast<size_t>(width) * static_cast<size_t>(height));
    const int columns = (width + kTile - 1) / kTile, rows = (height + kTile - 1) / kTile;
    std::vector<TileWork> work(static_cast<size_t>(columns * rows));
    tbb::parallel_for(size_t{0}, work.size(), [&](size_t i) {
      const int tile = static_cast<int>(i);
      render_tile(draw, view, tile % columns * kTile, tile / columns * kTile, out, work[i]);
    });
    for (const TileWork& tile : work) {
      out.cells += tile.cells;
      out.pieces += tile.pieces;
    }
    for (const float bound : out.bound) {
      if (bound >= 1 && scene.display != Display::Direct)
        ++out.undecided;
      else
        out.max_bound = std::max(out.max_bound, static_cast<double>(bound));
    }
    return out;
  });
}

RayIntegral integrate_ray(const Scene& scene, const View&, const Ray& ray, double tolerance) {
  bool estimate = false;
  const RayResult result = drawing(checked(scene), false, tolerance, estimate)(ray);
  return {{result.rgb.x, result.rgb.y, result.rgb.z, result.alpha}, result.bound, result.distance};
}

}  // namespace volumark
