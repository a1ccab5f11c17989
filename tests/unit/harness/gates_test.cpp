// When an image is wrong, and the worst and mean over views.
#include "harness/gates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace volumark {
namespace {

ErrorMetrics fine() {
  ErrorMetrics errors;
  errors.rmse = 0.001;
  errors.max = 0.01;
  errors.bias = {0.0001, -0.0002, 0};
  errors.flip_p99 = 0.02;
  return errors;
}

const std::map<std::string, double> kLimits = {{"rmse", 0.002}, {"max", 0.02}, {"bias", 0.0005}, {"flip_p99", 0.03}};

TEST(Gates, AGoodImagePasses) {
  EXPECT_FALSE(wrong_image_reason(fine(), kLimits));
  EXPECT_FALSE(wrong_image_reason(fine(), {}));
}

TEST(Gates, EachFigureGatesAlone) {
  ErrorMetrics bad = fine();
  bad.rmse = 0.003;
  EXPECT_NE(wrong_image_reason(bad, kLimits)->find("rmse"), std::string::npos);
  bad = fine();
  bad.max = 0.03;
  EXPECT_NE(wrong_image_reason(bad, kLimits)->find("max"), std::string::npos);
  bad = fine();
  bad.bias = {0, -0.001, 0};
  EXPECT_NE(wrong_image_reason(bad, kLimits)->find("bias"), std::string::npos);
  bad = fine();
  bad.flip_p99 = 0.5;
  EXPECT_NE(wrong_image_reason(bad, kLimits)->find("flip_p99"), std::string::npos);
}

TEST(Gates, NonFinitePixelsFailWithoutAnyLimit) {
  ErrorMetrics bad = fine();
  bad.non_finite = 1;
  EXPECT_NE(wrong_image_reason(bad, {})->find("NaN"), std::string::npos);
}

TEST(Gates, AFigureThatIsNotANumberFailsItsLimit) {
  ErrorMetrics bad = fine();
  bad.rmse = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(wrong_image_reason(bad, kLimits));
}

TEST(OverViews, WorstOfEachAndMean) {
  ErrorMetrics a = fine(), b = fine();
  a.rmse = 0.1;
  b.max = 0.5;
  b.max_x = 7;
  a.bias = {0.01, 0, 0};
  b.bias = {-0.02, 0, 0};
  a.ssim = 0.9;
  b.ssim = 0.5;
  a.psnr = std::numeric_limits<double>::infinity();
  b.psnr = 30;
  b.non_finite = 2;
  const CellError error = over_views({a, b});
  EXPECT_EQ(error.worst.rmse, 0.1);
  EXPECT_EQ(error.worst.max, 0.5);
  EXPECT_EQ(error.worst.max_x, 7);
  EXPECT_EQ(error.worst.bias[0], -0.02);
  EXPECT_EQ(error.worst.ssim, 0.5);
  EXPECT_EQ(error.worst.psnr, 30);
  EXPECT_EQ(error.worst.non_finite, 2);
  EXPECT_DOUBLE_EQ(error.mean.rmse, (0.1 + 0.001) / 2);
  EXPECT_DOUBLE_EQ(error.mean.ssim, 0.7);
  EXPECT_DOUBLE_EQ(error.mean.bias[0], -0.005);
  EXPECT_THROW(over_views({}), std::invalid_argument);
}

TEST(OverViews, NotANumberIsTheWorst) {
  ErrorMetrics a = fine(), b = fine();
  b.ssim = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(over_views({a, b}).worst.ssim));
  EXPECT_TRUE(std::isnan(over_views({b, a}).worst.ssim));
}

}  // namespace
}  // namespace volumark
