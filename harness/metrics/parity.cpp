#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/metrics/metrics.h"

namespace volumark {
namespace {

double alpha_span(const Image& image, int x, int y) {
  float lo = image.pixel(x, y)[3], hi = lo;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, image.height - 1); ++v) {
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, image.width - 1); ++u) {
      lo = std::min(lo, image.pixel(u, v)[3]);
      hi = std::max(hi, image.pixel(u, v)[3]);
    }
  }
  return static_cast<double>(hi) - static_cast<double>(lo);
}

double difference(const float* a, const float* b) {
  double worst = 0;
  for (int c = 0; c < 4; ++c) {
    if (!std::isfinite(a[c]) || !std::isfinite(b[c])) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, std::abs(static_cast<double>(a[c]) - static_cast<double>(b[c])));
  }
  return worst;
}

}  // namespace

Parity parity(const Image& a, const Image& b, const ParityLimits& limits) {
  if (a.width != b.width || a.height != b.height || a.width <= 0 || a.height <= 0)
    throw MetricError("parity of " + std::to_string(a.width) + " x " + std::to_string(a.height) + " against " +
                      std::to_string(b.width) + " x " + std::to_string(b.height));
  Parity out;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const double d = difference(a.pixel(x, y), b.pixel(x, y));
      // A comparison with NaN is false: a pixel that is not finite counts as interior, where nothing excuses it.
      const bool silhouette =
          std::isfinite(d) && (limits.hidden_edges || alpha_span(a, x, y) > limits.silhouette_span ||
                               alpha_span(b, x, y) > limits.silhouette_span);
      if (silhouette) {
        ++out.silhouette_pixels;
        out.silhouette_over += d > limits.difference;
        out.silhouette_max = std::max(out.silhouette_max, d);
        continue;
      }
      ++out.interior_pixels;
      out.interior_over += d > limits.difference;
      if (out.interior_x < 0 || d > out.interior_max) {
        out.interior_max = d;
        out.interior_x = x;
        out.interior_y = y;
      }
    }
  }
  if (out.silhouette_pixels > 0)
    out.silhouette_fraction = static_cast<double>(out.silhouette_over) / static_cast<double>(out.silhouette_pixels);
  out.agree = out.interior_over == 0 && out.silhouette_fraction <= limits.silhouette_fraction;
  return out;
}

}  // namespace volumark
