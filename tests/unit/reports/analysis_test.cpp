// Fronts and time to error on points whose answer is known.
#include "reports/analysis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/reports/sample_results.h"

namespace volumark {
namespace {

CostPoint point(double time, double error) { return {time, time, time, error, error, error, 0}; }

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

TEST(TimeToError, SaysBetweenWhichCellsItLies) {
  std::vector<CostPoint> points = {point(4, 1e-4), point(1, 1), point(3, 0.9), point(2, 1e-2)};  // the third is beaten
  for (size_t i = 0; i < points.size(); ++i) points[i].result = 10 + i;
  const TimeToError between = time_to_error(points, 1e-3);
  ASSERT_TRUE(between.seconds);
  EXPECT_NEAR(*between.seconds, std::sqrt(8.0), 1e-12);  // half way in the logarithm between 2 and 4
  EXPECT_EQ(between.coarse, 13U);
  EXPECT_EQ(between.fine, 10U);
  EXPECT_EQ(between.best, 10U);
  const TimeToError exact = time_to_error(points, 1e-2);
  EXPECT_EQ(exact.coarse, 13U);
  EXPECT_EQ(exact.fine, 13U);
}

// Three results of one scene: two methods on cpu, and the first on a backend that is hardware.
Results three_cells() {
  Results results = sample_results();
  Result slow = results.results[0];
  slow.key.method = "slices";
  slow.metrics->frame_wall.stats.median = 0.03;  // slower and worse: beaten by the first
  slow.error->worst.rmse = slow.views[0].error->rmse = 0.02;
  Result gpu = results.results[0];
  gpu.key.backend = "gl";
  results.results = {results.results[0], slow, gpu};
  results.backends.push_back(results.backends[0]);
  results.backends[1].id = "gl";
  results.backends[1].software = false;
  return results;
}

TEST(Fronts, OfMethodsBackendsAndAllButNeverSoftwareWithHardware) {
  const Results results = three_cells();
  const std::vector<Front> found = fronts(results, "quick", "sphere", "rmse");
  const auto size_of = [&](const char* method, const char* backend, bool software) -> int {
    for (const Front& front : found)
      if (front.method == method && front.backend == backend && front.software == software)
        return static_cast<int>(front.points.size());
    return -1;
  };
  EXPECT_EQ(size_of("raycast", "cpu", true), 1);
  EXPECT_EQ(size_of("slices", "cpu", true), 1);  // alone nothing beats it
  EXPECT_EQ(size_of("raycast", "gl", false), 1);
  EXPECT_EQ(size_of("raycast", "", true), 1);
  EXPECT_EQ(size_of("", "cpu", true), 1);  // raycast beats slices
  EXPECT_EQ(size_of("", "", true), 1);
  EXPECT_EQ(size_of("", "", false), 1);
  for (const Front& front : found) {
    if (front.method.empty() && front.backend.empty() && front.software) {
      EXPECT_EQ(front.points[0].result, 0U);
    }
  }
  EXPECT_TRUE(fronts(results, "quick", "cloud", "rmse").empty());
}

TEST(CostPoint, TheErrorsRangeIsThatOfTheViewsWidenedByTheBound) {
  Results results = sample_results();
  Result& cell = results.results[0];  // view 0: rmse 0.01, bound 1e-6
  cell.views.push_back(cell.views[0]);
  cell.views[1].error->rmse = 0.004;
  cell.views[1].reference->bound = 1e-4;
  const CostPoint rmse = *cost_point(results, 0, "rmse");
  EXPECT_EQ(rmse.error, 0.01);
  EXPECT_DOUBLE_EQ(rmse.error_lo, 0.004 - 1e-4);
  EXPECT_DOUBLE_EQ(rmse.error_hi, 0.01 + 1e-6);
  cell.views[0].error->flip_p99 = cell.error->worst.flip_p99 = 0.3;
  cell.views[1].error->flip_p99 = 0.1;
  const CostPoint flip = *cost_point(results, 0, "flip_p99");
  EXPECT_DOUBLE_EQ(flip.error_lo, 0.1);
  EXPECT_DOUBLE_EQ(flip.error_hi, 0.3);
}

TEST(CostPoint, ViewsThatShowNothingArePraisedForNothing) {
  Results results = sample_results();
  Result& cell = results.results[0];
  EXPECT_TRUE(cost_point(results, 0, "rmse"));
  cell.views.push_back(cell.views[0]);
  cell.views[1].error->rmse = 0;
  cell.views[1].shows_nothing = true;
  EXPECT_TRUE(a_view_shows_nothing(cell));
  EXPECT_GT(cost_point(results, 0, "rmse")->error_lo, 0.009);  // of the other view
  cell.views[0].shows_nothing = true;
  EXPECT_FALSE(cost_point(results, 0, "rmse"));
}

TEST(CostPoint, AnotherPictureThanTheScenesIsNotRanked) {
  Results results = sample_results();
  results.results[0].key.variant = "none";
  EXPECT_FALSE(cost_point(results, 0, "rmse"));
  results.results[0].key.variant.clear();
  results.results[0].ignored_effects = {"lighting"};
  EXPECT_FALSE(cost_point(results, 0, "rmse"));
}

TEST(CostPoint, PixelsThatAreNotFiniteAreNotRanked) {
  Results results = sample_results();
  ASSERT_TRUE(cost_point(results, 0, "rmse"));
  results.results[0].error->worst.non_finite = 1;  // figures leave it out: the error of the others may be small
  EXPECT_FALSE(error_counts(results.results[0]));
  EXPECT_FALSE(cost_point(results, 0, "rmse"));
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
