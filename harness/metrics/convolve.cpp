#include "harness/metrics/convolve.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace volumark {

Plane convolve_rows(const Plane& source, int width, int height, std::span<const double> kernel) {
  const size_t w = static_cast<size_t>(width), taps = kernel.size(), radius = taps / 2;
  Plane out(source.size());
  std::vector<double> padded(w + taps);
  for (size_t y = 0; y < static_cast<size_t>(height); ++y) {
    const double* row = source.data() + y * w;
    std::fill_n(padded.begin(), radius, row[0]);
    std::copy_n(row, w, padded.begin() + static_cast<std::ptrdiff_t>(radius));
    std::fill(padded.begin() + static_cast<std::ptrdiff_t>(radius + w), padded.end(), row[w - 1]);
    double* to = out.data() + y * w;
    for (size_t k = 0; k < taps; ++k) {  // taps outside, pixels inside: the inner loop vectorises
      const double weight = kernel[k];
      const double* from = padded.data() + k;
      for (size_t x = 0; x < w; ++x) to[x] += weight * from[x];
    }
  }
  return out;
}

Plane convolve_columns(const Plane& source, int width, int height, std::span<const double> kernel) {
  const size_t w = static_cast<size_t>(width);
  const int taps = static_cast<int>(kernel.size()), radius = taps / 2;
  Plane out(source.size());
  for (int y = 0; y < height; ++y) {
    double* to = out.data() + static_cast<size_t>(y) * w;
    for (int k = 0; k < taps; ++k) {
      const double weight = kernel[static_cast<size_t>(k)];
      const double* from = source.data() + static_cast<size_t>(std::clamp(y + k - radius, 0, height - 1)) * w;
      for (size_t x = 0; x < w; ++x) to[x] += weight * from[x];
    }
  }
  return out;
}

Plane convolve(const Plane& source, int width, int height, std::span<const double> horizontal,
               std::span<const double> vertical) {
  return convolve_columns(convolve_rows(source, width, height, horizontal), width, height, vertical);
}

std::vector<double> gaussian_kernel(double sigma, int radius) {
  std::vector<double> kernel;
  for (int x = -radius; x <= radius; ++x) kernel.push_back(std::exp(-x * x / (2 * sigma * sigma)));
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  for (double& weight : kernel) weight /= sum;
  return kernel;
}

}  // namespace volumark
