// Fronts and time to error on points whose answer is known.
#include "reports/analysis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/reports/sample_results.h"

namespace volumark {
namespace {

CostPoint point(double time, double error) { return {time, time, time, error, 0}; }

TEST(ParetoFront, KeepsOnlyWhatNothingBeats) {
  const std::vector<CostPoint> points = {point(4, 0.1), point(1, 1), point(2, 2), point(2, 0.5), point(3, 0.5)};
  EXPECT_EQ(pareto_front(points), (std::vector<size_t>{1, 3, 0}));
  EXPECT_TRUE(pareto_front({}).empty());
}

TEST(ParetoFront, EqualPointsCountOnce) {
  const std::vector<CostPoint> points = {point(1, 1), point(1, 1)};
  EXPECT_EQ(pareto_front(points), (std::vector<size_t>{0}));
}

TEST(TimeToError, InterpolatesAlongAPowerLaw) {
  // error = 1 / time^2: the answer is exact in log-log.
  const std::vector<CostPoint> points = {point(1, 1), point(10, 0.01), point(100, 1e-4)};
  const TimeToError found = time_to_error(points, 1e-3);
  ASSERT_TRUE(found.seconds);
  EXPECT_NEAR(*found.seconds, std::sqrt(1000.0), 1e-9);
  EXPECT_TRUE(found.interpolated);
  EXPECT_EQ(found.best_error, 1e-4);
}

TEST(TimeToError, NotReachedNamesTheBest) {
  const std::vector<CostPoint> points = {point(1, 1), point(2, 0.1), point(3, 0.2)};
  const TimeToError found = time_to_error(points, 0.01);
  EXPECT_FALSE(found.seconds);
  EXPECT_EQ(found.best_error, 0.1);
  EXPECT_EQ(found.best_seconds, 2);
  EXPECT_TRUE(std::isinf(time_to_error({}, 0.01).best_error));
}

TEST(TimeToError, FirstPointAndExactHitsAreMeasured) {
  const std::vector<CostPoint> points = {point(1, 1e-3), point(2, 1e-4), point(3, 0)};
  EXPECT_EQ(time_to_error(points, 1e-2).seconds, 1);
  EXPECT_FALSE(time_to_error(points, 1e-2).interpolated);
  EXPECT_EQ(time_to_error(points, 1e-4).seconds, 2);
  EXPECT_EQ(time_to_error(points, 1e-9).seconds, 3);  // towards an error of zero nothing is interpolated
}

TEST(CostPoint, ErrorIsNeverBelowTheReferencesBound) {
  Results results = sample_results();
  results.results[0].views[0].reference->bound = 0.5;
  EXPECT_EQ(cost_point(results, 0, "rmse")->error, 0.5);
  EXPECT_EQ(cost_point(results, 0, "rmse")->time, 0.02);
  EXPECT_FALSE(cost_point(results, 1, "rmse"));  // unsupported
  EXPECT_THROW(cost_point(results, 0, "beauty"), ResultsError);
}

}  // namespace
}  // namespace volumark
