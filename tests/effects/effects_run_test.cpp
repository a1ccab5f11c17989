// Whole runs on the cpu backend: experiments that switch effects, scenes with effects that nothing simulates.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "harness/image_io.h"
#include "harness/program_cost.h"
#include "harness/run_folder.h"
#include "harness/runner.h"
#include "tests/unit/harness/test_folder.h"

namespace volumark {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::json;

class EffectsRun : public testing::Test {
 protected:
  EffectsRun() {
    scene_ = {
        {"volumark_scene", 1},
        {"title", "tiny"},
        {"volume", {{"generator", {{"kind", "distance"}, {"size", 8}, {"type", "f32"}}}}},
        {"transfer",
         {{"points",
           {{{"value", 0.2}, {"colour", {1, 0.5, 0.2}}, {"extinction", 4}},
            {{"value", 0.8}, {"colour", {0.2, 1, 0.5}}, {"extinction", 0}}}},
          {"window", {0, 1}}}},
        {"views", {{{"orbit", {{"count", 2}, {"azimuth", 20}, {"elevation", 30}, {"distance", 3}, {"fov_y", 40}}}}}}};
    experiment_ = {{"name", "tiny"},
                   {"scenes", {"./tiny_scene.json"}},
                   {"methods", {{{"method", "raycast"}, {"set", {{"step", 1}}}}}},
                   {"backends", {"cpu"}},
                   {"image_size", {16, 16}},
                   {"images", "all"},
                   {"effects", true},
                   {"sampling", {{"least", 2}, {"most", 2}, {"budget", 0}}}};
  }
  void light() { scene_["effects"]["lighting"] = {{"specular", 0.4}, {"lights", {{{"directional", {1, 1, 1}}}}}}; }
  void cut() { scene_["effects"]["clip_planes"] = {{{"normal", {1, 0, 0}}, {"distance", 0}}}; }
  void fog() { scene_["effects"]["ground_fog"] = Json::object(); }

  RunOutcome run() {
    folder_.write("tiny_scene.json", scene_.dump());
    options_.experiments = {folder_.write("tiny.json", experiment_.dump()).string()};
    options_.out = folder_.path() / "out";
    options_.cache = folder_.path() / "cache";
    options_.progress = log_;
    const RunOutcome outcome = run_experiments(options_);
    const Json written = Json::parse(text_of_file(folder_.path() / "out" / "results.json"));
    for (const SchemaFault& fault : validate_results(written)) ADD_FAILURE() << fault.pointer << ": " << fault.message;
    return outcome;
  }
  size_t cached_references() const {
    std::error_code error;
    size_t count = 0;
    for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator(folder_.path() / "cache", error))
      ++count;
    return count;
  }
  ~EffectsRun() override { std::fclose(log_); }

  TestFolder folder_;
  Json scene_, experiment_;
  RunOptions options_;
  std::FILE* log_ = std::tmpfile();
};

TEST_F(EffectsRun, DrawsEveryPictureOnceAndSaysWhatEachEffectCosts) {
  light();
  cut();
  const RunOutcome outcome = run();
  std::set<std::string> pictures, versions;
  for (const Result& result : outcome.results.results) {
    ASSERT_EQ(result.outcome, Outcome::Ok) << result.key.variant << ": " << result.reason;
    EXPECT_LT(result.error->worst.rmse, 0.1) << result.key.variant << ": of the variant's own reference";
    for (const ViewResult& view : result.views) pictures.insert(view.rendered->sha256);
    versions.insert(result.case_version);
  }
  EXPECT_EQ(outcome.results.results.size(), 4U);
  EXPECT_EQ(pictures.size(), 8U) << "two views of four variants, none twice";
  EXPECT_EQ(versions.size(), 4U);
  EXPECT_EQ(cached_references(), 8U);
  ASSERT_EQ(outcome.results.effects.size(), 4U);
  for (const EffectRow& row : outcome.results.effects) {
    EXPECT_GT(row.rmse, 1e-3) << row.effect << " " << row.mode;
    EXPECT_GT(row.with.count, 0);
    if (can_count_instructions()) {
      EXPECT_GT(row.instructions_with, row.instructions_without) << row.effect << " " << row.mode;
    }
  }
}

TEST_F(EffectsRun, AnEffectAloneIsSwitchedOffOnce) {
  light();
  const RunOutcome outcome = run();
  EXPECT_EQ(outcome.results.results.size(), 2U);
  ASSERT_EQ(outcome.results.effects.size(), 1U);
  EXPECT_EQ(outcome.results.effects[0].mode, "single");
}

TEST_F(EffectsRun, ASceneWithoutEffectsHasItsProgramsAndNoRow) {
  const RunOutcome outcome = run();
  ASSERT_EQ(outcome.results.results.size(), 1U);
  EXPECT_TRUE(outcome.results.effects.empty());
  EXPECT_EQ(outcome.results.results[0].programs.empty(), !can_count_instructions());
}

TEST_F(EffectsRun, OneVariantCanBeRunAgain) {
  light();
  cut();
  options_.filter.variants = {"without lighting"};
  const RunOutcome outcome = run();
  ASSERT_EQ(outcome.results.results.size(), 1U);
  EXPECT_EQ(outcome.results.results[0].key.variant, "only clip_planes");
  EXPECT_THAT(outcome.results.results[0].effects, ElementsAre("clip_planes"));
  EXPECT_EQ(cached_references(), 2U) << "of this variant alone";
}

// Nothing simulates fog: no data are read, no Device is opened and no reference is made to find that out.
TEST_F(EffectsRun, AnEffectThatCannotBeSimulatedIsRefusedBeforeAnyWork) {
  fog();
  experiment_["effects"] = false;
  scene_["volume"] = {{"file", "not_there.nrrd"}};
  const RunOutcome outcome = run();
  ASSERT_EQ(outcome.results.results.size(), 1U);
  EXPECT_EQ(outcome.results.results[0].outcome, Outcome::Unsupported);
  EXPECT_EQ(outcome.results.results[0].reason, "effect ground_fog: raycast does not simulate it");
  EXPECT_TRUE(outcome.results.backends.empty());
  EXPECT_TRUE(outcome.bad_news.empty());
  EXPECT_EQ(cached_references(), 0U);
}

// The method's own refusal comes before references too.
TEST_F(EffectsRun, ASettingThatCannotSimulateCostsNoReference) {
  light();
  experiment_["effects"] = false;
  experiment_["methods"] = {{{"method", "texture3d_slices"}, {"set", {{"classification", "pre"}}}}};
  const RunOutcome outcome = run();
  EXPECT_EQ(outcome.results.results[0].outcome, Outcome::Unsupported);
  EXPECT_THAT(outcome.results.results[0].reason, HasSubstr("effect lighting: "));
  EXPECT_EQ(cached_references(), 0U);
}

TEST_F(EffectsRun, IgnoredEffectsAreRecordedAndMarkThePicture) {
  fog();
  light();
  experiment_["effects"] = false;
  options_.ignore_effects = true;
  const RunOutcome outcome = run();
  const Result& result = outcome.results.results.at(0);
  ASSERT_EQ(result.outcome, Outcome::Ok) << result.reason;
  EXPECT_THAT(result.effects, ElementsAre("lighting"));
  EXPECT_THAT(result.ignored_effects, ElementsAre("ground_fog"));
  EXPECT_THAT(result.command, HasSubstr(" --ignore-effects"));
  EXPECT_THAT(result.views[0].reference->without, ElementsAre("ground_fog"));
  EXPECT_LT(result.error->worst.rmse, 0.1);
  EXPECT_THAT(result.views[0].rendered->path, HasSubstr("-ignored-ground_fog."));
  const std::string file = text_of_file(folder_.path() / "out" / result.views[0].rendered->path);
  if (has_image_module()) {
    EXPECT_THAT(file, HasSubstr("effects of the scene that are ignored here: ground_fog"));
  }
}

// Where the reference can simulate what the method ignores, the error shows what is missing.
TEST_F(EffectsRun, TheErrorShowsWhatIsMissing) {
  light();
  experiment_["effects"] = false;
  experiment_["methods"] = {{{"method", "texture3d_slices"}, {"set", {{"classification", "pre"}}}}};
  const auto rmse = [&] {
    const RunOutcome outcome = run();
    const Result& result = outcome.results.results.at(0);
    EXPECT_EQ(result.outcome, Outcome::Ok) << result.reason;
    return result.error->worst.rmse;
  };
  options_.ignore_effects = true;
  const double ignoring = rmse();
  scene_.erase("effects");
  options_.overwrite = true;
  EXPECT_GT(ignoring, 3 * rmse());
}

TEST_F(EffectsRun, ResumingWithAnotherFlagIsRefused) {
  fog();
  experiment_["effects"] = false;
  run();
  options_.resume = true;
  EXPECT_EQ(run().skipped, 1);
  options_.ignore_effects = true;
  try {
    run();
    FAIL() << "went on";
  } catch (const FolderError& error) {
    EXPECT_THAT(error.what(), HasSubstr("ignore_effects: off, now on"));
  }
}

}  // namespace
}  // namespace volumark
