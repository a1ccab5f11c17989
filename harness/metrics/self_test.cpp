// Check values. FLIP of constant pairs: closed form with the authors' rational sRGB matrix (cmax 41.276096; matrices
// rounded to four digits move them by up to 8e-6). FLIP of the dot: an independent implementation with two-dimensional
// kernels. CIEDE2000: Sharma's table. The others: closed form.
#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/metrics/colour.h"
#include "harness/metrics/metrics.h"

namespace volumark {
namespace {

Image constant(int width, int height, const glm::dvec3& rgb) {
  Image image(width, height);
  for (size_t i = 0; i < image.rgba.size(); i += 4) {
    for (int c = 0; c < 3; ++c) image.rgba[i + static_cast<size_t>(c)] = static_cast<float>(rgb[c]);
    image.rgba[i + 3] = 1;
  }
  return image;
}

void flip_rows(std::vector<SelfTest>& rows) {
  const int n = 24;
  auto colours = [&](const char* name, const glm::dvec3& a, const glm::dvec3& b, double expected) {
    const Errors errors = compare_images(constant(n, n, a), constant(n, n, b));
    rows.push_back({std::string("FLIP ") + name, expected, *errors.flip_mean, 2e-6});
  };
  auto grey = [](double v) { return glm::dvec3(v); };
  colours("black / white", grey(0), grey(1), 0.967380);
  colours("green / blue", {0, 1, 0}, {0, 0, 1}, 1.000000);
  colours("red / green", {1, 0, 0}, {0, 1, 0}, 0.986662);
  colours("0 / 0.5", grey(0), grey(0.5), 0.958543);
  colours("0.5 / 0.5 + 1/255", grey(0.5), grey(0.5 + 1.0 / 255), 0.021194);
  colours("sRGB8 128 / 129", grey(srgb_decode(128.0 / 255)), grey(srgb_decode(129.0 / 255)), 0.029855);

  const Image black = constant(65, 65, grey(0));
  Image dot = black;
  std::fill_n(dot.pixel(32, 32), 4, 1.0f);
  const std::vector<float> map = flip_map(dot, black);
  rows.push_back({"FLIP white pixel in black 65 x 65, mean", 0.003387, *compare_images(dot, black).flip_mean, 2e-6});
  rows.push_back({"FLIP white pixel in black 65 x 65, max", 0.864906,
                  static_cast<double>(*std::max_element(map.begin(), map.end())), 2e-6});
}

void ciede_rows(std::vector<SelfTest>& rows) {
  const struct {
    const char* name;
    glm::dvec3 a, b;
    double expected;
  } pairs[] = {
      {"CIEDE2000 Sharma 1", {50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
      {"CIEDE2000 Sharma 2", {50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
      {"CIEDE2000 Sharma 7", {50, 0, 0}, {50, -1, 2}, 2.3669},
      {"CIEDE2000 Sharma 9", {50, 2.4900, -0.0010}, {50, -2.4900, 0.0009}, 7.1792},
      {"CIEDE2000 Sharma 17", {50, 2.5, 0}, {73, 25, -18}, 27.1492},
  };
  for (const auto& pair : pairs) rows.push_back({pair.name, pair.expected, ciede2000(pair.a, pair.b), 5e-5});
}

void channel_rows(std::vector<SelfTest>& rows) {
  const Image base = constant(20, 20, glm::dvec3(0.25));
  Image other = base;
  other.pixel(7, 3)[1] += 0.5f;  // one channel of one of 400 pixels
  const Errors errors = compare_images(other, base);
  rows.push_back({"MAE", 0.5 / 1200, errors.mae, 1e-12});
  rows.push_back({"RMSE", 0.5 / std::sqrt(1200.0), errors.rmse, 1e-12});
  rows.push_back({"max", 0.5, errors.max, 1e-12});
  rows.push_back({"max, x", 7, static_cast<double>(errors.max_x), 0});
  rows.push_back({"max, y", 3, static_cast<double>(errors.max_y), 0});
  rows.push_back({"PSNR", 20 * std::log10(2 * std::sqrt(1200.0)), errors.psnr.value_or(0), 1e-9});
  rows.push_back({"bias, green", 0.5 / 400, errors.bias[1], 1e-12});
  rows.push_back({"fraction over 1/255", 1.0 / 400, errors.over_1_255, 1e-12});
  rows.push_back({"percentile 99", 0, errors.p99, 0});
  rows.push_back({"PSNR of equal images is absent", 0, compare_images(base, base).psnr ? 1.0 : 0.0, 0});

  other.pixel(1, 1)[0] = std::numeric_limits<float>::quiet_NaN();
  other.pixel(2, 1)[3] = std::numeric_limits<float>::infinity();
  rows.push_back({"non-finite pixels", 2, static_cast<double>(compare_images(other, base).non_finite), 0});
}

void ssim_rows(std::vector<SelfTest>& rows) {
  const Errors errors =
      compare_images(constant(24, 24, glm::dvec3(srgb_decode(0.5))), constant(24, 24, glm::dvec3(srgb_decode(0.6))));
  rows.push_back({"SSIM constants 0.5 / 0.6", 0.6001 / 0.6101, errors.ssim.value_or(0), 1e-6});
}

}  // namespace

std::vector<SelfTest> metric_self_test() {
  std::vector<SelfTest> rows;
  channel_rows(rows);
  ssim_rows(rows);
  flip_rows(rows);
  ciede_rows(rows);
  return rows;
}

}  // namespace volumark
