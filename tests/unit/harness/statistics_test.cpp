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
    const Interval interval = bootstrap_median(samples, {}, 400, static_cast<uint64_t>(trial));
    covered += interval.lo <= 10 && 10 <= interval.hi;
  }
  EXPECT_GE(covered, kTrials * 88 / 100);
  EXPECT_LE(covered, kTrials * 995 / 1000);
}

TEST(Bootstrap, ViewsOfDifferentCostAreNoNoise) {
  // Two views, each perfectly steady: the median of the cell is certain, however far apart they are.
  const std::vector<double> samples = {1, 5, 1, 5, 1, 5, 1, 5};
  const std::vector<int64_t> views = {0, 1, 0, 1, 0, 1, 0, 1};
  const Interval certain = bootstrap_median(samples, views);
  EXPECT_EQ(certain.lo, 3);
  EXPECT_EQ(certain.hi, 3);
  EXPECT_LT(bootstrap_median(samples).lo, 3);
}

TEST(Bootstrap, IsRepeatable) {
  const std::vector<double> samples = {1, 2, 3, 4, 5, 6, 7};
  EXPECT_EQ(bootstrap_median(samples).lo, bootstrap_median(samples).lo);
  EXPECT_THROW(bootstrap_median({}), std::invalid_argument);
  EXPECT_THROW(bootstrap_median(samples, std::vector<int64_t>{1}), std::invalid_argument);
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
