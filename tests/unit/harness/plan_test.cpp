// Experiments spelt out into cells.
#include "harness/plan.h"

#include <gtest/gtest.h>

#include "scenes/errors.h"

namespace volumark {
namespace {

Experiment experiment() {
  return parse_experiment(R"({"name": "e", "scenes": ["sphere", "slab"], "backends": ["cpu", "null"],
    "methods": [{"method": "raycast", "sweep": [2, 1]}, {"method": "texture3d_slices"}]})",
                          "/tmp/e.json");
}

TEST(Plan, EveryCellOnceSceneByScene) {
  const std::vector<Experiment> experiments = {experiment()};
  const std::vector<Group> groups = plan_cells(experiments, {});
  ASSERT_EQ(groups.size(), 6U);  // 2 scenes x (2 + 1)
  EXPECT_EQ(groups[0].cells.size(), 2U);
  EXPECT_EQ(groups[0].cells[0].key.scene, "sphere");
  EXPECT_EQ(groups[0].quality->value, 2);
  EXPECT_FALSE(groups[0].finest);
  EXPECT_TRUE(groups[1].finest);
  EXPECT_TRUE(groups[2].finest);
  EXPECT_EQ(groups[3].cells[0].key.scene, "slab");
  EXPECT_EQ(std::get<double>(groups[1].cells[0].key.params.at("step")), 1);
}

TEST(Plan, FiltersLeaveWhatTheyName) {
  const std::vector<Experiment> experiments = {experiment()};
  CellFilter filter;
  filter.scenes = {"slab"};
  filter.methods = {"raycast"};
  filter.backends = {"null"};
  filter.only = {{"step", "1.0"}};
  const std::vector<Group> groups = plan_cells(experiments, filter);
  ASSERT_EQ(groups.size(), 1U);
  ASSERT_EQ(groups[0].cells.size(), 1U);
  EXPECT_EQ(groups[0].cells[0].command,
            "volumark run /tmp/e.json --scene slab --method raycast --backend null --only step=1 --overwrite --out "
            "out/again");
}

TEST(Plan, AFilterThatNamesNothingIsAMistake) {
  const std::vector<Experiment> experiments = {experiment()};
  CellFilter filter;
  filter.scenes = {"sfere"};
  EXPECT_THROW(plan_cells(experiments, filter), SceneError);
  filter = {};
  filter.only = {{"stp", "1"}};
  EXPECT_THROW(plan_cells(experiments, filter), SceneError);
}

TEST(Plan, TheSameCellTwiceIsRefused) {
  const std::vector<Experiment> experiments = {experiment(), experiment()};
  EXPECT_THROW(plan_cells(experiments, {}), SceneError);
}

}  // namespace
}  // namespace volumark
