// The jump between two views: its definition, and that a stack of slices that switches has one.
#include "harness/jump.h"

#include <gtest/gtest.h>

#include "reports/measures.h"
#include "tests/unit/harness/tiny_run.h"

namespace volumark {
namespace {

Image grey(float value, float alpha = 1) {
  Image out(2, 2);
  for (size_t i = 0; i < out.rgba.size(); ++i) out.rgba[i] = i % 4 == 3 ? alpha : value;
  return out;
}

View at_angle(double degrees) {
  const double a = degrees * 3.14159265358979 / 180;
  View view;
  view.eye = {3 * std::sin(a), 0, 3 * std::cos(a)};
  return view;
}

// Three views at 0, 1 and 20 degrees; references of .5, .6 and .7.
struct Path {
  SceneContext context;
  std::map<int, Image> pictures;
  Result result;
  Path() {
    for (const double angle : {0.0, 1.0, 20.0}) context.scene.views.push_back(at_angle(angle));
    for (int view = 0; view < 3; ++view) {
      context.references[view].image = grey(0.5F + 0.1F * static_cast<float>(view));
      result.views.emplace_back();
      result.views.back().index = view;
    }
  }
};

TEST(Jump, IsTheChangeOfTheErrorAndNotOfThePicture) {
  Path path;
  path.pictures = {{0, grey(0.5F)}, {1, grey(0.6F)}, {2, grey(0.9F)}};
  measure_jumps(path.context, path.pictures, path.result);
  ASSERT_TRUE(path.result.views[1].jump);
  EXPECT_NEAR(*path.result.views[1].jump, 0, 1e-7);  // the picture changes as the truth does
  path.pictures[0] = grey(0.48F);
  path.pictures[1] = grey(0.63F);
  measure_jumps(path.context, path.pictures, path.result);
  EXPECT_NEAR(*path.result.views[1].jump, 0.05, 1e-6);
  EXPECT_FALSE(path.result.views[0].jump);  // the first has no view before it
  EXPECT_FALSE(path.result.views[2].jump);  // 19 degrees are no neighbourhood
}

TEST(Jump, IsOfPicturesOverTheBackground) {
  Path path;
  path.context.scene.background = glm::dvec3(1);
  path.pictures = {{0, grey(0.5F)}, {1, grey(0.2F, 0.5F)}};  // .2 + .5 over white: .7, an error of .1
  measure_jumps(path.context, path.pictures, path.result);
  EXPECT_NEAR(*path.result.views[1].jump, 0.1, 1e-6);
}

TEST(Jump, NeedsBothPicturesAndFiniteOnes) {
  Path path;
  path.pictures = {{1, grey(0.6F)}};
  measure_jumps(path.context, path.pictures, path.result);
  EXPECT_FALSE(path.result.views[1].jump);
  path.pictures[0] = grey(std::nanf(""));
  measure_jumps(path.context, path.pictures, path.result);
  EXPECT_FALSE(path.result.views[1].jump);
}

using JumpRun = TinyRun;

TEST_F(JumpRun, AStackThatSwitchesJumpsAndViewAlignedSlicesDoNot) {
  Json turning = scene();
  Json orbits = Json::array();
  for (const double azimuth : {44.9, 45.1}) {
    Json view = turning["views"][0];
    view["orbit"]["azimuth"] = azimuth;
    view["orbit"]["count"] = 1;
    orbits.push_back(view);
  }
  turning["views"] = orbits;
  const RunOutcome outcome = run(experiment({{{"method", "slices2d"}}, {{"method", "texture3d_slices"}}}), turning);
  ASSERT_EQ(outcome.results.results.size(), 2U);
  EXPECT_TRUE(validate_results(to_json(outcome.results)).empty());
  std::map<std::string, double> jump;
  for (const Result& result : outcome.results.results) {
    ASSERT_EQ(result.outcome, Outcome::Ok) << result.reason;
    EXPECT_EQ(result.views[0].counters.contains("stack_axis"), result.key.method == "slices2d");
    const std::optional<Measured> found = measured(result, "error.jump");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->value, *result.views[1].jump);
    EXPECT_LE(found->lo, found->value);
    jump[result.key.method] = found->value;
  }
  EXPECT_GT(jump["slices2d"], 3 * jump["texture3d_slices"]);
}

}  // namespace
}  // namespace volumark
