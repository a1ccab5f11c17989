// Orders of convergence from cells.
#include "harness/convergence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace volumark {
namespace {

Result cell(const std::string& scene, double step, double rmse, double expected) {
  Result result;
  result.key = {"e", scene, "m", "cpu", {{"step", step}, {"mode", std::string("post")}}};
  result.quality = Quality{"step", step};
  result.outcome = Outcome::Ok;
  result.error = CellError{};
  result.error->worst.rmse = rmse;
  result.order.expected = expected;
  return result;
}

Results series(const std::string& scene, double order, double expected) {
  Results results;
  for (const double step : {0.5, 4.0, 1.0, 2.0})  // in any order
    results.results.push_back(cell(scene, step, 0.01 * std::pow(step, order), expected));
  return results;
}

std::vector<Experiment> expecting(const std::string& scene) {
  Experiment experiment;
  experiment.name = "e";
  experiment.expect_order_on = {scene};
  return {experiment};
}

TEST(Convergence, TheExpectedOrderPassesAnotherFails) {
  Results good = series("smooth", 2, 2);
  fit_convergence(good, expecting("smooth"));
  ASSERT_EQ(good.convergence.size(), 1U);
  EXPECT_EQ(good.convergence[0].verdict, "pass");
  EXPECT_NEAR(good.convergence[0].fitted, 2, 1e-9);
  EXPECT_EQ(good.convergence[0].values, (std::vector<double>{4, 2, 1, 0.5}));
  EXPECT_FALSE(good.convergence[0].key.params.contains("step"));
  EXPECT_NEAR(*good.results[0].order.fitted, 2, 1e-9);
  Results bad = series("smooth", 1, 2);
  fit_convergence(bad, expecting("smooth"));
  EXPECT_EQ(bad.convergence[0].verdict, "fail");
}

TEST(Convergence, AnOrderAboveTheExpectedOneIsSaid) {
  Results within = series("smooth", 2.2, 2), above = series("smooth", 2.3, 2);
  fit_convergence(within, expecting("smooth"));
  fit_convergence(above, expecting("smooth"));
  EXPECT_EQ(within.convergence[0].verdict, "pass");
  EXPECT_EQ(within.convergence[0].reason, "");
  EXPECT_EQ(above.convergence[0].verdict, "pass");
  EXPECT_NE(above.convergence[0].reason.find("2.30"), std::string::npos) << above.convergence[0].reason;
}

TEST(Convergence, AxesThatCountSlicesRunUpwards) {
  Results results;
  for (const double percent : {400., 100., 800., 200.}) {
    Result result = cell("smooth", percent, 100 / (percent * percent), 2);
    result.key.method = "slices2d";
    result.key.params = {{"slices", percent}};
    result.quality = Quality{"slices", percent};
    results.results.push_back(result);
  }
  fit_convergence(results, expecting("smooth"));
  ASSERT_EQ(results.convergence.size(), 1U);
  EXPECT_EQ(results.convergence[0].values, (std::vector<double>{100, 200, 400, 800})) << "coarse first";
  EXPECT_NEAR(results.convergence[0].fitted, 2, 1e-9) << "in the distance of the slices";
  EXPECT_EQ(results.convergence[0].verdict, "pass");
}

TEST(Convergence, NoVerdictWhereNoneIsPromised) {
  Results rough = series("rough", 1, 2);
  fit_convergence(rough, expecting("smooth"));
  EXPECT_EQ(rough.convergence[0].verdict, "not stated");
  Results unknown = series("smooth", 1, 0);
  fit_convergence(unknown, expecting("smooth"));
  EXPECT_EQ(unknown.convergence[0].verdict, "not stated");
}

TEST(Convergence, TwoValuesAreNotResolved) {
  Results results = series("smooth", 2, 2);
  results.results.resize(2);
  fit_convergence(results, expecting("smooth"));
  EXPECT_EQ(results.convergence[0].verdict, "not resolved");
  EXPECT_FALSE(results.results[0].order.fitted);
}

TEST(Convergence, AnExpectedOrderThatDoesNotShowIsBadNews) {
  Results results;
  const double errors[] = {1e-2, 9e-3, 3e-3, 2.9e-3};  // falls by fits and starts
  for (int i = 0; i < 4; ++i) results.results.push_back(cell("smooth", 4.0 / (1 << i), errors[i], 2));
  fit_convergence(results, expecting("smooth"));
  EXPECT_EQ(results.convergence[0].verdict, "not resolved");
  EXPECT_TRUE(is_bad_news(results.convergence[0]));
  fit_convergence(results, expecting("another"));
  EXPECT_EQ(results.convergence[0].verdict, "not stated");
  EXPECT_FALSE(is_bad_news(results.convergence[0]));
  results.results.resize(2);  // the user chose two values: nothing was to be seen
  fit_convergence(results, expecting("smooth"));
  EXPECT_EQ(results.convergence[0].verdict, "not resolved");
  EXPECT_FALSE(is_bad_news(results.convergence[0]));
}

TEST(Convergence, ErrorsAtTheReferencesBoundAreNoFailure) {
  Results results = series("smooth", 0, 2);  // 0.01 everywhere
  for (Result& result : results.results) {
    result.views.emplace_back();
    result.views[0].reference = ReferenceInfo{"", "", 0.005, false, {}};
  }
  fit_convergence(results, expecting("smooth"));
  EXPECT_EQ(results.convergence[0].verdict, "at the bound");
  EXPECT_FALSE(is_bad_news(results.convergence[0]));
}

TEST(Convergence, SeriesDifferInTheirOtherParameters) {
  Results results = series("smooth", 2, 2);
  for (const Result& other : series("smooth", 1, 1).results) {
    results.results.push_back(other);
    results.results.back().key.params["mode"] = std::string("pre");
  }
  fit_convergence(results, expecting("smooth"));
  ASSERT_EQ(results.convergence.size(), 2U);
  EXPECT_EQ(results.convergence[0].verdict, "pass");
  EXPECT_EQ(results.convergence[1].verdict, "pass");
}

}  // namespace
}  // namespace volumark
