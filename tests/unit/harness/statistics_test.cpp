// Percentiles, bootstrap and fitted orders on samples whose answer is known.
#include "harness/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace volumark {
namespace {

TEST(Percentile, InterpolatesBetweenOrderStatistics) {
  EXPECT_EQ(percentile({3, 1, 2}, 0.5), 2);
  EXPECT_EQ(percentile({1, 2, 3, 4}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(percentile({0, 10}, 0.05), 0.5);
  EXPECT_EQ(percentile({7}, 0.95), 7);
  EXPECT_EQ(percentile({1, 2, 3}, 0), 1);
  EXPECT_EQ(percentile({1, 2, 3}, 1), 3);
  EXPECT_THROW(percentile({}, 0.5), std::invalid_argument);
}

TEST(Median, OddAndEven) {
  EXPECT_EQ(median({5, 1, 3}), 3);
  EXPECT_EQ(median({4, 1, 3, 2}), 2.5);
  EXPECT_THROW(median({}), std::invalid_argument);
}

TEST(Bootstrap, CoversTheTrueMedianAboutAsOftenAsItSays) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(10, 1);
  int covered = 0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> samples(30);
    for (double& sample : samples) sample = noise(random);
    const Interval interval = bootstrap_typical(samples, {}, 400, static_cast<uint64_t>(trial));
    covered += interval.lo <= 10 && 10 <= interval.hi;
  }
  EXPECT_GE(covered, kTrials * 88 / 100);
  EXPECT_LE(covered, kTrials * 995 / 1000);
}

TEST(Bootstrap, ViewsOfDifferentCostAreNoNoise) {
  // Two views, each perfectly steady: the median of the cell is certain, however far apart they are.
  const std::vector<double> samples = {1, 5, 1, 5, 1, 5, 1, 5};
  const std::vector<int64_t> views = {0, 1, 0, 1, 0, 1, 0, 1};
  const Interval certain = bootstrap_typical(samples, views);
  EXPECT_EQ(certain.lo, 3);
  EXPECT_EQ(certain.hi, 3);
  EXPECT_LT(bootstrap_typical(samples).lo, 3);
}

TEST(Typical, IsTheMeanOfTheViewsMedians) {
  // By hand: medians 2 (of 1, 2, 9) and 30 (of 10, 30, 50, and 30), so 16; the pooled median would be 10.
  const std::vector<double> samples = {1, 10, 2, 30, 9, 50, 30};
  const std::vector<int64_t> views = {0, 4, 0, 4, 0, 4, 4};
  EXPECT_EQ(typical(samples, views), 16);
  EXPECT_EQ(typical(samples), 10);
  EXPECT_EQ(stats_of(samples, views).median, 16);
  // Every figure that can be drawn anew: a median of the first view is 1, 2 or 9, one of the second at most 50.
  const Interval interval = bootstrap_typical(samples, views);
  EXPECT_GE(interval.lo, (1 + 10) / 2.0);
  EXPECT_LE(interval.hi, (9 + 50) / 2.0);
  EXPECT_LE(interval.lo, 16);
  EXPECT_GE(interval.hi, 16);
}

TEST(Bootstrap, OfTwoSamplesAsCountedByHand) {
  // Drawn anew, two samples 1 and 3 have the median 1, 2, 2 or 3 with equal chance: 95 % reach from 1 to 3.
  const Interval interval = bootstrap_typical(std::vector<double>{1, 3});
  EXPECT_EQ(interval.lo, 1);
  EXPECT_EQ(interval.hi, 3);
}

TEST(Bootstrap, IsRepeatable) {
  const std::vector<double> samples = {1, 2, 3, 4, 5, 6, 7};
  EXPECT_EQ(bootstrap_typical(samples).lo, bootstrap_typical(samples).lo);
  EXPECT_THROW(bootstrap_typical({}), std::invalid_argument);
  EXPECT_THROW(bootstrap_typical(samples, std::vector<int64_t>{1}), std::invalid_argument);
}

TEST(Stats, OfSamples) {
  const std::vector<double> samples = {4, 1, 3, 2, 10};
  const Stats stats = stats_of(samples);
  EXPECT_EQ(stats.count, 5);
  EXPECT_EQ(stats.median, 3);
  EXPECT_EQ(stats.mean, 4);
  EXPECT_EQ(stats.min, 1);
  EXPECT_EQ(stats.max, 10);
  EXPECT_LE(stats.median_lo, 3);
  EXPECT_GE(stats.median_hi, 3);
  EXPECT_EQ(stats_of({}).count, 0);
}

const std::vector<double> kSteps = {4, 2, 1, 0.5, 0.25, 0.125};

std::vector<double> power(double order, double factor = 0.01) {
  std::vector<double> errors;
  for (const double step : kSteps) errors.push_back(factor * std::pow(step, order));
  return errors;
}

TEST(FitOrder, FindsThePower) {
  for (const double order : {1.0, 2.0, 4.0}) {
    const OrderFit fit = fit_order(kSteps, power(order), 0);
    EXPECT_NEAR(fit.order, order, 1e-12);
    EXPECT_EQ(fit.points, 6);
    EXPECT_EQ(fit.floor, 0);
  }
}

TEST(FitOrder, AFloorIsNamedAndLeftOut) {
  std::vector<double> errors = power(2);
  errors[4] = errors[5] = 1e-3;
  const OrderFit fit = fit_order(kSteps, errors, 0);
  EXPECT_NEAR(fit.order, 2, 1e-12);
  EXPECT_EQ(fit.points, 4);
  EXPECT_EQ(fit.floor, 1e-3);
}

TEST(FitOrder, ErrorsAtTheReferencesBoundDoNotCount) {
  const OrderFit fit = fit_order(kSteps, power(2), 2.5e-4);  // the last two are within three bounds
  EXPECT_EQ(fit.points, 4);
  EXPECT_EQ(fit.floor, 0.01 * 0.125 * 0.125);
}

TEST(FitOrder, CoarseStepsOutsideTheAsymptoticRangeAreLeftOut) {
  std::vector<double> errors = power(2);
  errors[0] = errors[1] * 1.4;  // saturated
  const OrderFit fit = fit_order(kSteps, errors, 0);
  EXPECT_EQ(fit.points, 5);
  EXPECT_NEAR(fit.order, 2, 1e-12);
}

TEST(FitOrder, APlateauOfCoarseStepsIsNoFloor) {
  std::vector<double> errors = power(2);
  errors[0] = errors[1] = errors[2];  // three steps that see nothing of the field
  const OrderFit fit = fit_order(kSteps, errors, 0);
  EXPECT_EQ(fit.floor, 0);
  EXPECT_EQ(fit.points, 4);
  EXPECT_NEAR(fit.order, 2, 1e-12);
  errors[5] = errors[4];  // and one at the other end, which is one
  const OrderFit both = fit_order(kSteps, errors, 0);
  EXPECT_EQ(both.floor, errors[4]);
  EXPECT_EQ(both.points, 3);
  EXPECT_NEAR(both.order, 2, 1e-12);
  const OrderFit flat = fit_order(kSteps, std::vector<double>(6, 0.5), 0);
  EXPECT_EQ(flat.points, 0) << "a plateau has no order";
  EXPECT_EQ(flat.floor, 0.5);
}

TEST(FitOrder, TooFewPointsAreNotFitted) {
  EXPECT_EQ(fit_order(std::vector<double>{2, 1}, std::vector<double>{4, 1}, 0).points, 0);
  EXPECT_EQ(fit_order(kSteps, std::vector<double>(6, 0.0), 0).points, 0);
  EXPECT_EQ(fit_order(kSteps, std::vector<double>(6, NAN), 0).points, 0);
  EXPECT_THROW(fit_order(kSteps, std::vector<double>(5, 1.0), 0), std::invalid_argument);
}

TEST(FitOrder, TheIntervalWidensWithTheScatter) {
  std::vector<double> errors = power(2);
  for (size_t i = 0; i < errors.size(); ++i) errors[i] *= i % 2 == 0 ? 1.05 : 0.95;
  const OrderFit fit = fit_order(kSteps, errors, 0);
  EXPECT_EQ(fit.points, 6);
  EXPECT_LT(fit.lo, 2);
  EXPECT_GT(fit.hi, 2);
  EXPECT_GT(fit.hi - fit.lo, 0.02);
}

}  // namespace
}  // namespace volumark
