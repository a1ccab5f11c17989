// Instruction counts on programs of known size.
#include "harness/program_cost.h"

#include <gtest/gtest.h>

#include "programs/same_frag.h"
#include "programs/tiny_frag.h"

namespace volumark {
namespace {

std::vector<SpecConstant> constants(int extra, int turns) { return {{"VM_EXTRA", extra}, {"VM_TURNS", turns}}; }

int64_t count(int extra, int turns) {
  return count_instructions(optimised_stage(programs::tiny_frag.spirv, constants(extra, turns)));
}

std::string text(std::span<const uint32_t> spirv) {
  std::string out;
  for (const std::string& line : instruction_stream(spirv)) out += line + "\n";
  return out;
}

TEST(ProgramCost, CountsWhatRunsAndNothingElse) {
  EXPECT_EQ(count(0, 0), 4) << text(optimised_stage(programs::tiny_frag.spirv, constants(0, 0)));
  EXPECT_EQ(count(1, 0), 5) << text(optimised_stage(programs::tiny_frag.spirv, constants(1, 0)));
}

TEST(ProgramCost, ALoopCountsOnceHoweverOftenItRuns) {
  EXPECT_GT(count(0, 2), count(0, 0));
  EXPECT_EQ(count(0, 2), count(0, 200));
}

TEST(ProgramCost, StreamsDoNotDependOnNamesOrIds) {
  const std::string same = text(optimised_stage(programs::same_frag.spirv, {}));
  EXPECT_EQ(text(optimised_stage(programs::tiny_frag.spirv, constants(0, 0))), same);
  EXPECT_NE(text(optimised_stage(programs::tiny_frag.spirv, constants(1, 0))), same);
  EXPECT_NE(text(optimised_stage(programs::tiny_frag.spirv, constants(0, 1))), same);
}

TEST(ProgramCost, OneRowAStageOfEachProgram) {
  const std::vector<ProgramRecord> records = {{"plain", {&programs::tiny_frag}, constants(0, 0)},
                                              {"extra", {&programs::tiny_frag, &programs::same_frag}, constants(1, 0)}};
  const std::vector<ProgramCost> costs = program_costs(records);
  ASSERT_EQ(costs.size(), 3u);
  EXPECT_EQ(costs[0].program, "plain");
  EXPECT_EQ(costs[0].stage, "fragment");
  EXPECT_EQ(costs[0].instructions, 4);
  EXPECT_EQ(costs[1].program, "extra");
  EXPECT_EQ(costs[1].instructions, 5);
  EXPECT_EQ(costs[2].instructions, 4);
}

TEST(ProgramCost, RefusesWhatIsNoProgram) {
  const std::vector<uint32_t> noise = {1, 2, 3, 4, 5, 6};
  EXPECT_THROW(count_instructions(noise), std::runtime_error);
  EXPECT_THROW(optimised_stage(noise, {}), std::runtime_error);
}

}  // namespace
}  // namespace volumark
