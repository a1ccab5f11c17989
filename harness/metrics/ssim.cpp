#include "harness/metrics/ssim.h"

namespace volumark {

Plane ssim_map(const Plane& a, const Plane& b, int width, int height) {
  constexpr double c1 = 1e-4, c2 = 9e-4;
  const std::vector<double> window = gaussian_kernel(1.5, kSsimRadius);
  auto mean_of = [&](const Plane& x, const Plane& y) {
    Plane product(x.size());
    for (size_t i = 0; i < x.size(); ++i) product[i] = x[i] * y[i];
    return convolve(product, width, height, window, window);
  };
  const Plane mean_a = convolve(a, width, height, window, window);
  const Plane mean_b = convolve(b, width, height, window, window);
  const Plane aa = mean_of(a, a), bb = mean_of(b, b), ab = mean_of(a, b);
  Plane map(a.size(), 1.0);
  for (int y = kSsimRadius; y < height - kSsimRadius; ++y) {
    for (int x = kSsimRadius; x < width - kSsimRadius; ++x) {
      const size_t i = static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
      const double mm = mean_a[i] * mean_b[i], m2 = mean_a[i] * mean_a[i] + mean_b[i] * mean_b[i];
      map[i] = (2 * mm + c1) * (2 * (ab[i] - mm) + c2) / ((m2 + c1) * (aa[i] + bb[i] - m2 + c2));
    }
  }
  return map;
}

}  // namespace volumark
