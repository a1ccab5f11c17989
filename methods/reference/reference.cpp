#include "methods/reference/reference.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "methods/reference/integrator.h"

namespace volumark {
namespace {

constexpr int kTile = 16;  // pixels along each edge

const Scene& checked(const Scene& scene) {
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

void render_tile(const Integrator& integrator, const View& view, int tile_x, int tile_y, double tolerance,
                 Reference& out, int64_t& cells, int64_t& pieces) {
  Image& image = out.image;
  for (int y = tile_y; y < std::min(tile_y + kTile, image.height); ++y) {
    for (int x = tile_x; x < std::min(tile_x + kTile, image.width); ++x) {
      const RayResult ray = integrator.integrate(pixel_ray(view, image.width, image.height, x, y), tolerance);
      float* pixel = image.pixel(x, y);
      const double rounding = std::max({store(ray.rgb.x, pixel[0]), store(ray.rgb.y, pixel[1]),
                                        store(ray.rgb.z, pixel[2]), store(ray.alpha, pixel[3])});
      out.bound[static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x)] =
          round_up(ray.bound + rounding);
      cells += ray.cells;
      pieces += ray.pieces;
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
    const Integrator integrator(checked(scene), true);
    Reference out;
    out.image = Image(width, height);
    out.bound.resize(static_cast<size_t>(width) * static_cast<size_t>(height));
    out.estimate = integrator.lit();
    const int columns = (width + kTile - 1) / kTile, rows = (height + kTile - 1) / kTile;
    std::vector<int64_t> cells(static_cast<size_t>(columns * rows)), pieces(cells.size());
    tbb::parallel_for(size_t{0}, cells.size(), [&](size_t i) {
      const int tile = static_cast<int>(i);
      render_tile(integrator, view, tile % columns * kTile, tile / columns * kTile, options.tolerance, out, cells[i],
                  pieces[i]);
    });
    for (size_t i = 0; i < cells.size(); ++i) {
      out.cells += cells[i];
      out.pieces += pieces[i];
    }
    out.max_bound = static_cast<double>(*std::max_element(out.bound.begin(), out.bound.end()));
    return out;
  });
}

RayIntegral integrate_ray(const Scene& scene, const View&, const Ray& ray, double tolerance) {
  const RayResult result = Integrator(checked(scene), false).integrate(ray, tolerance);
  return {{result.rgb.x, result.rgb.y, result.rgb.z, result.alpha}, result.bound};
}

}  // namespace volumark
