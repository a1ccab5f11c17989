#include "harness/metrics/metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace volumark {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Image grey(int width, int height, float value, float alpha = 1) {
  Image image(width, height);
  for (size_t i = 0; i < image.rgba.size(); ++i) image.rgba[i] = i % 4 == 3 ? alpha : value;
  return image;
}

Image noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Image image(width, height);
  for (size_t i = 0; i < image.rgba.size(); ++i)
    image.rgba[i] = i % 4 == 3 ? 1.0f : static_cast<float>(random() % 1000) / 1000.0f;
  return image;
}

TEST(Metrics, SelfTestRowsPass) {
  const auto rows = metric_self_test();
  EXPECT_GE(rows.size(), 20u);
  for (const SelfTest& row : rows)
    EXPECT_TRUE(row.pass()) << row.name << ": " << row.measured << ", expected " << row.expected;
}

TEST(Metrics, SelfTestRowFailsOnNan) { EXPECT_FALSE((SelfTest{"x", 0, std::nan(""), 1}).pass()); }

TEST(Metrics, EqualImagesHaveNoError) {
  const Image image = noise(40, 30, 1);
  const Errors errors = compare_images(image, image);
  EXPECT_EQ(errors.pixels, 1200);
  EXPECT_EQ(errors.rmse, 0);
  EXPECT_EQ(errors.max, 0);
  EXPECT_FALSE(errors.psnr);
  EXPECT_DOUBLE_EQ(errors.ssim.value(), 1);
  EXPECT_EQ(errors.flip_mean.value(), 0);
  EXPECT_EQ(errors.ciede2000_p99.value(), 0);
}

TEST(Metrics, UnequalSizesAndMasksAreErrors) {
  EXPECT_THROW(compare_images(grey(4, 4, 0), grey(4, 5, 0)), MetricError);
  EXPECT_THROW(compare_images(Image(), Image()), MetricError);
  EXPECT_THROW(flip_map(grey(4, 4, 0), grey(5, 4, 0)), MetricError);
  EXPECT_THROW(parity(grey(4, 4, 0), grey(5, 4, 0)), MetricError);
  EXPECT_THROW(signed_difference_picture(grey(4, 4, 0), grey(5, 4, 0)), MetricError);
  const std::vector<uint8_t> mask(15, 1);
  CompareOptions options;
  options.mask = mask;
  EXPECT_THROW(compare_images(grey(4, 4, 0), grey(4, 4, 0), options), MetricError);
}

TEST(Metrics, NonFinitePixelsAreCountedAndKeptOut) {
  const Image base = grey(32, 32, 0.5f);
  Image test = base, reference = base;
  test.pixel(3, 4)[2] = kNan;
  test.pixel(5, 6)[3] = std::numeric_limits<float>::infinity();
  reference.pixel(9, 9)[0] = kNan;
  const Errors errors = compare_images(test, reference);
  EXPECT_EQ(errors.non_finite, 3);
  EXPECT_EQ(errors.pixels, 32 * 32 - 3);
  EXPECT_EQ(errors.max, 0);
  EXPECT_EQ(errors.flip_mean.value(), 0);
  EXPECT_NEAR(errors.ssim.value(), 1, 1e-12);
}

TEST(Metrics, AllPixelsNonFinite) {
  const Errors errors = compare_images(grey(8, 8, kNan), grey(8, 8, 0));
  EXPECT_EQ(errors.non_finite, 64);
  EXPECT_EQ(errors.pixels, 0);
  EXPECT_EQ(errors.max_x, -1);
  EXPECT_FALSE(errors.psnr);
  EXPECT_FALSE(errors.flip_mean);
}

TEST(Metrics, ComparesOverTheBackground) {
  // Same premultiplied colour, other alpha: invisible over black, (a' - a) * background otherwise.
  const Image a = grey(16, 16, 0.25f, 0.5f), b = grey(16, 16, 0.25f, 0.25f);
  EXPECT_EQ(compare_images(a, b).max, 0);
  CompareOptions options;
  options.background = {0, 1, 0};
  const Errors errors = compare_images(a, b, options);
  EXPECT_DOUBLE_EQ(errors.bias[0], 0);
  EXPECT_DOUBLE_EQ(errors.bias[1], -0.25);
  EXPECT_DOUBLE_EQ(errors.alpha_max, 0.25);
  EXPECT_DOUBLE_EQ(errors.alpha_rmse, 0.25);
  EXPECT_FLOAT_EQ(composite(a, options.background).pixel(1, 1)[1], 0.75f);
  EXPECT_EQ(composite(a, options.background).pixel(1, 1)[3], 1);
}

TEST(Metrics, MaskRestrictsEveryFigure) {
  const Image base = grey(32, 32, 0.5f);
  Image test = base;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 16; ++x) std::fill_n(test.pixel(x, y), 3, 0.75f);
  std::vector<uint8_t> left(32 * 32), far_right(32 * 32);
  for (size_t i = 0; i < left.size(); ++i) {
    left[i] = i % 32 < 16;
    far_right[i] = i % 32 >= 30;  // beyond every filter's radius from the step but in the image
  }
  CompareOptions options;
  options.mask = left;
  const Errors on_left = compare_images(test, base, options);
  EXPECT_EQ(on_left.pixels, 512);
  EXPECT_DOUBLE_EQ(on_left.rmse, 0.25);
  EXPECT_DOUBLE_EQ(on_left.p50, 0.25);
  EXPECT_DOUBLE_EQ(on_left.over_1_255, 1);
  EXPECT_GT(on_left.flip_mean.value(), compare_images(test, base).flip_mean.value());
  options.mask = far_right;
  const Errors on_right = compare_images(test, base, options);
  EXPECT_EQ(on_right.rmse, 0);
  EXPECT_NEAR(on_right.flip_p99.value(), 0, 1e-9);
  EXPECT_FALSE(on_right.ssim) << "no window centre that near to the border";
}

TEST(Metrics, PercentilesAreRanks) {
  Image test = grey(10, 10, 0);
  for (int i = 0; i < 100; ++i) test.rgba[static_cast<size_t>(i) * 4] = static_cast<float>(i + 1);
  CompareOptions options;
  options.perceptual = false;
  const Errors errors = compare_images(test, grey(10, 10, 0), options);
  EXPECT_EQ(errors.p50, 50);
  EXPECT_EQ(errors.p95, 95);
  EXPECT_EQ(errors.p99, 99);
  EXPECT_EQ(errors.max, 100);
  EXPECT_FALSE(errors.flip_mean);
}

TEST(Metrics, OneHotPixelShowsInMaxOnly) {
  const Image base = grey(128, 128, 0.2f);
  Image test = base;
  std::fill_n(test.pixel(64, 30), 3, 0.9f);
  const Errors errors = compare_images(test, base);
  EXPECT_NEAR(errors.max, 0.7, 1e-6);
  EXPECT_EQ(errors.max_x, 64);
  EXPECT_EQ(errors.max_y, 30);
  EXPECT_LT(errors.flip_mean.value(), 0.01);
  EXPECT_GT(errors.ssim.value(), 0.98);
}

TEST(Parity, SeparatesSilhouetteFromInterior) {
  Image a = grey(20, 20, 0, 0);
  for (int y = 0; y < 20; ++y)
    for (int x = 10; x < 20; ++x) std::fill_n(a.pixel(x, y), 4, 0.5f);
  Image b = a;
  EXPECT_TRUE(parity(a, b).agree);
  EXPECT_EQ(parity(a, b).silhouette_pixels, 40);
  EXPECT_EQ(parity(a, b).interior_pixels, 360);
  std::fill_n(b.pixel(9, 5), 4, 0.5f);  // the edge, one pixel further: its neighbourhood is silhouette in b
  Parity moved = parity(a, b);
  EXPECT_EQ(moved.interior_over, 0);
  EXPECT_EQ(moved.silhouette_over, 1);
  EXPECT_FALSE(moved.agree) << "1 of 43 is more than 0.1 %";
  ParityLimits limits;
  limits.silhouette_fraction = 0.05;
  EXPECT_TRUE(parity(a, b, limits).agree);
  b = a;
  b.pixel(15, 5)[1] += 0.01f;
  moved = parity(a, b);
  EXPECT_EQ(moved.interior_over, 1);
  EXPECT_NEAR(moved.interior_max, 0.01, 1e-6);
  EXPECT_EQ(moved.interior_x, 15);
  EXPECT_EQ(moved.interior_y, 5);
  EXPECT_FALSE(moved.agree);
}

TEST(Parity, PicturesOfSurfacesHaveNoInterior) {
  const Image a = grey(40, 50, 0.5f);
  Image b = a;
  std::fill_n(b.pixel(20, 20), 3, 0.9f);  // one surface before another, a pixel further: alpha does not show it
  ParityLimits limits;
  EXPECT_FALSE(parity(a, b, limits).agree);
  limits.hidden_edges = true;
  EXPECT_TRUE(parity(a, b, limits).agree) << "1 of 2000";
  std::fill_n(b.pixel(20, 30), 3, 0.9f);
  std::fill_n(b.pixel(20, 40), 3, 0.9f);
  EXPECT_FALSE(parity(a, b, limits).agree) << "3 of 2000";
}

TEST(Parity, NonFiniteNeverAgrees) {
  const Image a = grey(6, 6, 0.5f);
  Image b = a;
  b.pixel(2, 2)[3] = kNan;
  const Parity result = parity(a, b);
  EXPECT_TRUE(std::isinf(result.interior_max));
  EXPECT_FALSE(result.agree);
}

TEST(Pictures, DifferenceIsGreyWhereEqualAndLighterWhereHigher) {
  const Image a = grey(4, 4, 0.5f);
  Image b = a;
  b.pixel(1, 1)[0] += 0.1f;
  b.pixel(2, 1)[0] = kNan;
  const Image picture = signed_difference_picture(b, a, 0.05);
  EXPECT_NEAR(picture.pixel(0, 0)[0], 0.21404, 1e-4);
  EXPECT_EQ(picture.pixel(1, 1)[0], 1);
  EXPECT_NEAR(picture.pixel(1, 1)[1], 0.21404, 1e-4);
  EXPECT_EQ(picture.pixel(2, 1)[1], 0);
  EXPECT_EQ(picture.pixel(2, 1)[2], 1);
}

TEST(Pictures, HeatMapRunsFromBlackToLight) {
  const std::vector<float> map{0, 0.5f, 1};
  const Image picture = flip_picture(map, 3, 1);
  for (int c = 0; c < 3; ++c) EXPECT_LT(picture.pixel(0, 0)[c], 0.01f);
  EXPECT_GT(picture.pixel(2, 0)[0], 0.9f);
  EXPECT_GT(picture.pixel(1, 0)[0], picture.pixel(1, 0)[1]);
  EXPECT_THROW(flip_picture(map, 2, 1), MetricError);
}

}  // namespace
}  // namespace volumark
