// The scenes that we ship: they parse, match the schema file in every key, and say where their data come from.
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "helpers.h"
#include "scenes/scene_io.h"
#include "scenes/shell.h"

namespace volumark {
namespace {

using nlohmann::json;

std::string read_text(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

json schema() { return json::parse(read_text(std::string(VM_SOURCE_DIR) + "/scenes/scene.schema.json")); }

// The part of JSON Schema that our file uses: $ref, oneOf, type, properties, additionalProperties, required, items,
// enum, const. Returns what does not match.
std::string schema_error(const json& value, const json& rule, const json& root, const std::string& at) {
  if (rule.contains("$ref")) {
    const std::string reference = rule["$ref"];
    return schema_error(value, root.at(json::json_pointer(reference.substr(1))), root, at);
  }
  if (rule.contains("oneOf")) {
    std::string all;
    int matches = 0;
    for (const json& option : rule["oneOf"]) {
      const std::string failed = schema_error(value, option, root, at);
      matches += failed.empty() ? 1 : 0;
      all += failed + "; ";
    }
    return matches == 1 ? "" : at + ": " + std::to_string(matches) + " of the alternatives match: " + all;
  }
  if (rule.contains("const") && value != rule["const"]) return at + ": not " + rule["const"].dump();
  if (rule.contains("enum") && std::find(rule["enum"].begin(), rule["enum"].end(), value) == rule["enum"].end()) {
    return at + ": not one of " + rule["enum"].dump();
  }
  const std::string type = rule.value("type", "");
  if ((type == "object" && !value.is_object()) || (type == "array" && !value.is_array()) ||
      (type == "number" && !value.is_number()) || (type == "integer" && !value.is_number_integer()) ||
      (type == "string" && !value.is_string()) || (type == "boolean" && !value.is_boolean())) {
    return at + ": not of type " + type;
  }
  if (type == "object") {
    for (const json& key : rule.value("required", json::array())) {
      if (!value.contains(key)) return at + ": no key " + key.get<std::string>();
    }
    for (const auto& [key, part] : value.items()) {
      if (!rule["properties"].contains(key)) return at + ": unknown key " + key;
      const std::string failed = schema_error(part, rule["properties"][key], root, at + "/" + key);
      if (!failed.empty()) return failed;
    }
  }
  if (type == "array") {
    for (size_t i = 0; i < value.size(); ++i) {
      const std::string failed = schema_error(value[i], rule["items"], root, at + "/" + std::to_string(i));
      if (!failed.empty()) return failed;
    }
  }
  return "";
}

glm::dvec3 middle_of(const Volume& volume) { return glm::dvec3(volume.box_to_world() * glm::dvec4(0.5, 0.5, 0.5, 1)); }
glm::dvec3 middle_of(const Shell& shell) {
  const ShellBounds bounds = bounds_of(shell);
  return 0.5 * (bounds.lo + bounds.hi);
}

TEST(ShippedScenes, AreThere) {
  std::vector<std::string> names;
  for (const SceneEntry& entry : list_scenes()) {
    names.push_back(entry.name);
    EXPECT_FALSE(entry.title.empty()) << entry.path;
  }
  for (const char* name :
       {"brain",         "ch2",           "cloud",        "engine",      "marschner_lobb", "slab",
        "sphere",        "vessels",       "vessels_iso",  "vessels64",   "engine_iso",     "brain_iso",
        "cranium",       "cranium_bone",  "cranium_skin", "shell_torus", "shell_terrain",  "shell_chain",
        "shell_carpark", "shell_volcano", "shell_fur"}) {
    EXPECT_THAT(names, testing::Contains(name));
  }
}

TEST(ShippedScenes, MatchTheSchema) {
  const json rules = schema();
  for (const SceneEntry& entry : list_scenes()) {
    EXPECT_EQ(schema_error(json::parse(read_text(entry.path)), rules, rules, ""), "") << entry.path;
  }
}

TEST(ShippedScenes, TheSchemaRefusesWhatTheParserRefuses) {
  const json rules = schema();
  json scene = json::parse(read_text((scene_directory() / "engine.json").string()));
  scene["transfer"]["points"][0]["color"] = {1, 1, 1};
  EXPECT_NE(schema_error(scene, rules, rules, ""), "");
}

TEST(ShippedScenes, HaveEightViewsAndFilesStateTheirOrigin) {
  for (const SceneEntry& entry : list_scenes()) {
    const Scene scene = load_scene(entry.name);
    EXPECT_GE(scene.views.size(), 8u) << entry.name;
    EXPECT_THAT(scene.width, testing::AnyOf(512, 600)) << entry.name;  // 600: the viewport of Rezk-Salama 2000
    EXPECT_EQ(scene.width, scene.height) << entry.name;
    EXPECT_EQ(scene.hash.size(), 64u) << entry.name;
    if (scene.source.origin == "procedural") continue;
    EXPECT_EQ(scene.source.sha256.size(), 64u) << entry.name;
    EXPECT_FALSE(scene.source.licence.empty()) << entry.name;
    EXPECT_FALSE(scene.source.how_to_get.empty()) << entry.name;
    EXPECT_THAT(read_text(std::string(VM_SOURCE_DIR) + "/scripts/fetch_data.sh"),
                testing::HasSubstr(scene.source.sha256))
        << entry.name;
  }
}

TEST(ShippedScenes, ProceduralOnesLoadAndTheViewsSeeThem) {
  for (const SceneEntry& entry : list_scenes()) {
    Scene scene = load_scene(entry.name);
    if (scene.source.origin != "procedural") continue;
    load_data(scene, {});
    ASSERT_NE(scene.volume == nullptr, scene.shell == nullptr);
    const glm::dvec3 centre = scene.shell ? middle_of(*scene.shell) : middle_of(*scene.volume);
    for (const View& view : scene.views) {
      if (view.name.starts_with("close")) continue;  // of a detail
      const glm::dvec4 clip = world_to_clip(view, scene.width, scene.height, 1e3) * glm::dvec4(centre, 1);
      EXPECT_LT(std::abs(clip.x / clip.w), scene.shell ? 0.3 : 0.05) << entry.name << " " << view.name;
      EXPECT_LT(std::abs(clip.y / clip.w), scene.shell ? 0.3 : 0.05) << entry.name << " " << view.name;
    }
  }
}

// tau L = 1 head-on, and x = 2 tau R = 2: the figures in the scenes' descriptions.
TEST(ShippedScenes, SlabAndSphereAreWhatTheySay) {
  const Scene slab = load_scene("slab", DataOptions{});
  EXPECT_DOUBLE_EQ(slab.transfer.at(1).w * slab.volume->extent().z, 1);
  const Scene sphere = load_scene("sphere", DataOptions{});
  EXPECT_DOUBLE_EQ(2 * sphere.transfer.at(0.5).w * 0.8, 2);
  EXPECT_EQ(sphere.transfer.at(0.8).w, 0);
}

// With the data on this machine (scripts/fetch_data.sh); required in CI, where VOLUMARK_REQUIRE_DATA is set.
TEST(ShippedScenes, RealDataLoad) {
  for (const SceneEntry& entry : list_scenes()) {
    Scene scene = load_scene(entry.name);
    if (scene.source.origin == "procedural") continue;
    try {
      load_data(scene, data_options_from_environment());
    } catch (const DataMissing& missing) {
      if (std::getenv("VOLUMARK_REQUIRE_DATA") != nullptr) FAIL() << missing.what();
      GTEST_SKIP() << missing.what();
    }
    if (scene.shell) continue;
    const bool cranium = entry.name.starts_with("cranium"), ch2 = entry.name.starts_with("ch2");
    EXPECT_EQ(scene.volume->min_value, cranium ? -1024 : 0) << entry.name;
    EXPECT_EQ(scene.volume->max_value, cranium ? 2986 : ch2 ? 254 : 255) << entry.name;
    if (cranium) {
      EXPECT_EQ(scene.volume->size, glm::ivec3(256, 256, 108));
      EXPECT_EQ(scene.volume->type, VoxelType::I16);
      EXPECT_EQ(scene.volume->spacing, glm::dvec3(0.9570312, 0.9570312, 1.5));
    }
    if (entry.name == "ch2") {
      EXPECT_EQ(scene.volume->size, glm::ivec3(181, 217, 181));
      EXPECT_EQ(scene.volume->origin, glm::dvec3(-90, -125, -71));
    }
    if (entry.name == "brain") {
      EXPECT_EQ(scene.volume->extent(), glm::dvec3(255, 255, 162));
    }
  }
}

}  // namespace
}  // namespace volumark
