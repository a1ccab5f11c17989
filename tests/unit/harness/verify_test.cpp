// The suite itself: what it refuses, that nothing is left out silently, and that it sees what it is for.
#include "harness/verify/verify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "harness/verify/case_run.h"
#include "harness/verify/edges.h"
#include "harness/verify/sensitivity.h"
#include "harness/verify/test_scenes.h"

namespace volumark {
namespace {

using testing::HasSubstr;

class FakeMethod final : public Method {
 public:
  MethodInfo described{.name = "fake", .title = "none", .paper = "", .parameters = {kStep().info()}, .effects = {}};
  std::optional<std::string> refusal;

  const MethodInfo& info() const override { return described; }
  std::optional<std::string> unsupported(const Scene&, const Values&, const BackendInfo&) const override {
    return refusal;
  }
  std::unique_ptr<PreparedMethod> prepare(const Scene&, const Values&, Device&) const override {
    throw std::runtime_error("it broke");
  }
  Format target_format(const Values&) const override { return Format::RGBA32F; }

 private:
  static const Number& kStep() {
    static const Number step{{"step", "voxels", "", 1, 1e-6, 1e6, {2, 1}}};
    return step;
  }
};

VerifyOptions options_with(const FakeMethod& method) {
  VerifyOptions options;
  options.backends = {"null"};
  options.method_list = {&method};
  options.cases = {"slab"};
  return options;
}

TEST(HardCaseList, IdsAreUniqueAndEveryCaseIsThere) {
  std::set<std::string> ids, numbers;
  for (const HardCase& hard_case : hard_case_list()) {
    EXPECT_TRUE(ids.insert(hard_case.id).second) << hard_case.id;
    numbers.insert(hard_case.number);
    EXPECT_FALSE(std::string(hard_case.title).empty());
    EXPECT_FALSE(std::string(hard_case.source).empty());
    const bool has_function = hard_case.check != nullptr;
    EXPECT_EQ(has_function, hard_case.needs != CaseNeeds::Absent && hard_case.needs != CaseNeeds::Scenes);
  }
  for (int number = 1; number <= 25; ++number) EXPECT_TRUE(numbers.contains(std::to_string(number))) << number;
}

TEST(Verify, AMethodThatThrowsIsAnErrorAndNotAGap) {
  const FakeMethod method;
  const VerifyOutcome outcome = verify(options_with(method));
  ASSERT_EQ(outcome.rows.size(), 1U);
  EXPECT_EQ(outcome.rows[0].outcome, "error");
  EXPECT_THAT(outcome.rows[0].reason, HasSubstr("it broke"));
  EXPECT_TRUE(verify_failed(outcome));
  EXPECT_THAT(outcome.rows[0].command, HasSubstr("verify --case slab --method fake --backend null"));
}

TEST(Verify, WhatCannotBeDrawnIsSaid) {
  FakeMethod method;
  method.refusal = "no reason at all";
  const VerifyOutcome outcome = verify(options_with(method));
  ASSERT_EQ(outcome.rows.size(), 1U);
  EXPECT_EQ(outcome.rows[0].outcome, "not_applicable");
  EXPECT_EQ(outcome.rows[0].reason, "no reason at all");
  EXPECT_FALSE(verify_failed(outcome));
}

TEST(Verify, ExemptionsArePrintedAndMustNameACase) {
  FakeMethod method;
  method.described.exempt = {{"slab", "it draws no slabs"}};
  const VerifyOutcome outcome = verify(options_with(method));
  ASSERT_EQ(outcome.rows.size(), 1U);
  EXPECT_EQ(outcome.rows[0].outcome, "not_applicable");
  EXPECT_EQ(outcome.rows[0].reason, "it draws no slabs");
  method.described.exempt = {{"slap", "a slip"}};
  EXPECT_THROW(verify(options_with(method)), std::invalid_argument);
}

TEST(Verify, RefusesUnknownNamesWithTheNearest) {
  const FakeMethod method;
  for (const auto& [member, wrong] : {std::pair{&VerifyOptions::cases, "slabs"},
                                      {&VerifyOptions::backends, "nul"},
                                      {&VerifyOptions::methods, "fale"}}) {
    VerifyOptions options = options_with(method);
    options.*member = {wrong};
    try {
      verify(options);
      FAIL() << wrong;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), HasSubstr(wrong));
      EXPECT_THAT(error.what(), HasSubstr("did you mean"));
    }
  }
}

TEST(Verify, AStopLeavesWhatWasDone) {
  const FakeMethod method;
  std::atomic<bool> stop{true};
  VerifyOptions options = options_with(method);
  options.stop = &stop;
  const VerifyOutcome outcome = verify(options);
  EXPECT_TRUE(outcome.rows.empty());
  EXPECT_TRUE(outcome.interrupted);
}

TEST(CaseRun, NaNIsBeyondEveryBound) {
  CaseRun run({.hard_case = &hard_case_list().front()});
  run.add({.check = "NaN", .expected = 1, .measured = std::nan(""), .bound = 1e300, .source = ""});
  Image image(2, 1);
  image.rgba[5] = std::nanf("");
  run.add_equal("a picture with NaN", image, Image(2, 1), 1e30, "");
  for (const VerifyRow& row : run.take()) {
    EXPECT_EQ(row.row.outcome, "fail") << row.row.check;
    EXPECT_TRUE(std::isfinite(row.row.measured)) << "results files hold numbers";
  }
}

// A bound of 0 asks for equality, and the worst pixel is named.
TEST(CaseRun, OnePixelIsEnough) {
  CaseRun run({.hard_case = &hard_case_list().front()});
  Image image(5, 4);
  run.add_equal("equal", image, Image(5, 4), 0, "");
  image.pixel(3, 2)[1] = 1e-7F;
  run.add_equal("one pixel", image, Image(5, 4), 0, "");
  const std::vector<VerifyRow> rows = run.take();
  EXPECT_EQ(rows[0].row.outcome, "pass");
  EXPECT_EQ(rows[1].row.outcome, "fail");
  EXPECT_EQ(rows[1].row.x, 3);
  EXPECT_EQ(rows[1].row.y, 2);
}

// A smooth picture that moves, with one pixel that pops by `pop` in one of the small motions.
SensitivityFrames frames_with_pop(double pop) {
  SensitivityFrames frames;
  const auto picture = [](double shift) {
    Image image(12, 10);
    for (int y = 0; y < 10; ++y)
      for (int x = 0; x < 12; ++x)
        for (int channel = 0; channel < 4; ++channel)
          image.pixel(x, y)[channel] = static_cast<float>(0.5 + 0.4 * std::sin(0.3 * x + 0.2 * y + 30 * shift));
    return image;
  };
  frames.base = picture(0);
  for (int k = 0; k < 4; ++k) {
    frames.small_motion.push_back(picture(kSmallMotion * (k - 1.5)));
    frames.large_motion.push_back(picture(kLargeMotion * (k - 1.5)));
  }
  frames.small_motion[2].pixel(7, 4)[0] += static_cast<float>(pop);
  return frames;
}

TEST(Sensitivity, SmoothMotionHasNoSpike) {
  double worst = 0;
  const SensitivityRow row = judge_sensitivity(frames_with_pop(0), 0, worst);
  EXPECT_TRUE(row.ok);
  EXPECT_LT(worst, 1);
  EXPECT_NEAR(row.max, 0.4 * 30 * 1.5, 1) << "the steepest place of the picture, times the largest shift";
}

TEST(Sensitivity, APopIsFoundWhereItIs) {
  double worst = 0;
  const SensitivityRow row = judge_sensitivity(frames_with_pop(1e-3), 3, worst);
  EXPECT_FALSE(row.ok);
  ASSERT_EQ(row.spikes.size(), 1U);
  EXPECT_EQ(row.spikes[0].x, 7);
  EXPECT_EQ(row.spikes[0].y, 4);
  EXPECT_EQ(row.spikes[0].view, 3);
  EXPECT_GT(worst, 1);
  EXPECT_THAT(row.reason, HasSubstr("7, 4"));
}

TEST(Sensitivity, PixelsThatAnEdgePassesAreLeftOut) {
  std::vector<bool> edges(120);
  edges[4 * 12 + 7] = true;
  double worst = 0;
  EXPECT_TRUE(judge_sensitivity(frames_with_pop(1e-3), 0, worst, edges).ok);
  EXPECT_LT(worst, 1);
  edges[4 * 12 + 7] = false;
  edges[4 * 12 + 8] = true;
  EXPECT_FALSE(judge_sensitivity(frames_with_pop(1e-3), 0, worst, edges).ok);
}

// Grey values at kEdgePlaces.
bool edge_of(const std::vector<double>& values) {
  std::vector<PixelValue> pixels;
  for (const double value : values) {
    const auto grey = static_cast<float>(value);
    pixels.push_back({grey, grey, grey, 1});
  }
  return is_passing_edge(pixels);
}

TEST(PassingEdge, OneJumpBetweenTwoLevelSides) {
  EXPECT_TRUE(edge_of({0, 0, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_TRUE(edge_of({0.5, 0.501, 0.502, 0.502, 0.503, 0.1, 0.1, 0.101, 0.102}));
  EXPECT_TRUE(edge_of({0, 0, 0, 1, 0, 1, 1, 1, 1})) << "within rounding of the edge either side may show";
}

TEST(PassingEdge, CracksAndFlickersAreNone) {
  EXPECT_FALSE(edge_of({0, 0, 0, 0, 0, 1, 0, 0, 0})) << "one view alone";
  EXPECT_FALSE(edge_of({1, 1, 1, 1, 0, 1, 1, 1, 1})) << "a hole in the picture as it was";
  EXPECT_FALSE(edge_of({0, 0, 0, 0, 0, 1, 1, 0, 0})) << "comes and goes";
  EXPECT_FALSE(edge_of({0, 0, 0, 0, 0, 1, 1, 0, 1})) << "comes, goes and comes";
  EXPECT_FALSE(edge_of({0, 0, 0, 0, 0, 0.5, 1, 1, 1})) << "a third value in between";
  EXPECT_FALSE(edge_of({0, 0, 0, 0, 2, 1, 1, 1, 1})) << "the edge is drawn in a colour of neither side";
  EXPECT_FALSE(edge_of({0, 0.2, 0.4, 0.45, 0.5, 0.55, 0.6, 0.8, 1})) << "a slope";
  EXPECT_FALSE(edge_of({0, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_FALSE(edge_of({0, 0, 0, 0, 0, NAN, 1, 1, 1}));
  EXPECT_FALSE(edge_of({0, 1}));
}

TEST(PassingEdge, PassInProportion) {
  EXPECT_EQ(edges_allowed(0), 4U);
  EXPECT_EQ(edges_allowed(100), 20U);
  EXPECT_LT(edges_allowed(48 * 48), 48U * 48U);
}

TEST(BoxChord, OfRaysThroughBesideAndWithin) {
  const glm::dvec3 half(1, 2, 3);
  EXPECT_DOUBLE_EQ(box_chord({{-5, 0, 0}, {1, 0, 0}, 0}, half).length(), 2);
  EXPECT_DOUBLE_EQ(box_chord({{0, 0, 0}, {0, 1, 0}, 0.5}, half).length(), 1.5);
  EXPECT_EQ(box_chord({{-5, 2.5, 0}, {1, 0, 0}, 0}, half).length(), 0);
  EXPECT_DOUBLE_EQ(
      cut_chord(box_chord({{-5, 0, 0}, {1, 0, 0}, 0}, half), {{-5, 0, 0}, {1, 0, 0}, 0}, {{1, 0, 0}, 0.5}).length(),
      0.5);
}

}  // namespace
}  // namespace volumark
