// What each part of an error is worth, in runs on the cpu backend: parts come from what parameters declare, and their
// figures are those of a cell with that setting.
#include "harness/attribution.h"

#include <algorithm>
#include <cmath>

#include "tests/unit/harness/tiny_run.h"

namespace volumark {
namespace {

const AttributionPart* part_of(const Attribution& entry, const std::string& parameter) {
  const auto found = std::find_if(entry.parts.begin(), entry.parts.end(),
                                  [&](const AttributionPart& part) { return part.parameter == parameter; });
  return found == entry.parts.end() ? nullptr : &*found;
}

class AttributionTest : public TinyRun {
 protected:
  // One cell, explained.
  Attribution explained(const Json& method) {
    Json json = experiment(Json::array({method}));
    json["attribute"] = true;
    outcome_ = run(json);
    EXPECT_EQ(outcome_.results.attribution.size(), 1U);
    EXPECT_TRUE(validate_results(to_json(outcome_.results)).empty());
    return outcome_.results.attribution.empty() ? Attribution{} : outcome_.results.attribution[0];
  }
  // RMSE of the cell with these settings, in one view.
  double error_with(const Json& method, int64_t view) {
    const RunOutcome outcome = run(experiment(Json::array({method})));
    return outcome.results.results.at(0).views.at(static_cast<size_t>(view)).error->rmse;
  }
  int64_t worst_view() const {
    const auto& views = outcome_.results.results[0].views;
    return views[0].error->rmse >= views[1].error->rmse ? 0 : 1;
  }

  RunOutcome outcome_;
};

TEST_F(AttributionTest, ACoarseTargetIsFoundAndItsFiguresAreThoseOfACell) {
  const Json method = {{"method", "texture3d_slices"}, {"set", {{"target_format", "rgba8"}, {"step", 0.25}}}};
  const Attribution entry = explained(method);
  EXPECT_EQ(entry.error, outcome_.results.results[0].error->worst.rmse);
  ASSERT_FALSE(entry.parts.empty());
  EXPECT_EQ(entry.parts[0].parameter, "target_format");
  EXPECT_EQ(entry.parts[0].aspect, "target format");
  EXPECT_GT(entry.parts[0].worth, 0.5);
  EXPECT_GT(entry.parts[0].seconds, 0);
  EXPECT_EQ(std::get<std::string>(entry.parts[0].from), "rgba8");
  EXPECT_EQ(std::get<std::string>(entry.parts[0].to), "rgba32f");
  for (const AttributionPart& part : entry.parts)
    EXPECT_NEAR(part.worth, 1 - std::pow(part.error / entry.error, 2), 1e-12) << part.parameter;
  // Parameters that are ideal as they are have no part.
  EXPECT_EQ(part_of(entry, "opacity_correction"), nullptr);
  EXPECT_EQ(part_of(entry, "classification"), nullptr);
  ASSERT_NE(part_of(entry, "step"), nullptr);

  const int64_t view = worst_view();
  Json ideal = method;
  ideal["set"]["target_format"] = "rgba32f";
  EXPECT_EQ(entry.parts[0].error, error_with(ideal, view));
  ideal = method;
  for (const AttributionPart& part : entry.parts)
    ideal["set"][part.parameter] = std::visit([](const auto& v) { return Json(v); }, part.to);
  EXPECT_EQ(entry.all_ideal, error_with(ideal, view));
  EXPECT_LT(entry.all_ideal, entry.error);
}

TEST_F(AttributionTest, WrongOpacityIsWorthMost) {
  const Attribution entry =
      explained({{"method", "texture3d_slices"}, {"set", {{"opacity_correction", "linear"}, {"step", 0.5}}}});
  ASSERT_FALSE(entry.parts.empty());
  EXPECT_EQ(entry.parts[0].aspect, "opacity correction");
  EXPECT_GT(entry.parts[0].worth, 0.5);
}

TEST_F(AttributionTest, APictureOfTheRunIsNotDrawnAgain) {
  Json json = experiment({{{"method", "raycast"}, {"sweep", {1, 0.5, 0.125}}}});
  json["attribute"] = true;
  const RunOutcome outcome = run(json);
  ASSERT_EQ(outcome.results.attribution.size(), 1U);
  const Attribution& entry = outcome.results.attribution[0];
  EXPECT_EQ(std::get<double>(entry.key.params.at("step")), 0.5);  // the default among those measured
  const AttributionPart* step = part_of(entry, "step");
  ASSERT_NE(step, nullptr);
  const Result& finest = outcome.results.results[2];
  ASSERT_EQ(std::get<double>(finest.key.params.at("step")), 0.125);
  // The very sample median of that cell: a second measurement would differ.
  EXPECT_TRUE(std::any_of(finest.views.begin(), finest.views.end(),
                          [&](const ViewResult& view) { return view.frame_wall->median == step->seconds; }));
}

TEST_F(AttributionTest, TheFinestStandsWhereTheDefaultWasNotMeasured) {
  Json json = experiment({{{"method", "raycast"}, {"sweep", {4, 2}}}});
  json["attribute"] = true;
  const RunOutcome outcome = run(json);
  ASSERT_EQ(outcome.results.attribution.size(), 1U);
  EXPECT_EQ(std::get<double>(outcome.results.attribution[0].key.params.at("step")), 2);
}

// The variants of a scene have series with floors of their own; what is taken apart is the scene as it is.
TEST_F(AttributionTest, StandsBesideSwitchedEffects) {
  Json cut = scene();
  cut["effects"]["clip_planes"] = {{{"normal", {1, 0.2, 0}}, {"distance", 0}}};
  Json json = experiment(
      {{{"method", "texture3d_slices"}, {"set", {{"target_format", "rgba8"}}}, {"sweep", {1, 0.5, 0.25, 0.125}}}});
  json["attribute"] = json["effects"] = true;
  const RunOutcome outcome = run(json, cut);
  const Results& results = outcome.results;
  const auto floors = std::count_if(results.convergence.begin(), results.convergence.end(),
                                    [](const Convergence& row) { return row.floor > 0; });
  EXPECT_GE(floors, 2) << "8 bits hold the error of the scene as it is, and of the one without its clip plane";
  EXPECT_FALSE(results.effects.empty());
  EXPECT_FALSE(results.attribution.empty());
  for (const Attribution& entry : results.attribution) EXPECT_EQ(entry.key.variant, "");
  EXPECT_TRUE(validate_results(to_json(results)).empty());
}

TEST_F(AttributionTest, ResumeKeepsWhatThereIsAndMakesWhatIsMissing) {
  Json json = experiment({{{"method", "raycast"}}, {{"method", "texture3d_slices"}}});
  json["attribute"] = true;
  json["pairs"] = true;
  run(json);
  Results results = read_results(folder_.path() / "out");
  ASSERT_EQ(results.attribution.size(), 2U);
  ASSERT_EQ(results.pairs.size(), 1U);
  EXPECT_EQ(results.pairs[0].noise_a, 0);  // the cpu backend repeats itself
  EXPECT_EQ(results.pairs[0].noise_b, 0);
  EXPECT_GT(results.pairs[0].rmse, 0);
  results.attribution[1].command = "kept";
  results.attribution.erase(results.attribution.begin());
  results.pairs.clear();
  write_results(results, folder_.path() / "out" / "results.json");
  const RunOutcome again = run(json, scene(), true);
  EXPECT_EQ(again.skipped, 2);
  ASSERT_EQ(again.results.attribution.size(), 2U);
  EXPECT_TRUE(std::any_of(again.results.attribution.begin(), again.results.attribution.end(),
                          [](const Attribution& entry) { return entry.command == "kept"; }));
  for (const Attribution& entry : again.results.attribution)
    for (const AttributionPart& part : entry.parts) EXPECT_GE(part.error, 0) << part.parameter << ": " << part.note;
  ASSERT_EQ(again.results.pairs.size(), 1U);
  EXPECT_GT(again.results.pairs[0].rmse, 0);
  EXPECT_GT(again.results.pairs[0].bound, 0);
}

// A part that cannot be drawn says why and stops nothing: here no more than an instant is allowed.
TEST_F(AttributionTest, APartThatFailsIsANote) {
  const Attribution whole = explained({{"method", "raycast"}});
  Experiment experiment = load_experiment((folder_.path() / "tiny.json").string());
  experiment.timeout = 1e-9;
  const std::vector<Experiment> experiments = {experiment};
  const std::vector<Group> groups = plan_cells(experiments, {}, {});
  SceneContext context;
  context.scene = load_scene((folder_.path() / "tiny_scene.json").string());
  load_data(context.scene, {});
  const Attribution entry =
      attribute({&groups.at(0), &groups[0].cells.at(0)}, context, CellOptions{}, outcome_.results);
  ASSERT_EQ(entry.parts.size(), whole.parts.size());
  for (const AttributionPart& part : entry.parts) {
    EXPECT_TRUE(std::isnan(part.error));
    EXPECT_NE(part.note.find("timeout"), std::string::npos) << part.note;
  }
  EXPECT_NE(entry.note.find("timeout"), std::string::npos);
}

TEST_F(AttributionTest, RoundingOfFloatsIsNotTakenApart) {
  Json json = experiment(Json::array({{{"method", "raycast"}}}));
  json["attribute"] = true;
  Json slab = scene();  // homogeneous: exact at any step
  slab["volume"] = {{"generator", {{"kind", "constant"}, {"size", 4}, {"type", "f32"}, {"value", 1}}}};
  slab["transfer"]["points"] = Json::array({{{"value", 1}, {"colour", {1, 0.5, 0.2}}, {"extinction", 1}}});
  const RunOutcome outcome = run(json, slab);
  ASSERT_EQ(outcome.results.attribution.size(), 1U);
  const Attribution& entry = outcome.results.attribution[0];
  EXPECT_LT(entry.error, 1e-6);
  EXPECT_TRUE(entry.parts.empty());
  EXPECT_EQ(entry.all_ideal, entry.error);
  EXPECT_FALSE(entry.note.empty());
}

// ---- Floors ----

class FloorTest : public testing::Test {
 protected:
  FloorTest() {
    Result result;
    result.key = {"e", "s", "m", "cpu", {{"step", 0.25}}, ""};
    result.quality = Quality{"step", 0.25};
    results_.results.push_back(result);
    Convergence row;
    row.key = {"e", "s", "m", "cpu", {}, ""};
    row.parameter = "step";
    row.values = {1, 0.5, 0.25};
    row.floor = 1e-3;
    results_.convergence.push_back(row);
    Attribution entry;
    entry.key = result.key;
    entry.error = 1e-3;
    entry.bound = 1e-7;
    results_.attribution.push_back(entry);
  }
  void add(const char* aspect, double worth) {
    AttributionPart part;
    part.aspect = aspect;
    part.worth = worth;
    results_.attribution[0].parts.push_back(part);
  }
  std::string reason(double all_ideal) {
    results_.attribution[0].all_ideal = all_ideal;
    explain_floors(results_);
    return results_.convergence[0].floor_reason;
  }
  Results results_;
};

TEST_F(FloorTest, NamesWhatIsWorthMost) {
  add("volume texture and filter", 0.98);
  add("step", 0.01);
  EXPECT_EQ(reason(1e-5), "volume texture and filter (98 % of the squared error)");
}

TEST_F(FloorTest, WhatNoPartTakesAwayIsTheMethodsOwn) {
  add("step", 0.01);
  EXPECT_EQ(reason(0.999e-3), "the method's own");
}

TEST_F(FloorTest, WhereTheIdealCannotBeDrawnTheRestIsNotKnown) {
  results_.attribution[0].note = "with all parts ideal: out of memory";
  const double nan = std::nan("");
  EXPECT_EQ(reason(nan), "not known: with all parts ideal: out of memory");
  add("step", 0.9);
  EXPECT_EQ(reason(nan), "step (90 % of the squared error)");
}

TEST_F(FloorTest, BothAreNamedWhereBothMatter) {
  add("step", 0.5);
  EXPECT_EQ(reason(1e-3 * std::sqrt(0.5)), "step (50 % of the squared error), the method's own (50 %)");
}

TEST_F(FloorTest, AtTheBound) {
  results_.attribution[0].error = 1e-8;
  EXPECT_EQ(reason(1e-8), "at the reference's bound");
}

TEST_F(FloorTest, RoundingHasNoParts) {
  results_.attribution[0].error = 2e-7;
  EXPECT_EQ(reason(2e-7), "rounding of single precision");
}

TEST_F(FloorTest, WithoutAttributionItIsNotKnown) {
  results_.attribution.clear();
  explain_floors(results_);
  EXPECT_EQ(results_.convergence[0].floor_reason, "");
}

}  // namespace
}  // namespace volumark
