// Scenes that show a shell: their files.
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "helpers.h"
#include "scenes/scene_io.h"
#include "scenes/shell.h"

namespace volumark {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

json small_scene() {
  return json::parse(R"({
    "volumark_scene": 1, "title": "t",
    "shell": {
      "mesh": {"generator": {"kind": "strip", "cells": [2, 2], "extent": [2, 2]}},
      "thickness": 0.5,
      "texture": {"generator": {"kind": "egg_torus", "size": 8}, "extinction": 10},
      "repeat": [2, 2]
    },
    "views": [{"eye": [0, 2, 4], "target": [0, 0, 0], "fov_y": 60, "units": "radius"}]
  })");
}

Scene parse(const json& document, const std::string& path = "dir/t.json") { return parse_scene(document.dump(), path); }
Scene loaded(const json& document, const std::string& path = "dir/t.json") {
  Scene scene = parse(document, path);
  load_data(scene, {});
  return scene;
}
json with(const char* pointer, const json& value) {
  json document = small_scene();
  document[json::json_pointer(pointer)] = value;
  return document;
}
std::string error_with(const char* pointer, const json& value) {
  return test::message_of<SceneError>([&] { parse(with(pointer, value)); });
}
std::string load_error(const json& document) {
  return test::message_of<SceneError>([&] { loaded(document); });
}

TEST(ShellScene, LoadsAndPlacesItsViews) {
  Scene scene = parse(small_scene());
  EXPECT_EQ(scene.display, Display::Shell);
  EXPECT_EQ(scene.source.origin, "procedural");
  EXPECT_EQ(scene.hash.size(), 64u);
  const std::string hash = scene.hash;
  load_data(scene, {});
  EXPECT_EQ(scene.hash, hash);
  EXPECT_EQ(scene.volume, nullptr);
  ASSERT_NE(scene.shell, nullptr);
  EXPECT_EQ(scene.shell->prisms(), 8u);
  EXPECT_EQ(scene.shell->colours->size, glm::ivec3(8));
  // The bounds are 2 x 0.5 x 2, their middle at a height of 0.25.
  EXPECT_NEAR(scene.views[0].eye.y, 0.25 + 2 * glm::length(glm::dvec3(1, 0.25, 1)), 1e-12);
  const auto* shell = scene.shell.get();
  load_data(scene, {});
  EXPECT_EQ(scene.shell.get(), shell);
}

TEST(ShellScene, TheHashKnowsEveryPartOfTheShell) {
  const std::string hash = parse(small_scene()).hash;
  EXPECT_NE(parse(with("/shell/thickness", 0.4)).hash, hash);
  EXPECT_NE(parse(with("/shell/repeat", {2, 3})).hash, hash);
  EXPECT_NE(parse(with("/shell/mesh/generator/bend", 10)).hash, hash);
  EXPECT_NE(parse(with("/shell/texture/extinction", 11)).hash, hash);
  EXPECT_EQ(parse(with("/title", "other")).hash, hash);
}

TEST(ShellScene, ExtinctionScalesTheTexture) {
  const float once = loaded(small_scene()).shell->colours->greatest_extinction();
  EXPECT_FLOAT_EQ(loaded(with("/shell/texture/extinction", 20)).shell->colours->greatest_extinction(), 2 * once);
}

TEST(ShellScene, ThicknessByPositionOrByNoise) {
  const std::vector<double> each{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
  json document = with("/shell/vertex_thickness", each);
  document["shell"].erase("thickness");
  EXPECT_EQ(loaded(document).shell->thickness, each);
  const Scene varying =
      loaded(with("/shell/thickness", {{"least", 0.2}, {"greatest", 0.4}, {"frequency", 3}, {"seed", 2}}));
  const std::vector<double>& found = varying.shell->thickness;
  EXPECT_GE(*std::min_element(found.begin(), found.end()), 0.2);
  EXPECT_LE(*std::max_element(found.begin(), found.end()), 0.4);
  EXPECT_LT(found[0], found[0] == found[3] ? 0 : 1);  // it does vary
}

TEST(ShellScene, RefusesWhatDoesNotBelongTogether) {
  EXPECT_THAT(error_with("/volume", json::object()), HasSubstr("a scene with a \"shell\" has no \"volume\""));
  EXPECT_THAT(error_with("/transfer", json::object()), HasSubstr("has no \"transfer\""));
  EXPECT_THAT(error_with("/isosurface", {{"value", 1}}), HasSubstr("has no \"isosurface\""));
  EXPECT_THAT(error_with("/shell/vertex_thickness", {1}), HasSubstr("vertex_thickness"));
  EXPECT_THAT(error_with("/shell/mesh/generator/kind", "cube"), AllOf(HasSubstr("/shell/mesh/generator/kind")));
  EXPECT_THAT(error_with("/shell/mesh/generator/segments", {3, 3}), HasSubstr("segments"));
  EXPECT_THAT(error_with("/shell/mesh/generator/cells", {0, 3}), HasSubstr("/shell/mesh/generator/cells/0"));
  EXPECT_THAT(error_with("/shell/texture/generator/kind", "egg_tours"),
              AllOf(HasSubstr("/shell/texture/generator/kind"), HasSubstr("did you mean \"egg_torus\"")));
  EXPECT_THAT(error_with("/shell/texture", {{"file", "t.raw"}}), HasSubstr("raw"));
  json document = small_scene();
  document["shell"].erase("texture");
  EXPECT_THAT(test::message_of<SceneError>([&] { parse(document); }), HasSubstr("missing key \"texture\""));
}

TEST(ShellScene, RefusesThicknesses) {
  EXPECT_THAT(error_with("/shell/thickness", 0), HasSubstr("/shell/thickness"));
  EXPECT_THAT(error_with("/shell/thickness", -1), HasSubstr("/shell/thickness"));
  EXPECT_THAT(error_with("/shell/thickness", 1e13), HasSubstr("/shell/thickness"));
  EXPECT_THAT(error_with("/shell/thickness", {{"least", 2}, {"greatest", 1}}), HasSubstr("\"least\" is above"));
  json document = with("/shell/vertex_thickness", {0, 0, 0, 0, 0, 0, 0, 0, 0});
  document["shell"].erase("thickness");
  EXPECT_THAT(load_error(document), HasSubstr("0 everywhere"));
  document["shell"]["vertex_thickness"] = {1, 2};
  EXPECT_THAT(load_error(document), HasSubstr("2 thicknesses for 9 positions"));
}

TEST(ShellScene, TexturesFromFiles) {
  const test::TempDir dir;
  // Two texels along x: half-transparent red, opaque green.
  dir.write("t.raw", test::encode<uint8_t>({255, 0, 0, 51, 0, 255, 0, 255}));
  dir.write("t.f32", test::encode<float>({0.25f, 0, 0, 0.5f, 0, 1, 0, 1}));
  const std::string path = (dir / "s.json").string();
  json document =
      with("/shell/texture", {{"file", "t.raw"}, {"raw", {{"size", {2, 1, 1}}, {"type", "u8"}}}, {"extinction", 10}});
  Scene scene = loaded(document, path);
  EXPECT_EQ(scene.source.origin, "file");
  EXPECT_EQ(scene.source.path, (dir / "t.raw").string());
  EXPECT_EQ(scene.hash.size(), 64u);
  ASSERT_EQ(scene.shell->colours->texels.size(), 2u);
  EXPECT_NEAR(glm::length(glm::dvec4(scene.shell->colours->texels[0]) - glm::dvec4(2, 0, 0, 2)), 0, 1e-6);
  EXPECT_NEAR(glm::length(glm::dvec4(scene.shell->colours->texels[1]) - glm::dvec4(0, 10, 0, 10)), 0, 1e-6);
  document["shell"]["texture"]["raw"] = {{"size", {2, 1, 1}}, {"type", "f32"}, {"endian", "little"}};
  document["shell"]["texture"]["file"] = "t.f32";
  scene = loaded(document, path);
  EXPECT_NEAR(glm::length(glm::dvec4(scene.shell->colours->texels[0]) - glm::dvec4(2.5, 0, 0, 5)), 0, 1e-6);
  document["shell"]["texture"]["raw"]["size"] = {3, 1, 1};
  EXPECT_THAT(test::message_of<DataError>([&] { loaded(document, path); }),
              AllOf(HasSubstr("expected 48 bytes"), HasSubstr("found 32")));
  dir.write("t.f32", test::encode<float>({0.25f, 0, 0, -0.5f, 0, 1, 0, 1}));
  document["shell"]["texture"]["raw"]["size"] = {2, 1, 1};
  EXPECT_THAT(test::message_of<DataError>([&] { loaded(document, path); }), HasSubstr("texel 0 holds -5"));
}

}  // namespace
}  // namespace volumark
