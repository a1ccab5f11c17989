// What is particular to object-aligned slices of 2D textures (rezksalama2000): several slices on a polygon,
// intermediate slices, the choice of the stack, pages. That it draws the right picture at all: tests/images/methods.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "methods/reference/reference.h"
#include "tests/support/backend.h"
#include "tests/support/drawing.h"

namespace volumark {
namespace {

class Slices2d : public testing::Test {
 protected:
  Device device = make_device(backend_id(), device_options());

  // What the host alone decides (stack, order, polygons) is the same on every backend: seen once.
  static bool host_is_seen_elsewhere() { return backend_id() != "cpu"; }

  Image picture(const Scene& scene, const View& view, Settings settings, int size = 64) {
    return draw(device, scene, "slices2d", settings, view, size, size).image;
  }
  Image picture(const Scene& scene, Settings settings) { return picture(scene, scene.views.at(0), settings); }
};

// A field with detail along all axes, under a transfer function that is smooth. `view` is one view, as JSON.
Scene detailed_scene(const std::string& view, const char* volume_size = "32") {
  return scene_from_text(fmt::format(R"({{
    "volumark_scene": 1, "title": "detailed",
    "volume": {{"generator": {{"kind": "marschner_lobb", "size": {}, "type": "f32", "frequency": 3, "alpha": 0.25}}}},
    "transfer": {{"points": [{{"value": 0, "colour": [0.1, 0.3, 1], "extinction": 0}},
                             {{"value": 0.5, "colour": [1, 0.8, 0.1], "extinction": 1}},
                             {{"value": 1, "colour": [1, 0.2, 0.1], "extinction": 6}}], "window": [0, 1]}},
    "views": [{}]}})",
                                     volume_size, view));
}
std::string from(const char* eye, const char* more = R"("fov_y": 45)") {
  return fmt::format(R"({{"eye": {}, "target": [0, 0, 0], "up": [0, 1, 0.01], "units": "world", {}}})", eye, more);
}
const char* const kOrthographic = R"("half_height": 1.7)";

// ---- Several slices on a polygon ----

// Equations 3 to 5: the slices of a polygon combined in the program and blended once are the same as each blended.
TEST_F(Slices2d, TexturesOfAPolygonCombineAsIfBlendedOneByOne) {
  for (const Scene& scene : {detailed_scene(from("[1.1, 0.9, 3]")), detailed_scene(from("[-3, 0.9, 1]", kOrthographic)),
                             detailed_scene(from("[0.1, 0.2, 0.4]", R"("fov_y": 70)"))}) {
    const Image one = picture(scene, {{"slices", "250"}});
    for (const char* textures : {"2", "4"}) {
      const Image several = picture(scene, {{"slices", "250"}, {"textures_per_polygon", textures}});
      // A rounding of 2^-24 for each of up to 79 slices, in the colours and in the opacities that weigh them.
      EXPECT_LE(difference(several, one).max, 2 * 79 * 0x1p-24) << textures << " textures";
    }
  }
}

TEST_F(Slices2d, TexturesThatAreNotCorrectedShow) {
  const Scene scene = detailed_scene(from("[1.1, 0.9, 2.2]"));
  const Image reference = render_reference(scene, scene.views[0], 64, 64).image;
  const auto error = [&](const char* textures, const char* coordinates) {
    return difference(picture(scene, {{"textures_per_polygon", textures}, {"texture_coordinates", coordinates}}),
                      reference)
        .rmse;
  };
  const double one = error("1", "corrected"), two = error("2", "uncorrected"), four = error("4", "uncorrected");
  EXPECT_GT(two, 1.5 * one);
  EXPECT_GT(four, 1.5 * two);
  EXPECT_NEAR(error("1", "uncorrected"), one, 1e-12) << "with one texture there is nothing to correct";
}

TEST_F(Slices2d, NothingToCorrectWhereRaysRunAcrossTheSlices) {
  const Scene scene = detailed_scene(from("[0, 0, 3]", kOrthographic));
  const auto with = [&](const char* coordinates) {
    return picture(scene, {{"textures_per_polygon", "4"}, {"texture_coordinates", coordinates}});
  };
  // A rounding for each of 32 slices.
  EXPECT_LE(difference(with("corrected"), with("uncorrected")).max, 32 * 0x1p-23);
}

// ---- Intermediate slices ----

TEST_F(Slices2d, ManySlicesTendToThePictureOf3dTextures) {
  for (const char* eye : {"[1.1, 0.9, 3]", "[-2, 2.5, 0.3]"}) {
    const Scene scene = detailed_scene(from(eye));
    const auto apart = [&](const char* slices) {
      const Image limit = draw(device, scene, "texture3d_slices", {{"step", "0.03125"}}, scene.views[0], 64, 64).image;
      return difference(picture(scene, {{"slices", slices}}), limit);
    };
    const Difference coarse = apart("400"), fine = apart("1600");
    EXPECT_LE(fine.rmse, coarse.rmse / 8) << "order 2: a sixteenth";
    EXPECT_LE(fine.rmse, 1e-4) << eye;
    EXPECT_LE(fine.max, 2e-3) << eye;
  }
}

TEST_F(Slices2d, WithoutInterpolationThereIsAFloor) {
  const Scene scene = detailed_scene(from("[1.1, 0.9, 2.2]"));
  const Image reference = render_reference(scene, scene.views[0], 64, 64).image;
  const auto error = [&](const char* slices, const char* interpolation) {
    return difference(picture(scene, {{"slices", slices}, {"interpolation", interpolation}}), reference).rmse;
  };
  EXPECT_LE(error("100", "false"), 1.5 * error("100", "true")) << "at stored slices it matters at the rim only";
  const double nearest = error("800", "false");
  EXPECT_GT(nearest, 10 * error("800", "true"));
  EXPECT_GT(error("1600", "false"), 0.8 * nearest);
}

TEST_F(Slices2d, PreClassifiedSlicesTendToThePictureOfAPreClassified3dTexture) {
  const Scene scene = detailed_scene(from("[1.1, 0.9, 3]"));
  const Image limit =
      draw(device, scene, "texture3d_slices", {{"step", "0.0625"}, {"classification", "pre"}}, scene.views[0], 64, 64)
          .image;
  EXPECT_LE(difference(picture(scene, {{"slices", "1600"}, {"classification", "pre"}}), limit).rmse, 2e-4);
  EXPECT_GT(difference(picture(scene, {{"slices", "1600"}}), limit).rmse, 2e-3) << "not the post-classified one";
}

TEST_F(Slices2d, FormatsOfTheSlicesDifferByTheirRounding) {
  const Scene scene = detailed_scene(from("[1.1, 0.9, 3]"));
  const Image exact = picture(scene, {{"slices", "200"}});
  const auto apart = [&](const char* format) {
    return difference(picture(scene, {{"slices", "200"}, {"volume_format", format}}), exact).rmse;
  };
  EXPECT_LE(apart("r32f"), 1e-6);
  EXPECT_LE(apart("r16"), 2e-5);
  EXPECT_LE(apart("r16f"), 5e-4);
  EXPECT_LE(apart("r8"), 5e-3);
  EXPECT_GT(apart("r8"), 1e-5);
}

// Opacity of the papers' linear correction in closed form: every slab but the two half ones at the ends lets 1 - tau h
// through.
TEST_F(Slices2d, LinearOpacityHasItsClosedForm) {
  const Scene scene = shipped_scene("slab");
  const View& view = scene.views.at(0);
  const double tau_length = 1;
  for (const char* slices : {"100", "400"}) {
    const Drawing drawing =
        draw(device, scene, "slices2d", {{"slices", slices}, {"opacity_correction", "linear"}}, view, 32, 32);
    const double intervals = static_cast<double>(drawing.counters.at("slices") - 1);
    const double part = tau_length / intervals;
    const double expected = 1 - std::pow(1 - part, intervals - 1) * std::pow(1 - part / 2, 2);
    EXPECT_NEAR(drawing.image.pixel(16, 16)[3], expected, 1e-5) << slices;
  }
}

// ---- The stack ----

int stack_of(Device& device, const Scene& scene) {
  return static_cast<int>(draw(device, scene, "slices2d", {}, scene.views.at(0), 16, 16).counters.at("stack_axis"));
}

TEST_F(Slices2d, EveryStackDrawsTheSameVolume) {
  const char* const eyes[3] = {"[3, 0.5, 0.7]", "[0.5, 3, 0.7]", "[0.5, 0.7, 3]"};
  for (int axis = 0; axis < 3; ++axis) {
    const Scene scene = detailed_scene(from(eyes[axis]), "[20, 30, 40]");
    EXPECT_EQ(stack_of(device, scene), axis);
    const Image reference = render_reference(scene, scene.views[0], 64, 64).image;
    const Difference d = difference(picture(scene, {{"slices", "800"}}), reference);
    EXPECT_LE(d.rmse, 2e-4) << "stack " << axis;
    EXPECT_LE(d.max, 5e-3) << "stack " << axis;
  }
}

// Where the stack switches, at 45 degrees exactly, the picture jumps; the jump is an error of the scheme and falls with
// it, by order 2.
TEST_F(Slices2d, TheJumpAtTheSwitchFallsWithTheError) {
  if (host_is_seen_elsewhere()) return;
  const Scene tie = detailed_scene(from("[3, 0.4, 3]")), beside = detailed_scene(from("[3.000001, 0.4, 3]"));
  EXPECT_EQ(stack_of(device, tie), 2);
  EXPECT_EQ(stack_of(device, beside), 0);
  const auto jump = [&](const char* slices) {
    return difference(picture(tie, {{"slices", slices}}), picture(beside, {{"slices", slices}})).rmse;
  };
  const Image reference = render_reference(tie, tie.views[0], 64, 64).image;
  const double coarse = jump("200");
  EXPECT_LE(coarse, 2 * difference(picture(tie, {{"slices", "200"}}), reference).rmse);
  EXPECT_LE(jump("800"), coarse / 8);
}

Scene with_spacing(Scene scene, const glm::dvec3& factor) {
  auto volume = std::make_shared<Volume>(*scene.volume);
  volume->spacing *= factor;
  volume->origin *= factor;
  scene.volume = volume;
  return scene;
}

TEST_F(Slices2d, ThickSlicesOfAnAnisotropicVolume) {
  if (host_is_seen_elsewhere()) return;
  for (const char* eye : {"[1.5, 0.5, 7]", "[5, 0.5, 6]", "[4, 4, 1]"}) {
    const Scene scene = with_spacing(detailed_scene(from(eye), "[40, 40, 8]"), {1, 1, 5});
    const Image reference = render_reference(scene, scene.views[0], 64, 64).image;
    const Difference d = difference(picture(scene, {{"slices", "800"}}), reference);
    EXPECT_LE(d.rmse, 1e-3) << eye;
    EXPECT_LE(d.max, 2e-2) << eye;
  }
}

// ---- The eye in the stack ----

TEST_F(Slices2d, TheEyeOnASliceIsNoSpecialPlace) {
  if (host_is_seen_elsewhere()) return;
  // 33 samples over 2 units: slices are 1 / 16 apart, and z = 0.25 is on one, 0.28125 between two slabs.
  for (const char* z : {"0.25", "0.28125"}) {
    const auto at = [&](double moved) {
      return detailed_scene(fmt::format(R"({{"eye": [0.1, 0.2, {}], "target": [0.1, 0.2, -4], "up": [0, 1, 0],
                                            "units": "world", "fov_y": 60}})",
                                        std::stod(z) + moved),
                            "33");
    };
    const Scene on = at(0);
    EXPECT_EQ(stack_of(device, on), 2);
    const Image image = picture(on, {{"slices", "800"}});
    for (const float value : image.rgba) ASSERT_TRUE(std::isfinite(value));
    const Image reference = render_reference(on, on.views[0], 64, 64).image;
    EXPECT_LE(difference(image, reference).rmse, 1e-3) << z;
    EXPECT_LE(difference(picture(at(1e-6), {{"slices", "800"}}), image).max, 1e-4) << z << ", moved";
  }
}

// Looking along the slices of a flat field of view, rays run in the planes of the slices themselves.
TEST_F(Slices2d, RaysInThePlaneOfTheSlicesAreFinite) {
  const Scene scene = detailed_scene(
      R"({"eye": [0.1, 0.2, 0.25], "target": [2, 0.2, 2.1501], "up": [0, 1, 0], "units": "world", "fov_y": 100})",
      "33");
  const Image image = picture(scene, {});
  double sum = 0;
  for (const float value : image.rgba) {
    ASSERT_TRUE(std::isfinite(value) && value >= 0 && value <= 1.00001F);
    sum += static_cast<double>(value);
  }
  EXPECT_GT(sum, 100) << "the volume is all around the eye";
}

// ---- Pages ----

TEST_F(Slices2d, SlicesOfSeveralPagesMeetWithoutASeam) {
  // 256 slices of 258 x 258 texels: two pages a stack. A ramp across is exact, and shows any slice out of its place.
  const Scene scene = scene_from_text(R"({
    "volumark_scene": 1, "title": "pages",
    "volume": {"generator": {"kind": "ramp", "size": 256, "type": "u8", "axis": "z", "from": 0, "to": 255}},
    "transfer": {"points": [{"value": 0, "colour": [0, 0.2, 1], "extinction": 0.2},
                            {"value": 255, "colour": [1, 0.4, 0], "extinction": 2}], "window": [0, 255]},
    "views": [{"eye": [0.4, 0.7, 4], "target": [0, 0, 0], "up": [0, 1, 0], "units": "world", "fov_y": 40},
              {"eye": [4, 0.7, 0.4], "target": [0, 0, 0], "up": [0, 1, 0], "units": "world", "fov_y": 40}]})");
  for (const View& view : scene.views) {
    const Drawing drawing = draw(device, scene, "slices2d", {{"textures_per_polygon", "4"}}, view, 48, 48);
    EXPECT_EQ(drawing.counters.at("draws"), 2);
    const Image reference = render_reference(scene, view, 48, 48).image;
    EXPECT_LE(difference(drawing.image, reference).max, 1e-3);
  }
}

}  // namespace
}  // namespace volumark
