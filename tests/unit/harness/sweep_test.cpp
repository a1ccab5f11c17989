// --sweep: values and ranges, what they do to an experiment, and every way to write them wrong.
#include "harness/sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/plan.h"
#include "scenes/errors.h"

namespace volumark {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<Experiment> experiments() {
  return {parse_experiment(R"({"name": "e", "scenes": ["slab"], "backends": ["null"], "finest_limits": {"rmse": 0.1},
    "methods": [{"method": "raycast", "sweep": [2, 1]}, {"method": "texture3d_slices", "set": {"end_slabs": "full"}}]})",
                           "/tmp/e.json")};
}

std::string message_of(const std::vector<std::string>& texts, const std::vector<std::string>& methods = {}) {
  try {
    std::vector<Sweep> sweeps;
    for (const std::string& text : texts) sweeps.push_back(parse_sweep(text));
    std::vector<Experiment> some = experiments();
    apply_sweeps(some, sweeps, methods);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Sweep, ValuesAndRanges) {
  EXPECT_THAT(parse_sweep("step=2,.5,1e-1").values, ElementsAre("2", ".5", "1e-1"));
  EXPECT_THAT(parse_sweep("step=4..0.25*0.5").values, ElementsAre("4", "2", "1", "0.5", "0.25"));
  EXPECT_THAT(parse_sweep("step=.1..0.35+.1").values, ElementsAre("0.1", "0.2", "0.3"));  // not 0.30000000000000004
  EXPECT_THAT(parse_sweep("step=3..1+-1").values, ElementsAre("3", "2", "1"));
  EXPECT_THAT(parse_sweep("table_size=64..1024*4,5000").values, ElementsAre("64", "256", "1024", "5000"));
  EXPECT_THAT(parse_sweep("step=1..1*2").values, ElementsAre("1"));
  EXPECT_EQ(to_string(parse_sweep("step=4..1*.5")), "step=4,2,1");
}

TEST(Sweep, WhatIsNoSweepSaysWhy) {
  EXPECT_THAT(message_of({"step"}), HasSubstr("expected NAME=VALUE"));
  EXPECT_THAT(message_of({"=1"}), HasSubstr("expected NAME=VALUE"));
  EXPECT_THAT(message_of({"step="}), HasSubstr("expected a value"));
  EXPECT_THAT(message_of({"step=1,,2"}), HasSubstr("expected a value"));
  EXPECT_THAT(message_of({"step=1,2,"}), HasSubstr("expected a value"));
  EXPECT_THAT(message_of({"step=1,2,1"}), HasSubstr("named twice"));
  EXPECT_THAT(message_of({"step=4..1"}), HasSubstr("has no step"));
  EXPECT_THAT(message_of({"step=1..4*0.5"}), HasSubstr("is empty"));
  EXPECT_THAT(message_of({"step=4..1*2"}), HasSubstr("is empty"));
  EXPECT_THAT(message_of({"step=4..1+1"}), HasSubstr("is empty"));
  EXPECT_THAT(message_of({"step=1..4*1"}), HasSubstr("never ends"));
  EXPECT_THAT(message_of({"step=1..4+0"}), HasSubstr("never ends"));
  EXPECT_THAT(message_of({"step=1..4*0"}), HasSubstr("must not be 0"));
  EXPECT_THAT(message_of({"step=1..4*-2"}), HasSubstr("must not be 0"));
  EXPECT_THAT(message_of({"step=1..four*2"}), HasSubstr("\"four\" is no number"));
  EXPECT_THAT(message_of({"step=1..2+1e-6"}), HasSubstr("more than 1000 values"));
  EXPECT_THAT(message_of({"step=1..inf*2"}), HasSubstr("is no number"));
}

TEST(Sweep, WhatNoMethodHasOrCanTakeIsRefused) {
  EXPECT_THAT(message_of({"stp=1"}), HasSubstr("did you mean \"step\"?"));
  EXPECT_THAT(message_of({"brick_size=2"}, {"texture3d_slices"}), HasSubstr("none of the chosen methods"));
  EXPECT_THAT(message_of({"step=fine"}), HasSubstr("expected a number"));
  EXPECT_THAT(message_of({"step=1,1000"}), HasSubstr("out of range"));
  EXPECT_THAT(message_of({"table_size=2.5"}), HasSubstr("whole number"));
  EXPECT_THAT(message_of({"target_format=rgba8,rgba64"}), HasSubstr("unknown value \"rgba64\""));
  EXPECT_THAT(message_of({"step=0.5,.5"}), HasSubstr("named twice"));  // one number, spelt in two ways
  EXPECT_THAT(message_of({"step=1", "step=2"}), HasSubstr("swept twice"));
  EXPECT_EQ(message_of({"brick_size=2"}), "no error");  // one of the methods has it
}

TEST(Sweep, TheQualityAxisIsReplacedCoarseToFine) {
  std::vector<Experiment> some = experiments();
  const std::vector<std::string> remarks = apply_sweeps(some, {parse_sweep("step=1,4,2")}, {});
  EXPECT_THAT(some[0].methods[0].sweep, ElementsAre(4, 2, 1));
  EXPECT_THAT(some[0].methods[1].sweep, ElementsAre(4, 2, 1));
  ASSERT_EQ(remarks.size(), 2U);  // one a method
  EXPECT_THAT(remarks[0], HasSubstr("coarse to fine: 4, 2, 1"));
  EXPECT_TRUE(some[0].finest_limits.empty());  // they were of the experiment's own finest value
  EXPECT_TRUE(apply_sweeps(some, {parse_sweep("step=4,1")}, {}).empty());
}

TEST(Sweep, OtherParametersMultiply) {
  std::vector<Experiment> some = experiments();
  apply_sweeps(some, {parse_sweep("target_format=rgba8,rgba16f,rgba32f"), parse_sweep("brick_size=2,4")}, {});
  EXPECT_EQ(some[0].methods.size(), 3U * 2 + 3);  // slices have no bricks
  EXPECT_THAT(some[0].methods[0].sweep, ElementsAre(2, 1));
  const std::vector<Group> groups = plan_cells(some, {});
  EXPECT_EQ(groups.size(), 6U * 2 + 3);
}

TEST(Sweep, TouchesTheChosenMethodsAlone) {
  std::vector<Experiment> some = experiments();
  apply_sweeps(some, {parse_sweep("table_size=64,256")}, {"raycast"});
  EXPECT_EQ(some[0].methods.size(), 3U);
}

TEST(Sweep, EntriesThatBecomeEqualAreOne) {
  std::vector<Experiment> some = {parse_experiment(R"({"name": "e", "scenes": ["slab"], "backends": ["null"],
    "methods": [{"method": "raycast"}, {"method": "raycast", "set": {"classification": "preintegrated"}}]})",
                                                   "/tmp/e.json")};
  apply_sweeps(some, {parse_sweep("classification=post,preintegrated")}, {});
  EXPECT_EQ(some[0].methods.size(), 2U);
}

TEST(Sweep, TooManyCellsAreRefusedBeforeAnyWork) {
  EXPECT_THAT(message_of({"table_size=2..1001+1", "brick_size=2..64+1"}), HasSubstr("more than 20000 series"));
  std::vector<Experiment> some = experiments();
  const std::vector<Sweep> sweeps = {parse_sweep("table_size=2..1001+1"), parse_sweep("brick_size=2..13+1")};
  apply_sweeps(some, sweeps, {"raycast"});  // 12000 series of two values each
  EXPECT_THROW(plan_cells(some, {}, sweeps), SceneError);
}

TEST(Sweep, ACellsCommandNamesTheSweepsThatMakeIt) {
  std::vector<Experiment> some = experiments();
  const std::vector<Sweep> sweeps = {parse_sweep("target_format=rgba8,rgba32f"), parse_sweep("step=4,2")};
  apply_sweeps(some, sweeps, {});
  const std::vector<Group> groups = plan_cells(some, {}, sweeps);
  EXPECT_THAT(groups[0].cells[0].command, HasSubstr(" --sweep step=4 --sweep target_format=rgba8 "));
  // The one cell that the command makes has the same key.
  std::vector<Experiment> again = experiments();
  const std::vector<Sweep> of_cell = {parse_sweep("step=4"), parse_sweep("target_format=rgba8")};
  apply_sweeps(again, of_cell, {"raycast"});
  CellFilter filter;
  filter.methods = {"raycast"};
  const std::vector<Group> one = plan_cells(again, filter, of_cell);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].cells[0].key, groups[0].cells[0].key);
}

}  // namespace
}  // namespace volumark
