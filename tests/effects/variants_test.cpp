// Scenes with their effects switched, as words, as scenes and as cells of a plan.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/effect_rows.h"
#include "harness/effect_variants.h"
#include "harness/plan.h"
#include "scenes/errors.h"

namespace volumark {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Names = std::vector<std::string>;

TEST(EffectVariants, AreEveryPictureOnce) {
  EXPECT_THAT(effect_variants({}), ElementsAre(""));
  EXPECT_THAT(effect_variants({"lighting"}), ElementsAre("", "none"));
  EXPECT_THAT(effect_variants({"a", "b"}), ElementsAre("", "none", "only a", "only b"));  // without a: only b
  EXPECT_THAT(effect_variants({"a", "b", "c"}),
              ElementsAre("", "none", "only a", "only b", "only c", "without a", "without b", "without c"));
}

TEST(EffectVariants, WordsForTheSamePictureAreOneVariant) {
  EXPECT_EQ(canonical_variant({"lighting"}, "only lighting"), "");
  EXPECT_EQ(canonical_variant({"lighting"}, "without lighting"), "none");
  EXPECT_EQ(canonical_variant({"a", "b"}, "without b"), "only a");
  EXPECT_EQ(canonical_variant({"a", "b", "c"}, "without b"), "without b");
  EXPECT_EQ(canonical_variant({}, "none"), "");
}

TEST(EffectVariants, AWordThatIsNoneIsRefused) {
  EXPECT_THROW(variant_effects({"a"}, "only b"), std::invalid_argument);
  EXPECT_THROW(variant_effects({"a"}, "a"), std::invalid_argument);
  EXPECT_THROW(variant_effects({}, "without a"), std::invalid_argument);
}

Scene lit_and_cut() {
  Scene scene;
  scene.hash = "0123";
  scene.effects.lighting.emplace();
  scene.effects.clip_planes.resize(1);
  scene.effects.others = {"ground_fog"};
  return scene;
}

TEST(EffectVariants, ASceneKeepsWhatIsLeftUnderAnotherHash) {
  const Scene scene = lit_and_cut();
  const Scene lit = scene_variant(scene, "only lighting");
  EXPECT_THAT(effect_names(lit.effects), ElementsAre("lighting"));
  const Scene dark = scene_variant(scene, "without lighting");
  EXPECT_THAT(effect_names(dark.effects), ElementsAre("clip_planes", "ground_fog"));
  const Scene bare = scene_variant(scene, "none");
  EXPECT_THAT(effect_names(bare.effects), ElementsAre());
  const Scene same = scene_variant(scene, "");
  EXPECT_EQ(same.hash, scene.hash);
  const std::set<std::string> hashes = {scene.hash, lit.hash, dark.hash, bare.hash};
  EXPECT_EQ(hashes.size(), 4U);
  EXPECT_EQ(without_effects(scene, {"fixed_point"}).hash, scene.hash) << "it was not called for";
}

// ---- Plan ----

std::vector<Experiment> experiments(const std::string& scenes) {
  return {parse_experiment(R"({"name": "e", "backends": ["cpu", "null"], "effects": true, "scenes": )" + scenes +
                               R"(, "methods": [{"method": "raycast"}]})",
                           "/tmp/e.json")};
}

Names variants_of(const Group& group, const std::string& backend) {
  Names out;
  for (const Cell& cell : group.cells)
    if (cell.backend == backend) out.push_back(cell.key.variant);
  return out;
}

TEST(EffectPlan, EveryBackendDrawsEveryVariantOfItsScene) {
  const auto all = experiments(R"(["ch2", "engine", "cloud"])");
  const std::vector<Group> groups = plan_cells(all, {});
  ASSERT_EQ(groups.size(), 3U);
  for (const char* backend : {"cpu", "null"}) {
    EXPECT_THAT(variants_of(groups[0], backend), ElementsAre("", "none", "only lighting", "only clip_planes"));
    EXPECT_THAT(variants_of(groups[1], backend), ElementsAre("", "none"));
    EXPECT_THAT(variants_of(groups[2], backend), ElementsAre(""));
  }
}

TEST(EffectPlan, ACellsCommandNamesItsVariant) {
  const auto all = experiments(R"(["ch2"])");
  const std::vector<Group> groups = plan_cells(all, {});
  EXPECT_THAT(groups[0].cells[0].command, HasSubstr(" --variant all "));
  EXPECT_THAT(groups[0].cells[2].command, HasSubstr(" --variant 'only lighting' "));
}

TEST(EffectPlan, AFilterTakesAnyWordForThePicture) {
  const auto all = experiments(R"(["ch2", "engine"])");
  CellFilter filter;
  filter.variants = {"without lighting"};
  const std::vector<Group> groups = plan_cells(all, filter);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_THAT(variants_of(groups[0], "cpu"), ElementsAre("only clip_planes"));
  EXPECT_THAT(variants_of(groups[1], "cpu"), ElementsAre("none"));
  filter.variants = {"only clip_planes"};  // the engine calls for none
  ASSERT_EQ(plan_cells(all, filter).size(), 1U);
}

TEST(EffectPlan, AFilterThatNamesNothingIsAMistake) {
  const auto all = experiments(R"(["engine"])");
  CellFilter filter;
  filter.variants = {"only clip_planes"};
  try {
    plan_cells(all, filter);
    FAIL() << "accepted";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), HasSubstr("they have: all, none"));
  }
  auto plain = experiments(R"(["engine"])");
  plain[0].effects = false;
  EXPECT_THROW(plan_cells(plain, filter), SceneError);
}

// ---- Rows ----

Result measured(const std::string& variant, double lo, double hi, int64_t instructions) {
  Result result;
  result.outcome = Outcome::Ok;
  result.key.variant = variant;
  result.metrics.emplace();
  Stats& stats = result.metrics->frame_wall.stats;
  stats.count = 5;
  stats.median = (lo + hi) / 2;
  stats.median_lo = lo;
  stats.median_hi = hi;
  result.programs = {{"p", "vertex", 3}, {"p", "fragment", instructions - 3}};
  return result;
}

std::map<int, Image> grey(float value) {
  Image image(4, 4);
  std::fill(image.rgba.begin(), image.rgba.end(), value);
  return {{0, image}};
}

Scene two_effects() {
  Scene scene = lit_and_cut();
  scene.effects.others.clear();
  return scene;
}

TEST(EffectRows, CompareAllWithAllButOneAndOneWithNone) {
  const Result all = measured("", 3, 4, 100), none = measured("none", 1, 2, 10),
               lit = measured("only lighting", 2.5, 3.5, 80), cut = measured("only clip_planes", 1.5, 2.5, 30);
  const std::map<int, Image> images[] = {grey(1), grey(0), grey(0.75F), grey(0.25F)};
  const std::vector<VariantCell> cells = {
      {&all, &images[0]}, {&none, &images[1]}, {&lit, &images[2]}, {&cut, &images[3]}};
  const std::vector<EffectRow> rows = effect_rows(two_effects(), cells);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0].effect + " " + rows[0].mode, "lighting single");
  EXPECT_DOUBLE_EQ(rows[0].with.median, 3);
  EXPECT_DOUBLE_EQ(rows[0].without.median, 1.5);
  EXPECT_TRUE(rows[0].time_differs);
  EXPECT_EQ(rows[0].instructions_with, 80);
  EXPECT_EQ(rows[0].instructions_without, 10);
  EXPECT_NEAR(rows[0].rmse, 0.75, 1e-6);
  EXPECT_EQ(rows[1].effect + " " + rows[1].mode, "clip_planes single");
  EXPECT_FALSE(rows[1].time_differs) << "1.5 to 2.5 touches 1 to 2";
  EXPECT_EQ(rows[2].effect + " " + rows[2].mode, "lighting leave_one_out");
  EXPECT_EQ(rows[2].instructions_without, 30) << "all but lighting is clip_planes alone";
  EXPECT_NEAR(rows[2].rmse, 0.75, 1e-6);
  EXPECT_EQ(rows[3].effect + " " + rows[3].mode, "clip_planes leave_one_out");
  EXPECT_EQ(rows[3].instructions_without, 80);
  for (const EffectRow& row : rows) EXPECT_EQ(row.key.variant, "");
}

TEST(EffectRows, NeedBothCells) {
  const Result all = measured("", 3, 4, 100);
  Result none = measured("none", 1, 2, 10);
  none.outcome = Outcome::Unsupported;
  const std::map<int, Image> image = grey(1);
  Scene scene;
  scene.effects.lighting.emplace();
  EXPECT_TRUE(effect_rows(scene, {{&all, &image}, {&none, &image}}).empty());
  none.outcome = Outcome::Ok;
  EXPECT_EQ(effect_rows(scene, {{&all, &image}, {&none, &image}}).size(), 1U) << "one effect: single is leave-one-out";
  EXPECT_TRUE(effect_rows(Scene{}, {{&all, &image}}).empty());
}

}  // namespace
}  // namespace volumark
