// Verdicts between two methods are given only where the intervals part.
#include "harness/pairs.h"

#include <gtest/gtest.h>

#include "harness/cell.h"

namespace volumark {
namespace {

class PairTest : public testing::Test {
 protected:
  PairTest() {
    context_.references[0].image = Image(16, 16);
    context_.reference_infos[0].bound = 1e-6;
    for (size_t i = 0; i < 2; ++i) {
      cells_[i].key = {"test", "scene", i == 0 ? "raycast" : "texture3d_slices", "cpu", {}, ""};
      drawn_[i].planned.cell = &cells_[i];
      drawn_[i].pictures[0] = Image(16, 16);
      Result result;
      result.key = cells_[i].key;
      result.outcome = Outcome::Ok;
      result.error.emplace();
      result.metrics.emplace();
      result.views.resize(1);
      results_.results.push_back(result);
    }
    set_time(0, 0.010, 0.011);
    set_time(1, 0.0105, 0.012);
  }
  void set_error(size_t i, double rmse) { results_.results[i].error->worst.rmse = rmse; }
  void set_time(size_t i, double lo, double hi) {
    Stats& stats = results_.results[i].metrics->frame_wall.stats;
    stats.count = 3;
    stats.median_lo = lo;
    stats.median_hi = hi;
    stats.median = (lo + hi) / 2;
  }
  PairRow row() const { return compare_methods(drawn_[0], drawn_[1], context_, results_); }

  SceneContext context_;
  Results results_;
  Cell cells_[2];
  DrawnCell drawn_[2];
};

TEST_F(PairTest, ErrorsApartAreRanked) {
  set_error(0, 1e-3);
  set_error(1, 2e-3);
  EXPECT_EQ(row().error_verdict, "a");
  std::swap(results_.results[0].error, results_.results[1].error);
  EXPECT_EQ(row().error_verdict, "b");
}

TEST_F(PairTest, ErrorsWithinTheBoundAreNot) {
  set_error(0, 1e-3);
  set_error(1, 1e-3 + 1.9e-6);  // two bounds of 1e-6 touch
  EXPECT_EQ(row().error_verdict, "indistinguishable");
  set_error(1, 1e-3 + 2.1e-6);
  EXPECT_EQ(row().error_verdict, "a");
}

TEST_F(PairTest, RepeatNoiseWidensTheInterval) {
  set_error(0, 1e-3);
  set_error(1, 2e-3);
  drawn_[0].noise = 2e-3;
  EXPECT_EQ(row().error_verdict, "indistinguishable");
}

TEST_F(PairTest, AtTheReferencesBoundNothingRanks) {
  set_error(0, 1e-9);
  set_error(1, 9e-7);
  const PairRow found = row();
  EXPECT_EQ(found.error_verdict, "indistinguishable");
  EXPECT_NE(found.reason.find("at the reference's bound"), std::string::npos) << found.reason;
}

TEST_F(PairTest, TimesByTheIntervalsOfTheirMedians) {
  EXPECT_EQ(row().time_verdict, "indistinguishable");
  set_time(1, 0.0111, 0.012);
  EXPECT_EQ(row().time_verdict, "a");
}

TEST_F(PairTest, TimesOfFewSamplesAreNotToldApart) {
  set_time(1, 0.0111, 0.012);
  results_.results[1].metrics->frame_wall.stats.count = 2;
  const PairRow found = row();
  EXPECT_EQ(found.time_verdict, "indistinguishable");
  EXPECT_NE(found.reason.find("fewer than 3 samples"), std::string::npos) << found.reason;
}

TEST_F(PairTest, FiguresAreOfTheWorstView) {
  context_.references[1].image = Image(16, 16);
  drawn_[0].pictures[1] = Image(16, 16);
  drawn_[1].pictures[1] = Image(16, 16);
  drawn_[1].pictures[1].pixel(3, 4)[0] = 0.5F;
  const PairRow found = row();
  EXPECT_EQ(found.view, 1);
  EXPECT_DOUBLE_EQ(found.max, 0.5);
  EXPECT_NEAR(found.rmse, 0.5 / std::sqrt(3 * 256.), 1e-12);
}

}  // namespace
}  // namespace volumark
