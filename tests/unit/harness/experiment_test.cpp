// Experiment files: what is right is read, what is wrong is refused with its place and what was expected.
#include "harness/experiment.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "scenes/errors.h"

namespace volumark {
namespace {

using Json = nlohmann::json;

Json valid() {
  return {{"name", "e"},
          {"title", "An experiment"},
          {"scenes", {"sphere", "slab"}},
          {"methods", {{{"method", "raycast"}, {"set", {{"classification", "post"}}}, {"sweep", {2, 1, 0.5}}}}},
          {"backends", {"cpu", "gl"}},
          {"views", 2},
          {"image_size", {64, 32}},
          {"sampling", {{"least", 2}, {"most", 9}, {"budget", 0.5}, {"precision", 0.1}, {"timeout", 5}}},
          {"images", "none"},
          {"reference_tolerance", 1e-5},
          {"limits", {{"rmse", 0.1}}},
          {"finest_limits", {{"max", 0.2}}},
          {"parity", 0.002},
          {"expect_order_on", {"sphere"}}};
}

Experiment parse(const Json& json) { return parse_experiment(json.dump(), "/tmp/e.json"); }

std::string refusal(const Json& json) {
  try {
    parse(json);
    return "accepted";
  } catch (const SceneError& error) {
    return error.what();
  }
}

TEST(Experiment, EveryKeyIsRead) {
  const Experiment e = parse(valid());
  EXPECT_EQ(e.scenes, (std::vector<std::string>{"sphere", "slab"}));
  ASSERT_EQ(e.methods.size(), 1U);
  EXPECT_EQ(e.methods[0].method->info().name, "raycast");
  EXPECT_EQ(std::get<std::string>(e.methods[0].values.at("classification")), "post");
  EXPECT_EQ(e.methods[0].quality_axis, "step");
  EXPECT_EQ(e.methods[0].sweep, (std::vector<double>{2, 1, 0.5}));
  EXPECT_EQ(e.backends, (std::vector<std::string>{"cpu", "gl"}));
  EXPECT_EQ(e.view_count, 2);
  EXPECT_EQ(*e.width, 64);
  EXPECT_EQ(*e.height, 32);
  EXPECT_EQ(e.least, 2);
  EXPECT_EQ(e.most, 9);
  EXPECT_EQ(e.budget, 0.5);
  EXPECT_EQ(e.precision, 0.1);
  EXPECT_EQ(e.timeout, 5);
  EXPECT_EQ(e.images, Experiment::Images::None);
  EXPECT_EQ(e.reference_tolerance, 1e-5);
  EXPECT_EQ(e.limits.at("rmse"), 0.1);
  EXPECT_EQ(e.finest_limits.at("max"), 0.2);
  EXPECT_EQ(e.parity, 0.002);
  EXPECT_EQ(e.expect_order_on, (std::vector<std::string>{"sphere"}));
}

TEST(Experiment, ReferencesCanBeSwitchedOff) {
  Json json = valid();
  EXPECT_TRUE(parse(json).references);
  for (const char* needing : {"limits", "finest_limits", "expect_order_on"}) json.erase(needing);
  json["references"] = false;
  EXPECT_FALSE(parse(json).references);
}

TEST(Experiment, DefaultSweepIsTheMethods) {
  Json json = valid();
  json["methods"][0]["sweep"] = "default";
  const Experiment e = parse(json);
  EXPECT_GT(e.methods[0].sweep.size(), 2U);
}

struct Bad {
  const char* pointer;  // where the new value goes
  Json value;
  const char* message;  // part of what must be said
};

TEST(Experiment, MistakesAreNamedWithTheirPlace) {
  const std::vector<Bad> cases = {
      {"/scens", Json::array({"sphere"}), "scenes"},
      {"/name", "other", "expected the file's name"},
      {"/scenes/0", "spere", "did you mean \"sphere\"?"},
      {"/scenes/1", "sphere", "named twice"},
      {"/scenes", Json::array(), "/scenes"},
      {"/methods/0/method", "raycst", "did you mean \"raycast\"?"},
      {"/methods/0/sweeps", 1, "sweep"},
      {"/methods/0/set/stp", 1, "did you mean \"step\"?"},
      {"/methods/0/set/step", "fine", "/methods/0/set/step"},
      {"/methods/0/set/step", -1, "out of range"},
      {"/methods/0/sweep/2", 3, "from coarse to fine"},
      {"/methods/0/sweep/0", 1e9, "/methods/0/sweep/0"},
      {"/methods/0/sweep", "fine", "default"},
      {"/backends/0", "gpu", "unknown backend"},
      {"/backends/1", "cpu", "named twice"},
      {"/views", 0, "/views"},
      {"/views", Json::array({0, 0}), "named twice"},
      {"/views", Json::array({-1}), "/views/0"},
      {"/image_size", Json::array({64}), "/image_size"},
      {"/image_size/1", 0, "/image_size/1"},
      {"/sampling/budget", -1, "/sampling/budget"},
      {"/sampling/most", 1, "below least"},
      {"/sampling/seconds", 1, "seconds"},
      {"/images", "some", "/images"},
      {"/references", "no", "/references"},
      {"/references", false, "/limits: needs references, which are switched off"},
      {"/limits/rms", 1, "did you mean \"rmse\"?"},
      {"/limits/rmse", -1, "/limits/rmse"},
      {"/parity", "yes", "/parity"},
      {"/expect_order_on/0", "cloud", "/expect_order_on/0"},
  };
  for (const Bad& bad : cases) {
    Json json = valid();
    json[Json::json_pointer(bad.pointer)] = bad.value;
    const std::string said = refusal(json);
    EXPECT_NE(said.find(bad.message), std::string::npos) << bad.pointer << ": " << said;
    EXPECT_NE(said.find("/tmp/e.json"), std::string::npos) << said;
  }
}

TEST(Experiment, RequiredKeysAreRequired) {
  for (const char* key : {"name", "scenes", "methods", "backends"}) {
    Json json = valid();
    json.erase(key);
    EXPECT_NE(refusal(json).find(key), std::string::npos) << key;
  }
}

TEST(Experiment, SyntaxErrorsSayTheLine) {
  try {
    parse_experiment("{\n \"name\": \"e\",\n oops\n}", "/tmp/e.json");
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("/tmp/e.json:3:"), std::string::npos) << error.what();
  }
}

TEST(Experiment, ShippedOnesParse) {
  const auto entries = list_experiments();
  ASSERT_FALSE(entries.empty());
  for (const ExperimentEntry& entry : entries) EXPECT_NO_THROW(load_experiment(entry.name)) << entry.name;
}

TEST(Experiment, UnknownNameSuggestsTheNearest) {
  try {
    load_experiment("quik");
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean \"quick\"?"), std::string::npos) << error.what();
  }
  EXPECT_THROW(load_experiment("/nonexistent/e.json"), SceneError);
}

TEST(ChosenViews, CountsAreSpreadEvenlyAndIndicesKept) {
  Experiment e;
  e.view_count = 2;
  EXPECT_EQ(chosen_views(e, 8), (std::vector<int>{0, 4}));
  EXPECT_EQ(chosen_views(e, 1), (std::vector<int>{0}));
  e.view_count = 0;
  EXPECT_EQ(chosen_views(e, 3), (std::vector<int>{0, 1, 2}));
  e.views = {5, 1, 9};
  EXPECT_EQ(chosen_views(e, 8), (std::vector<int>{5, 1}));
}

}  // namespace
}  // namespace volumark
