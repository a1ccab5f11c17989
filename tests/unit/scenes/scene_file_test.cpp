#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "helpers.h"
#include "scenes/scene_io.h"

namespace volumark {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

// A complete scene of a few samples; tests change one thing each.
json small_scene() {
  return json::parse(R"({
    "volumark_scene": 1, "title": "t",
    "volume": {"generator": {"kind": "constant", "size": [5, 3, 3], "value": 1}},
    "transfer": {"points": [{"value": 0, "colour": [1, 0.5, 0], "extinction": 1}]},
    "views": [{"eye": [0, 0, 4], "target": [0, 0, 0], "fov_y": 60}]
  })");
}

Scene parse(const json& document) { return parse_scene(document.dump(), "dir/t.json"); }
Scene loaded(const json& document) {
  Scene scene = parse(document);
  load_data(scene, {});
  return scene;
}
std::string error(const json& document) {
  return test::message_of<SceneError>([&] { parse(document); });
}
std::string text_error(const std::string& text) {
  return test::message_of<SceneError>([&] { parse_scene(text, "dir/t.json"); });
}
std::string error_with(const char* pointer, const json& value) {
  json document = small_scene();
  document[json::json_pointer(pointer)] = value;
  return error(document);
}

TEST(SceneFile, DefaultsAndNames) {
  const Scene s = parse(small_scene());
  EXPECT_EQ(s.name, "t");
  EXPECT_EQ(s.path, "dir/t.json");
  EXPECT_EQ(s.width, 512);
  EXPECT_EQ(s.height, 512);
  EXPECT_EQ(s.background, glm::dvec3(0));
  EXPECT_EQ(s.source.origin, "procedural");
  EXPECT_EQ(s.volume, nullptr);
  EXPECT_TRUE(effect_names(s.effects).empty());
  ASSERT_EQ(s.views.size(), 1u);
  EXPECT_NEAR(s.views[0].fov_y, std::numbers::pi / 3, 1e-15);
  EXPECT_NEAR(s.views[0].near, 0.04, 1e-15);
  EXPECT_LT(s.transfer.lo, s.transfer.hi);
}

TEST(SceneFile, SyntaxErrorsSayLineAndColumn) {
  EXPECT_THAT(text_error("{\n  \"title\": \"t\",\n  oops\n}"), HasSubstr("dir/t.json:3:3"));
  EXPECT_THAT(text_error(""), HasSubstr("dir/t.json:1:1"));
  EXPECT_THAT(text_error("{\"a\": [1, 2"), HasSubstr("dir/t.json:1:"));
  EXPECT_THAT(text_error("{\n\n \"a\": 1e999}"), AllOf(HasSubstr("dir/t.json:3:7"), HasSubstr("too large")));
  EXPECT_THAT(text_error("\"\xff\""), HasSubstr("dir/t.json:1:"));
  EXPECT_THAT(text_error("{\"a\": 1, \"a\": 2}"), HasSubstr("\"a\" appears twice"));
  EXPECT_THAT(text_error(std::string(5000, '[')), HasSubstr("32 levels"));
}

TEST(SceneFile, UnknownKeysNameTheNearest) {
  EXPECT_THAT(error_with("/descripton", "x"),
              AllOf(HasSubstr("dir/t.json"), HasSubstr("\"descripton\""), HasSubstr("did you mean \"description\"")));
  EXPECT_THAT(error_with("/transfer/points/0/color", json::array({1, 1, 1})),
              AllOf(HasSubstr("/transfer/points/0"), HasSubstr("did you mean \"colour\"")));
  EXPECT_THAT(error_with("/volume/generator/octaves", 3), AllOf(HasSubstr("/volume/generator"), HasSubstr("octaves")));
  EXPECT_THAT(error_with("/volume/generator/kind", "constnat"), HasSubstr("did you mean \"constant\""));
  EXPECT_THAT(error_with("/effects", {{"lightning", json::object()}}), HasSubstr("did you mean \"lighting\""));
}

TEST(SceneFile, MissingKeysAndWrongTypes) {
  for (const char* key : {"volumark_scene", "title", "volume", "transfer", "views"}) {
    json document = small_scene();
    document.erase(key);
    EXPECT_THAT(error(document), HasSubstr(std::string("missing key \"") + key + "\""));
  }
  EXPECT_THAT(error(json::array()), HasSubstr("expected an object"));
  EXPECT_THAT(error_with("/volumark_scene", 2), HasSubstr("/volumark_scene: expected a whole number from 1 to 1"));
  EXPECT_THAT(error_with("/title", 5), HasSubstr("/title: expected a text, found 5"));
  EXPECT_THAT(error_with("/image", {{"width", 0}, {"height", 4}}), HasSubstr("/image/width"));
  EXPECT_THAT(error_with("/image", {{"width", 1.5}, {"height", 4}}), HasSubstr("found 1.5"));
  EXPECT_THAT(error_with("/background", {0, 0}), HasSubstr("/background: expected an array of 3 numbers"));
  EXPECT_THAT(error_with("/background", {0, 2, 0}), HasSubstr("/background/1"));
  EXPECT_THAT(error_with("/views", json::array()), HasSubstr("/views"));
}

TEST(SceneFile, VolumeErrors) {
  EXPECT_THAT(error_with("/volume/generator/size", 0), HasSubstr("/volume/generator/size"));
  EXPECT_THAT(error_with("/volume/generator/size", {4, 0, 4}), HasSubstr("/volume/generator/size/1"));
  EXPECT_THAT(error_with("/volume/file", "a.nrrd"), HasSubstr("exclude each other"));
  EXPECT_THAT(error_with("/volume", json::object()), HasSubstr("generator, file"));
  EXPECT_THAT(error_with("/volume/spacing", {1, 1, 1}), HasSubstr("spacing"));
  EXPECT_THAT(error_with("/volume", {{"file", "a.raw"}, {"sha256", "abc"}}), HasSubstr("64 lower-case"));
  EXPECT_THAT(error_with("/volume", {{"file", "a.raw"}, {"package", "p"}}), HasSubstr("package_path"));
  EXPECT_THAT(error_with("/volume", {{"file", "a.raw"}, {"spacing", {1, 0, 1}}}), HasSubstr("/volume/spacing/1"));
  EXPECT_THAT(error_with("/volume", {{"file", "a.raw"}, {"axes", {{1, 0, 0}, {1, 1, 0}, {0, 0, 1}}}}),
              HasSubstr("right angles"));
  EXPECT_THAT(error_with("/volume", {{"file", "a.raw"}, {"raw", {{"size", 4}, {"type", "u16"}}}}), HasSubstr("endian"));
  EXPECT_THAT(error_with("/volume", {{"file", "a.raw"}, {"raw", {{"size", 4}, {"type", "u32"}}}}),
              AllOf(HasSubstr("/volume/raw/type"), HasSubstr("u8, i8, u16, i16, f32")));
  EXPECT_THAT(error_with("/volume", {{"file", "a.nrrd"}, {"non_finite", "keep"}}), HasSubstr("refuse, zero"));
}

TEST(SceneFile, TransferFunction) {
  json document = small_scene();
  document["transfer"] = json::parse(R"({"per": 2, "window": [-1, 4], "points": [
    {"value": 0, "colour": [0, 0, 0], "opacity": 0.5},
    {"value": 1, "colour": [0, 0, 0], "opacity": 0.5, "per": 0.1},
    {"value": 1, "colour": [1, 1, 1], "extinction": 3}]})");
  const TransferFunction t = parse(document).transfer;
  EXPECT_NEAR(t.points[0].extinction, std::log(2.0) / 2, 1e-15);
  EXPECT_NEAR(t.points[1].extinction, std::log(2.0) / 0.1, 1e-14);
  EXPECT_EQ(t.points[2].extinction, 3);
  EXPECT_EQ(t.lo, -1);
  EXPECT_EQ(t.hi, 4);
}

TEST(SceneFile, TransferFunctionErrors) {
  const auto points = [](const char* text) { return error_with("/transfer/points", json::parse(text)); };
  EXPECT_THAT(points("[]"), HasSubstr("/transfer/points"));
  EXPECT_THAT(
      points(R"([{"value": 2, "colour": [0,0,0], "extinction": 0}, {"value": 1, "colour": [0,0,0], "extinction": 0}])"),
      AllOf(HasSubstr("/transfer/points/1/value"), HasSubstr("out of order"), HasSubstr("1 comes after 2")));
  EXPECT_THAT(points(R"([{"value": 2, "colour": [0,0,0], "opacity": 1, "per": 1}])"),
              AllOf(HasSubstr("/transfer/points/0/opacity"), HasSubstr("infinite extinction")));
  EXPECT_THAT(points(R"([{"value": 2, "colour": [0,0,0], "opacity": 0.5}])"), HasSubstr("\"per\""));
  EXPECT_THAT(points(R"([{"value": 2, "colour": [0,0,0], "extinction": 1, "per": 1}])"),
              HasSubstr("per world unit already"));
  EXPECT_THAT(points(R"([{"value": 2, "colour": [0,0,0], "extinction": 1, "opacity": 0.5}])"), HasSubstr("exclude"));
  EXPECT_THAT(points(R"([{"value": 2, "colour": [0,0,0]}])"), HasSubstr("extinction, opacity"));
  EXPECT_THAT(points(R"([{"value": 2, "colour": [0,0,0], "extinction": -1}])"), HasSubstr("found -1"));
  EXPECT_THAT(points(R"([{"value": 2, "colour": [0,0,1.5], "extinction": 1}])"), HasSubstr("/colour/2"));
  const std::string p = R"({"value": 2, "colour": [0,0,0], "extinction": 1})";
  EXPECT_THAT(points(("[" + p + "," + p + "," + p + "]").c_str()), HasSubstr("third point"));
  EXPECT_THAT(error_with("/transfer/window", {1, 1}), HasSubstr("lo < hi"));
  EXPECT_THAT(error_with("/transfer/window", {0.5, 1}), HasSubstr("cover all points"));
}

TEST(SceneFile, ViewErrors) {
  EXPECT_THAT(error_with("/views/0/half_height", 1), HasSubstr("exclude each other"));
  EXPECT_THAT(error_with("/views/0/fov_y", 180), HasSubstr("/views/0/fov_y"));
  EXPECT_THAT(error_with("/views/0/near", 0), HasSubstr("/views/0/near"));
  EXPECT_THAT(error_with("/views/0/eye", {0, 0, 0}), HasSubstr("same point"));
  EXPECT_THAT(error_with("/views/0/up", {0, 0, 1}), HasSubstr("parallel"));
  EXPECT_THAT(error_with("/views/0/up", {0, 0, 0}), HasSubstr("not zero"));
  EXPECT_THAT(error_with("/views/0", json::parse(R"({"orbit": {"count": 0, "distance": 2, "fov_y": 30}})")),
              HasSubstr("count"));
  EXPECT_THAT(
      error_with("/views/0", json::parse(R"({"orbit": {"count": 2, "distance": 2, "fov_y": 30, "elevation": 90}})")),
      HasSubstr("elevation"));
  EXPECT_THAT(
      error_with("/views/0", json::parse(R"({"orbit": {"count": 2, "distance": 2, "fov_y": 30, "units": "world"}})")),
      HasSubstr("target"));
}

// The box of the small scene: 2 x 1 x 1 about the origin, radius sqrt(6) / 2.
TEST(SceneFile, OrbitInUnitsOfTheRadius) {
  json document = small_scene();
  document["views"] = json::parse(R"([{"eye": [0, 0, 4], "target": [0, 0, 0], "half_height": 2},
    {"orbit": {"count": 4, "azimuth": 90, "elevation": 30, "distance": 3, "half_height": 1}}])");
  EXPECT_EQ(parse(document).views.size(), 5u);
  const Scene s = loaded(document);
  const double radius = std::sqrt(6.0) / 2;
  ASSERT_EQ(s.views.size(), 5u);
  EXPECT_EQ(s.views[0].half_height, 2);
  for (size_t i = 1; i < 5; ++i) {
    EXPECT_NEAR(glm::length(s.views[i].eye), 3 * radius, 1e-12);
    EXPECT_NEAR(s.views[i].eye.y, 3 * radius / 2, 1e-12);
    EXPECT_NEAR(s.views[i].half_height, radius, 1e-12);
    EXPECT_FALSE(s.views[i].perspective);
  }
  // Azimuth 90 is +x, and a quarter on is -z (counter-clockwise seen from above).
  EXPECT_GT(s.views[1].eye.x, 1);
  EXPECT_LT(s.views[2].eye.z, -1);
  EXPECT_EQ(s.views[2].name, "azimuth_180");
}

TEST(SceneFile, OrbitAboutOtherAxesKeepsItsSense) {
  for (const char* up : {"x", "y", "z", "-x", "-y", "-z"}) {
    json document = small_scene();
    document["views"] = {{{"orbit", {{"count", 4}, {"distance", 3}, {"elevation", 10}, {"fov_y", 30}, {"up", up}}}}};
    const Scene s = loaded(document);
    const glm::dvec3 turn = glm::cross(s.views[0].eye, s.views[1].eye);
    EXPECT_GT(glm::dot(turn, s.views[0].up), 0) << up;
    EXPECT_GT(glm::dot(s.views[0].eye, s.views[0].up), 0) << up;
  }
}

TEST(SceneFile, Effects) {
  json document = small_scene();
  document["effects"] = json::parse(R"({
    "lighting": {"ambient": 0.1, "specular": 0.5, "two_sided": true, "lights": [
      {"directional": [0, 3, 4]}, {"point": [0, 2, 0], "colour": [1, 0, 0], "units": "radius"}]},
    "clip_planes": [{"normal": [0, 0, 2], "point": [5, 5, 0.25]}, {"normal": [-1, 0, 0], "distance": 0.5, "units": "radius"}]})");
  const Scene s = loaded(document);
  const double radius = std::sqrt(6.0) / 2;
  EXPECT_EQ(effect_names(s.effects), (std::vector<std::string>{"lighting", "clip_planes"}));
  EXPECT_EQ(s.effects.lighting->lights[0].vector, glm::dvec3(0, 0.6, 0.8));
  EXPECT_EQ(s.effects.lighting->lights[1].kind, Light::Kind::Point);
  EXPECT_NEAR(s.effects.lighting->lights[1].vector.y, 2 * radius, 1e-12);
  EXPECT_TRUE(s.effects.lighting->two_sided);
  EXPECT_EQ(s.effects.lighting->diffuse, 0.8);
  EXPECT_EQ(s.effects.clip_planes[0].normal, glm::dvec3(0, 0, 1));
  EXPECT_NEAR(s.effects.clip_planes[0].distance, 0.25, 1e-15);
  EXPECT_NEAR(s.effects.clip_planes[1].distance, 0.5 * radius, 1e-12);
}

TEST(SceneFile, EffectErrors) {
  EXPECT_THAT(error_with("/effects", {{"lighting", {{"lights", json::array()}}}}),
              HasSubstr("/effects/lighting/lights"));
  EXPECT_THAT(error_with("/effects", json::parse(R"({"lighting": {"lights": [{"directional": [0,0,0]}]}})")),
              HasSubstr("/effects/lighting/lights/0/directional"));
  EXPECT_THAT(error_with("/effects", json::parse(R"({"lighting": {"lights": [{"colour": [1,1,1]}]}})")),
              HasSubstr("directional, point"));
  EXPECT_THAT(error_with("/effects", json::parse(R"({"clip_planes": [{"normal": [1,0,0]}]})")),
              HasSubstr("distance, point"));
}

TEST(SceneFile, HashDependsOnThePictureOnly) {
  const std::string before = parse(small_scene()).hash;
  EXPECT_EQ(before.size(), 64u);
  EXPECT_EQ(loaded(small_scene()).hash, before);
  json renamed = small_scene();
  renamed["title"] = "other";
  renamed["description"] = "words";
  EXPECT_EQ(parse(renamed).hash, before);
  json brighter = small_scene();
  brighter["transfer"]["points"][0]["extinction"] = 1.5;
  EXPECT_NE(parse(brighter).hash, before);
}

TEST(SceneFile, OneSample) {
  json document = small_scene();
  document["volume"]["generator"]["size"] = 1;
  EXPECT_EQ(loaded(document).volume->size, glm::ivec3(1));
}

}  // namespace
}  // namespace volumark
