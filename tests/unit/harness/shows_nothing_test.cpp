// Views that show the background alone: every picture of nothing is equal, and that praises no method.
#include "tests/unit/harness/tiny_run.h"

namespace volumark {
namespace {

using ShowsNothing = TinyRun;

TEST_F(ShowsNothing, ACellWithoutAnythingToSeeHasNoError) {
  Json empty = scene();
  for (Json& point : empty["transfer"]["points"]) point["extinction"] = 0;
  Json json = experiment({{{"method", "raycast"}}});
  json["limits"] = {{"rmse", 1e-3}};
  json["attribute"] = true;
  const RunOutcome outcome = run(json, empty);
  const Result& result = outcome.results.results.at(0);
  EXPECT_EQ(result.outcome, Outcome::Ok) << result.reason;
  EXPECT_FALSE(result.error);
  EXPECT_NE(result.reason.find("background"), std::string::npos) << result.reason;
  ASSERT_EQ(result.views.size(), 2U);
  for (const ViewResult& view : result.views) {
    EXPECT_TRUE(view.shows_nothing);
    ASSERT_TRUE(view.error);
    EXPECT_EQ(view.error->regions.size(), 1U);
    EXPECT_EQ(view.error->regions.at("background").pixels, 32 * 32);
  }
  EXPECT_TRUE(outcome.results.attribution.empty());
  EXPECT_TRUE(validate_results(to_json(outcome.results)).empty());
}

TEST_F(ShowsNothing, SuchAViewIsLeftOutOfTheCellsError) {
  Json turned = scene();
  const auto view = [](double z) {
    return Json{{"eye", {0, 0, 3}}, {"target", {0, 0, z}}, {"up", {0, 1, 0}}, {"half_height", 1.5}, {"near", 0.01}};
  };
  turned["views"] = {view(0), view(6)};  // the second looks away
  const RunOutcome outcome = run(experiment({{{"method", "raycast"}}}), turned);
  const Result& result = outcome.results.results.at(0);
  ASSERT_EQ(result.outcome, Outcome::Ok) << result.reason;
  EXPECT_FALSE(result.views.at(0).shows_nothing);
  EXPECT_TRUE(result.views.at(1).shows_nothing);
  ASSERT_TRUE(result.error);
  EXPECT_GT(result.views[0].error->rmse, 0);
  EXPECT_EQ(result.error->mean.rmse, result.views[0].error->rmse);  // not halved by the empty one
  EXPECT_EQ(result.error->worst.pixels, 32 * 32);
}

// The null backend draws nothing at all: that is an error where there is something to see.
TEST_F(ShowsNothing, APictureOfNothingIsNotSuchAView) {
  Json json = experiment({{{"method", "raycast"}}});
  json["backends"] = {"null"};
  const RunOutcome outcome = run(json);
  const Result& result = outcome.results.results.at(0);
  EXPECT_FALSE(result.views.at(0).shows_nothing);
  ASSERT_TRUE(result.error);
  EXPECT_GT(result.error->worst.rmse, 0.1);
}

}  // namespace
}  // namespace volumark
