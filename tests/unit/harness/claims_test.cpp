// Each rule on results made by hand: what holds, what fails, what cannot be decided, and why.
#include "harness/claims.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reports/paper_table.h"

namespace volumark {
namespace {

class ClaimTest : public testing::Test {
 protected:
  Result& add(const std::string& scene, int64_t slices, const std::string& textures, double lo, double hi) {
    Result result;
    result.key = {"paper", scene, "slices2d", "cpu", {{"slices", slices}, {"textures", textures}}, ""};
    result.outcome = Outcome::Ok;
    Stats& stats = result.metrics.emplace().frame_wall.stats;
    stats.count = 5;
    stats.median = std::sqrt(lo * hi);
    stats.median_lo = lo;
    stats.median_hi = hi;
    return results_.results.emplace_back(result);
  }
  static ClaimSpec spec(ClaimRule rule) {
    ClaimSpec out;
    out.id = "R1";
    out.text = "text";
    out.rule = rule;
    out.measure = "frame_wall";
    out.expected = std::nan("");
    return out;
  }
  static ClaimSpec ratio(double lo, double hi) {
    ClaimSpec out = spec(ClaimRule::Ratio);
    out.of.params = {{"textures", std::string("1")}};
    out.against = CellSelector{{}, "", {{"textures", std::string("2")}}, ""};
    out.limit_lo = lo;
    out.limit_hi = hi;
    return out;
  }
  Claim judged(const ClaimSpec& claim) const { return judge(claim, "key", "paper", "cpu", results_); }

  Results results_;
};

TEST_F(ClaimTest, RatioHoldsFailsOrStraddles) {
  add("engine", 100, "1", 3.8, 4.2);
  add("engine", 100, "2", 1.9, 2.1);
  const Claim holds = judged(ratio(1.5, 2.5));
  EXPECT_EQ(holds.verdict, "holds");
  EXPECT_NEAR(holds.measured, 2, 0.01);
  EXPECT_NEAR(holds.measured_lo, 3.8 / 2.1, 1e-12);  // least over most
  EXPECT_NEAR(holds.measured_hi, 4.2 / 1.9, 1e-12);
  EXPECT_EQ(holds.cells.size(), 2U);
  EXPECT_EQ(judged(ratio(2.3, 2.5)).verdict, "fails");
  const Claim open = judged(ratio(1.9, 2.5));
  EXPECT_EQ(open.verdict, "unknown");
  EXPECT_NE(open.reason.find("straddles"), std::string::npos) << open.reason;
}

TEST_F(ClaimTest, SeveralScenesAreAGeometricMean) {
  add("a", 100, "1", 2, 2);
  add("a", 100, "2", 1, 1);
  add("b", 100, "1", 8, 8);
  add("b", 100, "2", 1, 1);
  const Claim claim = judged(ratio(3.99, 4.01));  // the arithmetic mean is 5
  EXPECT_EQ(claim.verdict, "holds") << claim.measured;
  EXPECT_NEAR(claim.measured, 4, 1e-12);
  EXPECT_NE(claim.reason.find("geometric mean over 2 pairs"), std::string::npos) << claim.reason;
}

TEST_F(ClaimTest, PartnersHaveTheSameFreeParameters) {
  for (const int64_t slices : {100, 200}) {
    add("a", slices, "1", 4.0 * slices, 4.0 * slices);
    add("a", slices, "2", 2.0 * slices, 2.0 * slices);
  }
  EXPECT_NEAR(judged(ratio(1, 3)).measured, 2, 1e-12);  // 400/200, 800/400; never 400/400
}

TEST_F(ClaimTest, TwoScenesThatAreNamedArePaired) {
  add("bone", 100, "1", 2, 2);
  add("head", 100, "1", 6, 6);
  add("head", 100, "2", 7, 7);
  ClaimSpec claim = ratio(2.9, 3.1);
  claim.of = CellSelector{{"head"}, "", {{"textures", std::string("1")}}, ""};
  claim.against = CellSelector{{"bone"}, "", {}, ""};
  EXPECT_EQ(judged(claim).verdict, "holds");
  claim.against->scenes.clear();  // then the pair is of one scene: itself
  EXPECT_NE(judged(claim).verdict, "holds");
}

TEST_F(ClaimTest, PerDividesByTheCellsOwn) {
  add("a", 100, "1", 4, 4).metrics->counters["slices"] = 100;
  add("a", 100, "2", 4, 4).metrics->counters["slices"] = 50;
  ClaimSpec claim = ratio(0.49, 0.51);
  claim.per = "counter.slices";
  EXPECT_EQ(judged(claim).verdict, "holds");
}

TEST_F(ClaimTest, OrderNeedsIntervalsApart) {
  ClaimSpec claim = spec(ClaimRule::Order);
  claim.of.params = {{"textures", std::string("2")}};
  claim.against = CellSelector{{}, "", {{"textures", std::string("1")}}, ""};
  add("a", 100, "1", 3.8, 4.2);
  add("a", 100, "2", 1.9, 2.1);
  EXPECT_EQ(judged(claim).verdict, "holds");
  add("b", 100, "1", 2.0, 2.2);
  add("b", 100, "2", 1.9, 2.0);  // touch
  EXPECT_EQ(judged(claim).verdict, "unknown");
  EXPECT_NE(judged(claim).reason.find("1 of 2 pairs"), std::string::npos) << judged(claim).reason;
  add("c", 100, "1", 1, 1.1);
  add("c", 100, "2", 1.2, 1.3);  // the other way round
  EXPECT_EQ(judged(claim).verdict, "fails");
  EXPECT_NE(judged(claim).reason.find("the other way round: c"), std::string::npos) << judged(claim).reason;
}

TEST_F(ClaimTest, ExactHasNoTolerance) {
  ClaimSpec claim = spec(ClaimRule::Exact);
  claim.measure = "counter.bytes";
  claim.expected = 243 * 1024;
  add("a", 100, "1", 1, 1).metrics->counters["bytes"] = 243 * 1024;
  EXPECT_EQ(judged(claim).verdict, "holds");
  add("b", 100, "1", 1, 1).metrics->counters["bytes"] = 243 * 1024 + 1;
  EXPECT_EQ(judged(claim).verdict, "fails");
  EXPECT_EQ(judged(claim).measured, 243 * 1024 + 1);
}

TEST_F(ClaimTest, ShapeFitsAnExponent) {
  ClaimSpec claim = spec(ClaimRule::Shape);
  claim.over = "slices";
  claim.limit_lo = 0.9;
  claim.limit_hi = 1.1;
  for (const int64_t slices : {100, 200, 400}) add("a", slices, "1", 0.01 * slices, 0.01 * slices);
  EXPECT_NEAR(judged(claim).measured, 1, 1e-9);
  EXPECT_EQ(judged(claim).verdict, "holds");
  for (const int64_t slices : {100, 200, 400}) add("b", slices, "1", 1e-4 * slices * slices, 1e-4 * slices * slices);
  EXPECT_NEAR(judged(claim).measured, 1.5, 1e-9);  // the mean of both series
  EXPECT_EQ(judged(claim).verdict, "fails");
  results_.results.pop_back();
  EXPECT_EQ(judged(claim).verdict, "unknown");
  EXPECT_NE(judged(claim).reason.find("fewer than three"), std::string::npos) << judged(claim).reason;
}

TEST_F(ClaimTest, ShapeWithOneLimit) {
  ClaimSpec claim = spec(ClaimRule::Shape);
  claim.limit_hi = 2;
  add("a", 100, "1", 0.9, 1.1);
  EXPECT_EQ(judged(claim).verdict, "holds");
  claim.limit_hi = 0.5;
  EXPECT_EQ(judged(claim).verdict, "fails");
  claim.limit_hi = 1;
  EXPECT_EQ(judged(claim).verdict, "unknown");
}

TEST_F(ClaimTest, ShapeIsJudgedCellByCell) {
  ClaimSpec claim = spec(ClaimRule::Shape);
  claim.limit_hi = 2;
  add("a", 100, "1", 0.1, 0.1);
  add("b", 100, "1", 1, 1);
  EXPECT_EQ(judged(claim).verdict, "holds");
  add("c", 100, "1", 3, 3);  // the mean is 0.67
  EXPECT_EQ(judged(claim).verdict, "fails");
  EXPECT_NE(judged(claim).reason.find("c slices2d"), std::string::npos) << judged(claim).reason;
  EXPECT_EQ(judged(claim).reason.find("a slices2d"), std::string::npos) << judged(claim).reason;
}

TEST_F(ClaimTest, AZeroAmongCellsIsNoObstacle) {
  ClaimSpec claim = spec(ClaimRule::Shape);
  claim.limit_hi = 2;
  add("a", 100, "1", 0, 0);
  add("b", 100, "1", 1, 1);
  EXPECT_EQ(judged(claim).verdict, "holds");
  EXPECT_EQ(judged(claim).measured, 1);
}

TEST_F(ClaimTest, ErrorsHaveTheReferencesBound) {
  Result& result = add("a", 100, "1", 1, 1);
  result.error.emplace().worst.rmse = 1e-3;
  result.views.resize(1);
  result.views[0].reference.emplace().bound = 2e-4;
  ClaimSpec claim = spec(ClaimRule::Shape);
  claim.measure = "error.rmse";
  claim.limit_hi = 1.1e-3;
  EXPECT_EQ(judged(claim).verdict, "unknown");  // 0.8e-3..1.2e-3
  claim.limit_hi = 1.3e-3;
  EXPECT_EQ(judged(claim).verdict, "holds");
}

TEST_F(ClaimTest, AbsoluteIsShownAndNotJudged) {
  add("a", 100, "1", 4, 4);
  const Claim claim = judged(spec(ClaimRule::Absolute));
  EXPECT_EQ(claim.verdict, "not_judged");
  EXPECT_EQ(claim.measured, 4);
  EXPECT_EQ(verdict_words(claim.verdict), "not judged");
}

TEST_F(ClaimTest, WhatIsMissingMakesItUnknown) {
  EXPECT_EQ(judged(ratio(1, 3)).reason, "its cells are not in these results");
  Result& broken = add("a", 100, "1", 4, 4);
  EXPECT_NE(judged(ratio(1, 3)).reason.find("not in these results"), std::string::npos);
  broken.outcome = Outcome::Unsupported;
  broken.reason = "no such texture";
  EXPECT_EQ(judged(ratio(1, 3)).verdict, "unknown");
  EXPECT_NE(judged(ratio(1, 3)).reason.find("no such texture"), std::string::npos) << judged(ratio(1, 3)).reason;
  EXPECT_TRUE(std::isnan(judged(ratio(1, 3)).measured));
}

TEST_F(ClaimTest, PartOfItsCellsIsNotEnough) {  // as with --scene, or after an interruption
  add("a", 100, "1", 4, 4);
  add("a", 100, "2", 2, 2);
  ClaimSpec claim = ratio(1, 3);
  claim.cells = 2;
  EXPECT_EQ(judged(claim).verdict, "unknown");
  EXPECT_EQ(judged(claim).reason, "1 of its 2 cells are not in these results");
  add("b", 100, "1", 4, 4);
  add("b", 100, "2", 2, 2);
  EXPECT_EQ(judged(claim).verdict, "holds");
}

TEST_F(ClaimTest, AnExcusedBackendIsNotJudged) {
  add("a", 100, "1", 4, 4);
  add("a", 100, "2", 2, 2);
  ClaimSpec claim = ratio(1, 3);
  claim.not_comparable["cpu"] = "no texture units";
  EXPECT_EQ(judged(claim).verdict, "unknown");
  EXPECT_EQ(judged(claim).reason, "no texture units");
  EXPECT_NEAR(judged(claim).measured, 2, 1e-12);
}

TEST_F(ClaimTest, VariantsAndOtherBackendsStayOut) {
  add("a", 100, "1", 4, 4);
  add("a", 100, "1", 9, 9).key.variant = "none";
  add("a", 100, "1", 9, 9).key.backend = "gl";
  add("a", 100, "1", 9, 9).key.experiment = "other";
  EXPECT_EQ(judged(spec(ClaimRule::Absolute)).measured, 4);
}

TEST_F(ClaimTest, PublishedCellsStandBesideOurs) {
  add("a", 100, "1", 0.5, 0.5);
  Claims claims;
  claims.paper = "key";
  claims.cells = {
      {CellSelector{{}, "", {{"textures", std::string("1")}}, ""}, "Table 1", "single", "frames/s", "frame_wall", 8}};
  claims.claims = {spec(ClaimRule::Absolute)};
  for (int again = 0; again < 2; ++again) judge_claims(results_, claims, "paper", {"cpu", "gl"});
  EXPECT_EQ(results_.claims.size(), 2U);  // one a backend; the second time they are replaced
  ASSERT_TRUE(results_.results[0].paper);
  EXPECT_EQ(our_figure(results_.results[0]), 2);
  const std::string text = papers_text(results_);
  EXPECT_NE(text.find("Table 1"), std::string::npos) << text;
  EXPECT_NE(text.find("0.25"), std::string::npos) << text;                 // 2 of 8 frames/s
  EXPECT_NE(text.find("not comparable here"), std::string::npos) << text;  // gl was not measured
}

}  // namespace
}  // namespace volumark
