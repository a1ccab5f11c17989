// Whole runs on the null backend, which draws nothing: outcomes, resuming, stopping, broken scenes.
#include "harness/runner.h"

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "harness/run_folder.h"
#include "scenes/errors.h"
#include "tests/unit/harness/test_folder.h"

namespace volumark {
namespace {

using Json = nlohmann::json;

class RunnerTest : public testing::Test {
 protected:
  Json scene() const {
    return {{"volumark_scene", 1},
            {"title", "tiny"},
            {"volume", {{"generator", {{"kind", "constant"}, {"size", 4}, {"type", "f32"}, {"value", 1}}}}},
            {"transfer", {{"points", {{{"value", 1}, {"colour", {1, 1, 1}}, {"extinction", 2}}}}, {"window", {0, 2}}}},
            {"views",
             {{{"orbit",
                {{"count", 2},
                 {"azimuth", 0},
                 {"elevation", 0},
                 {"distance", 3},
                 {"half_height", 2},
                 {"units", "world"},
                 {"target", {0, 0, 0}}}}}}}};
  }
  Json experiment() const {
    return {{"name", "tiny"},
            {"scenes", {"./tiny_scene.json"}},
            {"methods", {{{"method", "texture3d_slices"}, {"sweep", {2, 1, 0.5}}}}},
            {"backends", {"null"}},
            {"image_size", {16, 16}},
            {"images", "none"},
            {"sampling", {{"least", 2}, {"most", 2}, {"budget", 0}}}};
  }
  RunOutcome run(const Json& json) {
    folder_.write("tiny_scene.json", scene().dump());
    RunOptions options;
    options.experiments = {folder_.write("tiny.json", json.dump()).string()};
    options.out = folder_.path() / "out";
    options.cache = folder_.path() / "cache";
    options.resume = resume_;
    options.overwrite = overwrite_;
    options.progress = log_;
    options.cell.stop = &stop_;
    if (change_) change_(options);
    return run_experiments(options);
  }
  ~RunnerTest() override { std::fclose(log_); }

  TestFolder folder_;
  bool resume_ = false, overwrite_ = false;
  std::atomic<bool> stop_{false};
  std::function<void(RunOptions&)> change_;
  std::FILE* log_ = std::tmpfile();
};

TEST_F(RunnerTest, EveryCellHasSamplesErrorsAndAValidFile) {
  const RunOutcome outcome = run(experiment());
  ASSERT_EQ(outcome.results.results.size(), 3U);
  for (const Result& result : outcome.results.results) {
    EXPECT_EQ(result.outcome, Outcome::Ok) << result.reason;
    ASSERT_TRUE(result.metrics);
    EXPECT_EQ(result.metrics->frame_wall.samples.size(), 4U);  // 2 passes of 2 views
    EXPECT_EQ(result.metrics->frame_wall.views, (std::vector<int64_t>{0, 1, 1, 0}));
    EXPECT_TRUE(result.metrics->frame_wall.first);
    EXPECT_EQ(result.views.size(), 2U);
    ASSERT_TRUE(result.error);
    EXPECT_GT(result.error->worst.rmse, 0.01);  // nothing was drawn
    EXPECT_GT(result.metrics->peak_bytes.device, 0);
  }
  const Json written = Json::parse(text_of_file(folder_.path() / "out" / "results.json"));
  for (const SchemaFault& fault : validate_results(written)) ADD_FAILURE() << fault.pointer << ": " << fault.message;
  EXPECT_FALSE(outcome.results.run.finished_at.empty());
  EXPECT_EQ(outcome.results.scenes.size(), 1U);
  EXPECT_EQ(outcome.results.backends.size(), 1U);
  EXPECT_FALSE(outcome.results.self_test.empty());
}

TEST_F(RunnerTest, WrongImagesAreBadNews) {
  Json json = experiment();
  json["limits"] = {{"rmse", 1e-3}};
  const RunOutcome outcome = run(json);
  EXPECT_EQ(outcome.results.results[0].outcome, Outcome::WrongImage);
  EXPECT_NE(outcome.results.results[0].reason.find("rmse"), std::string::npos);
  EXPECT_EQ(outcome.bad_news.size(), 3U);
}

TEST_F(RunnerTest, FinestLimitsGateTheFinestOnly) {
  Json json = experiment();
  json["finest_limits"] = {{"rmse", 1e-3}};
  const RunOutcome outcome = run(json);
  EXPECT_EQ(outcome.results.results[0].outcome, Outcome::Ok);
  EXPECT_EQ(outcome.results.results[2].outcome, Outcome::WrongImage);
}

TEST_F(RunnerTest, ATimeoutKeepsWhatWasMeasured) {
  Json json = experiment();
  json["sampling"] = {{"least", 100000}, {"most", 100000}, {"timeout", 0.05}};
  const RunOutcome outcome = run(json);
  const Result& result = outcome.results.results[0];
  EXPECT_EQ(result.outcome, Outcome::Timeout);
  ASSERT_TRUE(result.metrics);
  EXPECT_GT(result.metrics->frame_wall.samples.size(), 0U);
  EXPECT_TRUE(validate_results(to_json(outcome.results)).empty());
}

TEST_F(RunnerTest, AStopDropsTheCellAndResumeGoesOn) {
  stop_ = true;
  RunOutcome outcome = run(experiment());
  EXPECT_TRUE(outcome.interrupted);
  EXPECT_TRUE(outcome.results.run.interrupted);
  EXPECT_TRUE(outcome.results.results.empty());
  stop_ = false;
  EXPECT_THROW(run(experiment()), FolderError);  // unfinished: neither --resume nor --overwrite
  resume_ = true;
  outcome = run(experiment());
  EXPECT_FALSE(outcome.interrupted);
  EXPECT_EQ(outcome.results.results.size(), 3U);
  EXPECT_EQ(outcome.results.run.resumed, 1);
  outcome = run(experiment());
  EXPECT_EQ(outcome.skipped, 3);
}

TEST_F(RunnerTest, ResumeMeasuresOnlyWhatIsMissingOrWasEdited) {
  run(experiment());
  Results results = read_results(folder_.path() / "out");
  const std::string kept = results.results[0].finished_at = "2001-01-01T00:00:00Z";
  results.results.erase(results.results.begin() + 1);
  results.results[1].case_version = "an older scene";
  write_results(results, folder_.path() / "out" / "results.json");
  resume_ = true;
  const RunOutcome outcome = run(experiment());
  EXPECT_EQ(outcome.skipped, 1);
  ASSERT_EQ(outcome.results.results.size(), 3U);
  EXPECT_EQ(outcome.results.results[0].finished_at, kept);
  EXPECT_NE(outcome.results.results[1].case_version, "an older scene");
}

TEST_F(RunnerTest, ACellThatKilledTheProcessTwiceIsNotTriedAgain) {
  run(experiment());
  Results results = read_results(folder_.path() / "out");
  const CellKey key = results.results[1].key;
  results.results.erase(results.results.begin() + 1);
  results.run.finished_at.clear();
  {
    RunFolder held(folder_.path() / "out");
    held.save(results, true);
    held.begin_cell(key);
    held.begin_cell(key);
  }
  resume_ = true;
  const RunOutcome outcome = run(experiment());
  ASSERT_EQ(outcome.results.results.size(), 3U);
  EXPECT_EQ(outcome.results.results[1].outcome, Outcome::Failed);
  EXPECT_NE(outcome.results.results[1].reason.find("died"), std::string::npos);
}

TEST_F(RunnerTest, ResultsOfAnotherCommitAreNotMixed) {
  run(experiment());
  Results results = read_results(folder_.path() / "out");
  results.git.sha = "another";
  write_results(results, folder_.path() / "out" / "results.json");
  resume_ = true;
  EXPECT_THROW(run(experiment()), FolderError);
}

// The refusal of --resume with `change`; "went on" where there was none.
std::string refusal(const std::function<RunOutcome()>& resume) {
  try {
    resume();
  } catch (const FolderError& error) {
    return error.what();
  }
  return "went on";
}

TEST_F(RunnerTest, ResumeNamesWhatDiffers) {
  run(experiment());
  const Results kept = read_results(folder_.path() / "out");
  resume_ = true;
  const auto with = [&](const std::function<void(Results&)>& edit) {
    Results results = kept;
    edit(results);
    write_results(results, folder_.path() / "out" / "results.json");
    return refusal([&] { return run(experiment()); });
  };
  EXPECT_EQ(with([](Results&) {}), "went on");
  EXPECT_NE(with([](Results& r) { r.build.type = "Slow"; }).find("build type: Slow, now "), std::string::npos);
  EXPECT_NE(with([](Results& r) { r.build.version = "1"; }).find("compiler: "), std::string::npos);
  EXPECT_NE(with([](Results& r) { r.machine.cpu = "Z80"; }).find("processor: Z80"), std::string::npos);
  EXPECT_NE(with([](Results& r) { r.run.device["threads"] = "7"; }).find("threads: 7, now 0"), std::string::npos);
  EXPECT_NE(with([](Results& r) { r.run.device["vk_device"] = "big"; }).find("vk_device: big, now none"),
            std::string::npos);
  EXPECT_NE(with([](Results& r) { r.machine.env["LP_PERF"] = "fast"; }).find("LP_PERF: fast, now none"),
            std::string::npos);
  const std::string two = with([](Results& r) {
    r.git.sha = "abc";
    r.run.sweeps = {"step=4"};
  });
  EXPECT_NE(two.find("commit: abc"), std::string::npos) << two;
  EXPECT_NE(two.find("--sweep: step=4, now none"), std::string::npos) << two;
  EXPECT_NE(two.find("--overwrite"), std::string::npos) << two;
}

TEST_F(RunnerTest, ResumeNamesAnotherSamplingAndOtherLimits) {
  run(experiment());
  resume_ = true;
  EXPECT_EQ(run(experiment()).skipped, 3);
  Json longer = experiment();
  longer["sampling"]["most"] = 77;
  const std::string sampling = refusal([&] { return run(longer); });
  EXPECT_NE(sampling.find("sampling of "), std::string::npos) << sampling;
  EXPECT_NE(sampling.find("to 77 passes"), std::string::npos) << sampling;
  Json stricter = experiment();
  stricter["limits"]["rmse"] = 0.0125;
  const std::string limits = refusal([&] { return run(stricter); });
  EXPECT_NE(limits.find("limits of "), std::string::npos) << limits;
  EXPECT_NE(limits.find("rmse 0.0125"), std::string::npos) << limits;
}

TEST_F(RunnerTest, RunsWithSweepsAreToldApart) {
  change_ = [](RunOptions& options) { options.sweeps = {parse_sweep("step=4,2")}; };
  const RunOutcome swept = run(experiment());
  EXPECT_EQ(swept.results.results.size(), 2U);
  EXPECT_EQ(swept.results.run.sweeps, std::vector<std::string>{"step=4,2"});
  resume_ = true;
  EXPECT_EQ(run(experiment()).skipped, 2);
  change_ = nullptr;
  EXPECT_NE(refusal([&] { return run(experiment()); }).find("--sweep: step=4,2, now none"), std::string::npos);
}

TEST_F(RunnerTest, ABrokenResultsFileIsReplacedOnRequestOnly) {
  run(experiment());
  folder_.write("out/results.json", "{ broken");
  EXPECT_THROW(run(experiment()), ResultsError);
  resume_ = true;
  EXPECT_THROW(run(experiment()), ResultsError);
  resume_ = false;
  overwrite_ = true;
  EXPECT_EQ(run(experiment()).results.results.size(), 3U);
}

TEST_F(RunnerTest, ResultsAreInThePlansOrderWhateverTheOrderOfMeasuring) {
  Json json = experiment();
  json["backends"] = {"null", "cpu"};
  json["methods"] = {{{"method", "texture3d_slices"}, {"sweep", {8, 4, 2, 1, 0.5}}}};
  const RunOutcome outcome = run(json);
  ASSERT_EQ(outcome.results.results.size(), 10U);
  const double steps[] = {8, 4, 2, 1, 0.5};
  for (size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(outcome.results.results[i].quality->value, steps[i / 2]);
    EXPECT_EQ(outcome.results.results[i].key.backend, i % 2 == 0 ? "null" : "cpu");
  }
}

TEST_F(RunnerTest, AReferenceThatTakesTooLongSaysWhatToDo) {
  Json json = experiment();
  json["reference_budget"] = 1e-6;
  RunOutcome outcome = run(json);
  ASSERT_EQ(outcome.results.results.size(), 3U);
  EXPECT_EQ(outcome.results.results[0].outcome, Outcome::Unsupported);
  for (const char* word : {"2 views of 16 x 16 pixels", "4 x 4 x 4 voxels", "--no-reference", "reference_budget"})
    EXPECT_NE(outcome.results.results[0].reason.find(word), std::string::npos) << outcome.results.results[0].reason;
  overwrite_ = true;
  change_ = [](RunOptions& options) { options.references = false; };
  outcome = run(json);
  for (const Result& result : outcome.results.results) {
    EXPECT_EQ(result.outcome, Outcome::Ok) << result.reason;
    EXPECT_TRUE(result.metrics);
    EXPECT_FALSE(result.error);
    EXPECT_NE(result.command.find("--no-reference"), std::string::npos);
  }
  EXPECT_TRUE(outcome.results.attribution.empty());
  EXPECT_TRUE(outcome.bad_news.empty());
}

TEST_F(RunnerTest, CachedReferencesCostNothing) {
  run(experiment());
  Json json = experiment();
  json["reference_budget"] = 1e-6;
  overwrite_ = true;
  EXPECT_EQ(run(json).results.results[0].outcome, Outcome::Ok);
}

TEST_F(RunnerTest, UnsupportedParametersEndAsUnsupported) {
  Json json = experiment();
  json["methods"] = {{{"method", "raycast"}}};
  json["backends"] = {"null"};
  const RunOutcome outcome = run(json);
  ASSERT_EQ(outcome.results.results.size(), 1U);
  EXPECT_TRUE(outcome.results.results[0].outcome == Outcome::Ok || !outcome.results.results[0].reason.empty());
}

TEST_F(RunnerTest, BrokenExperimentsAreErrorsBeforeAnyWork) {
  Json json = experiment();
  json["scenes"] = {"./nowhere.json"};
  EXPECT_THROW(run(json), SceneError);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out" / "results.json"));
}

TEST_F(RunnerTest, BackendsThatDisagreeAreBadNews) {
  Json json = experiment();
  json["backends"] = {"cpu", "null"};
  json["parity"] = 0.002;
  const RunOutcome outcome = run(json);
  ASSERT_FALSE(outcome.results.parity.empty());
  EXPECT_FALSE(outcome.results.parity[0].ok);
  EXPECT_FALSE(outcome.bad_news.empty());
}

TEST_F(RunnerTest, TargetsWithFewBitsAreNotHeldToTheOthersPictures) {
  Json json = experiment();
  json["backends"] = {"cpu", "null"};
  json["parity"] = 0.002;
  json["methods"] = {{{"method", "texture3d_slices"}, {"set", {{"target_format", "rgba8"}}}}};
  EXPECT_TRUE(run(json).results.parity.empty());
}

}  // namespace
}  // namespace volumark
