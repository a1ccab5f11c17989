#include "harness/metrics/metrics.h"

#include <algorithm>
#include <cmath>

#include "harness/metrics/colour.h"
#include "harness/metrics/flip.h"
#include "harness/metrics/ssim.h"

namespace volumark {
namespace {

void check_sizes(const Image& a, const Image& b) {
  auto text = [](const Image& i) { return std::to_string(i.width) + " x " + std::to_string(i.height); };
  if (a.width != b.width || a.height != b.height)
    throw MetricError("images of unequal size: " + text(a) + " against " + text(b));
  if (a.width <= 0 || a.height <= 0) throw MetricError("images without a pixel: " + text(a));
}

bool finite(const float* pixel) {
  return std::isfinite(pixel[0]) && std::isfinite(pixel[1]) && std::isfinite(pixel[2]) && std::isfinite(pixel[3]);
}

glm::dvec3 over(const float* pixel, const glm::dvec3& background) {
  return glm::dvec3(pixel[0], pixel[1], pixel[2]) + (1 - static_cast<double>(pixel[3])) * background;
}

// RGB over the background as planes in [0, 1]. Non-finite test pixels become the reference's, and the reference's
// black, so that they do not spread through the filters.
struct Prepared {
  std::array<Plane, 3> test, reference;
};
Prepared prepare(const Image& test, const Image& reference, const glm::dvec3& background) {
  const size_t n = test.rgba.size() / 4;
  Prepared out;
  for (int c = 0; c < 3; ++c) {
    out.test[static_cast<size_t>(c)].resize(n);
    out.reference[static_cast<size_t>(c)].resize(n);
  }
  for (size_t i = 0; i < n; ++i) {
    const float *t = test.rgba.data() + 4 * i, *r = reference.rgba.data() + 4 * i;
    const bool both = finite(t) && finite(r);
    const glm::dvec3 b = finite(r) ? over(r, background) : glm::dvec3(0);
    const glm::dvec3 a = both ? over(t, background) : b;
    for (int c = 0; c < 3; ++c) {
      out.test[static_cast<size_t>(c)][i] = std::clamp(a[c], 0.0, 1.0);
      out.reference[static_cast<size_t>(c)][i] = std::clamp(b[c], 0.0, 1.0);
    }
  }
  return out;
}

// Reorders `values`.
double percentile(std::vector<double>& values, double p) {
  if (values.empty()) return 0;
  const double rank = std::ceil(p * static_cast<double>(values.size()));
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (double v : values) sum += v;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

// The values at the compared pixels.
std::vector<double> selected(const Plane& plane, const std::vector<uint8_t>& compared) {
  std::vector<double> out;
  for (size_t i = 0; i < plane.size(); ++i)
    if (compared[i]) out.push_back(plane[i]);
  return out;
}

void channel_errors(const Image& test, const Image& reference, const CompareOptions& options,
                    const std::vector<uint8_t>& compared, Errors& errors) {
  const size_t width = static_cast<size_t>(test.width);
  std::vector<double> largest;
  largest.reserve(static_cast<size_t>(errors.pixels));
  double absolute = 0, square = 0, alpha_absolute = 0, alpha_square = 0;
  glm::dvec3 sum(0);
  for (size_t i = 0; i < compared.size(); ++i) {
    if (!compared[i]) continue;
    const float *t = test.rgba.data() + 4 * i, *r = reference.rgba.data() + 4 * i;
    const glm::dvec3 d = over(t, options.background) - over(r, options.background);
    const double worst = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    const double alpha = std::abs(static_cast<double>(t[3]) - static_cast<double>(r[3]));
    absolute += std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    square += d.x * d.x + d.y * d.y + d.z * d.z;
    sum += d;
    alpha_absolute += alpha;
    alpha_square += alpha * alpha;
    errors.alpha_max = std::max(errors.alpha_max, alpha);
    if (errors.max_x < 0 || worst > errors.max) {
      errors.max = worst;
      errors.max_x = static_cast<int>(i % width);
      errors.max_y = static_cast<int>(i / width);
    }
    largest.push_back(worst);
  }
  if (largest.empty()) return;
  const double n = static_cast<double>(largest.size());
  errors.mae = absolute / (3 * n);
  errors.rmse = std::sqrt(square / (3 * n));
  if (errors.rmse > 0) errors.psnr = -20 * std::log10(errors.rmse);
  for (int c = 0; c < 3; ++c) errors.bias[static_cast<size_t>(c)] = sum[c] / n;
  errors.alpha_mae = alpha_absolute / n;
  errors.alpha_rmse = std::sqrt(alpha_square / n);
  errors.over_1_255 =
      static_cast<double>(std::count_if(largest.begin(), largest.end(), [](double e) { return e > 1.0 / 255; })) / n;
  errors.p50 = percentile(largest, 0.50);
  errors.p95 = percentile(largest, 0.95);
  errors.p99 = percentile(largest, 0.99);
}

// Luma of the sRGB-encoded colour, Rec. 709 weights.
Plane srgb_luma(const std::array<Plane, 3>& rgb) {
  Plane luma(rgb[0].size());
  for (size_t i = 0; i < luma.size(); ++i)
    luma[i] = 0.2126 * srgb_encode(rgb[0][i]) + 0.7152 * srgb_encode(rgb[1][i]) + 0.0722 * srgb_encode(rgb[2][i]);
  return luma;
}

void perceptual_errors(const Prepared& images, int width, int height, const std::vector<uint8_t>& compared,
                       Errors& errors) {
  std::vector<double> flips = selected(flip(images.test, images.reference, width, height), compared);
  errors.flip_mean = mean(flips);
  errors.flip_p99 = percentile(flips, 0.99);

  std::vector<double> delta_e;
  for (size_t i = 0; i < compared.size(); ++i) {
    if (!compared[i]) continue;
    const glm::dvec3 t(images.test[0][i], images.test[1][i], images.test[2][i]);
    const glm::dvec3 r(images.reference[0][i], images.reference[1][i], images.reference[2][i]);
    delta_e.push_back(t == r ? 0.0 : ciede2000(lab_of(xyz_of(t)), lab_of(xyz_of(r))));
  }
  errors.ciede2000_mean = mean(delta_e);
  errors.ciede2000_p99 = percentile(delta_e, 0.99);

  const Plane similarity = ssim_map(srgb_luma(images.test), srgb_luma(images.reference), width, height);
  double sum = 0;
  int64_t count = 0;
  for (int y = kSsimRadius; y < height - kSsimRadius; ++y) {
    for (int x = kSsimRadius; x < width - kSsimRadius; ++x) {
      const size_t i = static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
      if (!compared[i]) continue;
      sum += similarity[i];
      ++count;
    }
  }
  if (count > 0) errors.ssim = sum / static_cast<double>(count);
}

}  // namespace

Errors compare_images(const Image& test, const Image& reference, const CompareOptions& options) {
  check_sizes(test, reference);
  const size_t n = test.rgba.size() / 4;
  if (!options.mask.empty() && options.mask.size() != n)
    throw MetricError("mask of " + std::to_string(options.mask.size()) + " pixels for images of " + std::to_string(n));
  Errors errors;
  std::vector<uint8_t> compared(n, 0);
  for (size_t i = 0; i < n; ++i) {
    if (!options.mask.empty() && options.mask[i] == 0) continue;
    if (finite(test.rgba.data() + 4 * i) && finite(reference.rgba.data() + 4 * i)) {
      compared[i] = 1;
      ++errors.pixels;
    } else {
      ++errors.non_finite;
    }
  }
  channel_errors(test, reference, options, compared, errors);
  if (options.perceptual && errors.pixels > 0)
    perceptual_errors(prepare(test, reference, options.background), test.width, test.height, compared, errors);
  return errors;
}

Image composite(const Image& image, const glm::dvec3& background) {
  Image out(image.width, image.height);
  for (size_t i = 0; i < image.rgba.size(); i += 4) {
    const glm::dvec3 rgb = over(image.rgba.data() + i, background);
    for (int c = 0; c < 3; ++c) out.rgba[i + static_cast<size_t>(c)] = static_cast<float>(rgb[c]);
    out.rgba[i + 3] = 1;
  }
  return out;
}

std::vector<float> flip_map(const Image& test, const Image& reference, const glm::dvec3& background) {
  check_sizes(test, reference);
  const Prepared images = prepare(test, reference, background);
  const Plane map = flip(images.test, images.reference, test.width, test.height);
  std::vector<float> out(map.size());
  std::transform(map.begin(), map.end(), out.begin(), [](double v) { return static_cast<float>(v); });
  return out;
}

}  // namespace volumark
