// Papers and claims in experiment files: what is right is read, what is wrong is refused with its place.
#include "harness/parse_claims.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/errors.h"

namespace volumark {
namespace {

using Json = nlohmann::json;

Json valid() {
  return Json::parse(R"({
    "name": "e",
    "scenes": ["sphere", "slab"],
    "methods": [{"method": "slices2d", "sweep": [100, 200, 400]},
                {"method": "slices2d", "set": {"textures_per_polygon": "2"}, "sweep": [100, 200, 400]},
                {"method": "raycast"}],
    "backends": ["cpu", "gl"],
    "paper": {"key": "someone2000", "cells": [
      {"where": {"method": "raycast", "scene": "slab"}, "table": "1", "cell": "rays", "unit": "frames/s",
       "published": 12}]},
    "claims": [
      {"id": "R1", "text": "faster", "rule": "ratio", "measure": "frame_wall", "expected": 1.8, "tolerance": 0.1,
       "numerator": {"method": "slices2d", "params": {"textures_per_polygon": "1"}},
       "denominator": {"method": "slices2d", "params": {"textures_per_polygon": "2"}},
       "not_comparable": {"gl": "no clock"}},
      {"id": "R2", "text": "linear", "rule": "shape", "measure": "frame_wall", "over": "slices", "within": [0.9, null],
       "of": {"method": "slices2d"}},
      {"id": "R3", "text": "order", "rule": "order", "measure": "error.rmse", "less": {"method": "raycast"},
       "more": {"method": "slices2d", "params": {"slices": 100, "textures_per_polygon": "1"}}}
    ]
  })");
}

Claims parse(const Json& json) { return parse_experiment(json.dump(), "/tmp/e.json").claims; }

std::string refusal(const Json& json) {
  try {
    parse(json);
    return "accepted";
  } catch (const SceneError& error) {
    return error.what();
  }
}

TEST(ParseClaims, EveryKeyIsRead) {
  const Claims claims = parse(valid());
  EXPECT_EQ(claims.paper, "someone2000");
  ASSERT_EQ(claims.cells.size(), 1U);
  EXPECT_EQ(claims.cells[0].published, 12);
  EXPECT_EQ(claims.cells[0].measure, "frame_wall");
  ASSERT_EQ(claims.claims.size(), 3U);
  const ClaimSpec& ratio = claims.claims[0];
  EXPECT_EQ(ratio.rule, ClaimRule::Ratio);
  EXPECT_NEAR(*ratio.limit_lo, 1.62, 1e-12);
  EXPECT_NEAR(*ratio.limit_hi, 1.98, 1e-12);
  EXPECT_EQ(std::get<std::string>(ratio.against->params.at("textures_per_polygon")), "2");
  EXPECT_EQ(ratio.not_comparable.at("gl"), "no clock");
  EXPECT_EQ(ratio.cells, 6U);  // two scenes, three values
  EXPECT_EQ(claims.claims[1].over, "slices");
  EXPECT_FALSE(claims.claims[1].limit_hi);
  EXPECT_TRUE(std::isnan(claims.claims[1].expected));
  EXPECT_EQ(std::get<int64_t>(claims.claims[2].against->params.at("slices")), 100);
}

TEST(ParseClaims, MistakesAreNamedWithTheirPlace) {
  struct Bad {
    const char* pointer;
    Json value;
    const char* message;
  };
  const std::vector<Bad> cases = {
      {"/claims/0/measure", "frame_wal", "/claims/0/measure: unknown measure"},
      {"/claims/0/rule", "ration", "/claims/0/rule"},
      {"/claims/0/numerator/method", "slices3d", "is not in this experiment (did you mean"},
      {"/claims/0/numerator/scene", "cloud", "scene \"cloud\" is not in this experiment"},
      {"/claims/0/numerator/params/textures_per_polygon", "4", "/claims/0/numerator: chooses no cell"},
      {"/claims/0/numerator/params/texturs_per_polygon", "2", "/claims/0/numerator/params/texturs_per_polygon"},
      {"/claims/0/denominator/params", Json::object(), "chooses no cell of its scene, or several"},
      {"/claims/0/within", {1, 2}, "needs either"},
      {"/claims/0/of", {{"method", "raycast"}}, "/claims/0/of: not of the rule ratio"},
      {"/claims/0/not_comparable/vulkan", "why", "backend \"vulkan\" is not in this experiment"},
      {"/claims/1/within", {2, 1}, "/claims/1/within: the ends are in the wrong order"},
      {"/claims/1/within", {nullptr, nullptr}, "one end at least"},
      {"/claims/1/over", "target_format", "has no numeric parameter"},
      {"/claims/1/over", "table_size", "an exponent needs three values"},
      {"/claims/1/id", "R1", "the id \"R1\" is there twice"},
      {"/claims/2/tolerance", 0.1, "a tolerance is relative to"},
      {"/claims/2/less/params", {{"step", -1}}, "/claims/2/less/params/step"},
      {"/paper/cells/0/where/params", {{"step", 0.25}}, "/paper/cells/0/where: chooses no cell"},
      {"/paper/cells/0/published", "12", "/paper/cells/0/published"},
      {"/paper/kee", "x", "kee"},
  };
  for (const Bad& bad : cases) {
    Json json = valid();
    json[Json::json_pointer(bad.pointer)] = bad.value;
    EXPECT_NE(refusal(json).find(bad.message), std::string::npos) << bad.pointer << ": " << refusal(json);
  }
}

// A method of isosurfaces draws nothing of a scene that shows its volume directly: no cell, nothing to choose.
TEST(ParseClaims, WhatAMethodDoesNotDrawIsNoCell) {
  Json json = valid();
  json["scenes"] = {"slab", "engine_iso"};
  json["methods"].push_back({{"method", "texture3d_slices_iso"}});
  EXPECT_EQ(parse(json).claims[0].cells, 3U);
  json["claims"][0]["numerator"]["scene"] = "engine_iso";
  EXPECT_NE(refusal(json).find("/claims/0/numerator: chooses no cell"), std::string::npos) << refusal(json);
}

TEST(ParseClaims, ClaimsNeedAPaper) {
  Json json = valid();
  json.erase("paper");
  EXPECT_NE(refusal(json).find("claims are of a paper"), std::string::npos) << refusal(json);
}

TEST(ParseClaims, ParametersNeedTheirMethod) {
  Json json = valid();
  json["claims"][0]["numerator"].erase("method");
  EXPECT_NE(refusal(json).find("/claims/0/numerator/params: parameters are of a method"), std::string::npos)
      << refusal(json);
}

TEST(ParseClaims, ShippedPapersAreRead) {
  size_t papers = 0;
  for (const ExperimentEntry& entry : list_experiments()) {
    const Experiment experiment = load_experiment(entry.name);
    if (experiment.claims.paper.empty()) continue;
    ++papers;
    EXPECT_FALSE(experiment.claims.claims.empty()) << entry.name;
  }
  EXPECT_GE(papers, 3U);
}

}  // namespace
}  // namespace volumark
