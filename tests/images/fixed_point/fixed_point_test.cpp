// The effect fixed_point: the same bits on every backend, whatever rasterizes, filters and blends there; the same as a
// scalar walk along single rays; clamped where combiners clamp; as far from the picture in float as 8 bits must be.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "backends/cpu/highway_targets.h"
// After the choice of instruction sets.
#include <hwy/targets.h>

#include "harness/frame.h"
#include "methods/reference/reference.h"
#include "tests/images/fixed_point/scalar_walk.h"
#include "tests/support/backend.h"
#include "tests/support/drawing.h"

namespace volumark {
namespace {

using testing::HasSubstr;

constexpr int kSize = 64;
constexpr const char* kMethods[] = {"texture3d_slices", "raycast"};

Scene with_fixed_point(Scene scene) {
  scene.effects.fixed_point = true;
  return scene;
}

// Three views of the scene's orbit from about the same place, `perspective` or not.
std::vector<View> views_of(const Scene& scene, bool perspective) {
  std::vector<View> views;
  for (const size_t i : {size_t{0}, size_t{3}, size_t{6}}) {
    View view = scene.views[i % scene.views.size()];
    const double distance = glm::length(view.target - view.eye);
    if (perspective && !view.perspective) {
      view.fov_y = 2 * std::atan(view.half_height / distance);
      view.near = 0.01 * distance;
    } else if (!perspective && view.perspective) {
      view.half_height = distance * std::tan(view.fov_y / 2);
    }
    view.perspective = perspective;
    views.push_back(view);
  }
  return views;
}

std::string smooth_text(const std::string& size, const std::string& effects) {
  return fmt::format(R"({{
    "volumark_scene": 1,
    "title": "smooth",
    "volume": {{"generator": {{"kind": "marschner_lobb", "size": {}, "type": "f32", "frequency": 2, "alpha": 0.25}}}},
    "transfer": {{"points": [{{"value": 0.4, "colour": [0.2, 0.4, 1], "extinction": 0}},
                             {{"value": 0.6, "colour": [1, 0.6, 0.2], "extinction": 20}}], "window": [0, 1]}},
    "views": [{{"orbit": {{"count": 8, "azimuth": 25, "elevation": 35, "distance": 3.4, "fov_y": 40, "units": "world",
                           "target": [0, 0, 0]}}}}],
    "effects": {{"fixed_point": true{}}}
  }})",
                     size, effects);
}
const char* const kOneSided = R"(, "lighting": {"ambient": 0.2, "diffuse": 0.7, "specular": 0.6, "shininess": 8,
  "two_sided": false, "lights": [{"directional": [0.5, 1, 0.3], "colour": [1, 0.9, 0.8]},
                                 {"directional": [-1, 0.2, 0.6], "colour": [0.3, 0.5, 1]}]})";
const char* const kClipped = R"(, "clip_planes": [{"normal": [1, 0.3, 0.2], "distance": -0.3}])";
Scene smooth(const std::string& effects = "", const std::string& size = "40") {
  return scene_from_text(smooth_text(size, effects));
}

// All pictures of a method prepared once.
std::vector<Image> pictures(Device& device, const Scene& scene, const char* method_name, Settings settings,
                            const std::vector<View>& views, int size = kSize) {
  const Method& method = find_method(method_name);
  Values values = default_values(method.info().parameters);
  for (const auto& [name, value] : settings) set_value(method.info().parameters, values, name, std::string(value));
  if (const auto why = unsupported_reason(method, scene, values, device.info())) throw std::runtime_error(*why);
  FrameSource source(scene, method, values, device, size, size);
  std::vector<Image> out;
  for (const View& view : views) {
    source.frame(view);
    out.push_back(source.read_back());
  }
  return out;
}

double light_in(const Image& image) {
  double sum = 0;
  for (const float value : image.rgba) sum += static_cast<double>(value);
  return sum;
}

// ---- The same bits --------------------------------------------------------------------------------------------------

std::string other_backend() { return backend_id() == "cpu" ? "gl" : "cpu"; }

void expect_same_bits(const Scene& scene, const std::vector<View>& views, Settings settings = {}) {
  Device device = make_device(backend_id(), device_options()), other = make_device(other_backend());
  if (!device.info().software || !other.info().software) GTEST_SKIP() << "8-bit blending is the driver's own on GPUs";
  for (const char* method : kMethods) {
    const std::vector<Image> ours = pictures(device, scene, method, settings, views);
    const std::vector<Image> theirs = pictures(other, scene, method, settings, views);
    for (size_t i = 0; i < views.size(); ++i) {
      const Difference d = difference(ours[i], theirs[i]);
      EXPECT_EQ(d.max, 0) << method << (views[i].perspective ? ", perspective " : ", orthographic ") << i << " at "
                          << d.x << ", " << d.y << ": " << std::lround(255 * d.max) << " levels";
      EXPECT_GT(light_in(ours[i]), 50) << method << ": an empty picture agrees with anything";
    }
  }
}
void expect_same_bits(const Scene& scene, Settings settings = {}) {
  std::vector<View> views = views_of(scene, false);
  for (const View& view : views_of(scene, true)) views.push_back(view);
  expect_same_bits(scene, views, settings);
}

TEST(FixedPointBits, OfASphere) { expect_same_bits(with_fixed_point(shipped_scene("sphere"))); }
TEST(FixedPointBits, OfACloud) { expect_same_bits(with_fixed_point(shipped_scene("cloud"))); }
TEST(FixedPointBits, OfAnEngineUnderLights) { expect_same_bits(with_fixed_point(shipped_scene("engine"))); }
TEST(FixedPointBits, OneSidedAndClipped) {
  expect_same_bits(smooth(std::string(kOneSided) + kClipped), {{"step", "0.37"}});
}
TEST(FixedPointBits, OfALayerOfOneSample) { expect_same_bits(smooth(kOneSided, "[40, 1, 24]")); }
TEST(FixedPointBits, FromInside) {
  const Scene scene = smooth(kClipped);
  std::vector<View> views = views_of(scene, true);
  for (View& view : views) {
    view.eye = 0.1 * view.eye;
    view.near = 0.05;
  }
  expect_same_bits(scene, views);
}

TEST(FixedPointBits, PreClassified) {
  Device device = make_device(backend_id(), device_options()), other = make_device(other_backend());
  if (!device.info().software || !other.info().software) GTEST_SKIP() << "8-bit blending is the driver's own on GPUs";
  const Scene scene = smooth();
  const Settings settings = {{"classification", "pre"}, {"opacity_correction", "linear"}};
  const auto views = views_of(scene, true);
  const Image ours = pictures(device, scene, kMethods[0], settings, views)[0];
  EXPECT_EQ(difference(ours, pictures(other, scene, kMethods[0], settings, views)[0]).max, 0);
  EXPECT_GT(light_in(ours), 50);
  EXPECT_GT(difference(ours, pictures(device, scene, kMethods[0], {}, views)[0]).rmse, 1. / 255);
}

// Both methods take the same samples of an orthographic view, one blends them in the frame buffer, the other in its
// program.
TEST(FixedPointBits, OfRaysAndOfSlicesFrontToBack) {
  Device device = make_device(backend_id(), device_options());
  if (!device.info().software) GTEST_SKIP() << "8-bit blending is the driver's own on GPUs";
  const Scene scene = smooth(std::string(kOneSided) + kClipped);
  const auto views = views_of(scene, false);
  const auto slices = pictures(device, scene, "texture3d_slices", {{"step", "0.7"}, {"order", "front_to_back"}}, views);
  const auto rays = pictures(device, scene, "raycast", {{"step", "0.7"}}, views);
  for (size_t i = 0; i < views.size(); ++i) EXPECT_EQ(difference(slices[i], rays[i]).max, 0) << "view " << i;
}

// Bricks that are jumped over hold nothing but samples that add nothing.
TEST(FixedPointBits, OfRaysThatSkipOrDoNot) {
  Device device = make_device(backend_id(), device_options());
  const Scene scene = smooth(std::string(kOneSided) + kClipped), cloud = with_fixed_point(shipped_scene("cloud"));
  for (const Scene* one : {&scene, &cloud}) {
    for (const bool perspective : {false, true}) {
      const auto views = views_of(*one, perspective);
      const auto all = pictures(device, *one, "raycast", {{"skip_empty", "none"}}, views);
      for (const char* size : {"2", "7", "16"}) {
        const auto skipping = pictures(device, *one, "raycast", {{"brick_size", size}}, views);
        for (size_t i = 0; i < views.size(); ++i)
          EXPECT_EQ(difference(all[i], skipping[i]).max, 0) << size << ", " << i;
      }
    }
  }
}

TEST(FixedPointBits, OfAnyNumberOfThreads) {
  if (backend_id() != "cpu") return;  // threads are an option of the cpu backend
  DeviceOptions one = device_options(), three = device_options();
  one.threads = 1;
  three.threads = 3;
  Device a = make_device("cpu", one), b = make_device("cpu", three);
  const Scene scene = smooth(kOneSided);
  for (const char* method : kMethods) {
    const auto views = views_of(scene, true);
    EXPECT_EQ(difference(pictures(a, scene, method, {}, views)[0], pictures(b, scene, method, {}, views)[0]).max, 0);
  }
}

// Twins are compiled for several instruction sets, some of which have a fused multiply-add: no bit may depend on it.
TEST(FixedPointBits, OfEveryInstructionSet) {
  if (backend_id() != "cpu") return;
  const Scene scene = smooth(std::string(kOneSided) + kClipped);
  const auto views = views_of(scene, true);
  std::vector<Image> first;
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    Device device = make_device("cpu", device_options());
    EXPECT_EQ(device.info().renderer, std::string("CPU, ") + hwy::TargetName(target));
    for (size_t m = 0; m < std::size(kMethods); ++m) {
      const Image image = pictures(device, scene, kMethods[m], {}, views)[1];
      if (first.size() == m) first.push_back(image);
      EXPECT_EQ(difference(image, first[m]).max, 0) << kMethods[m] << ", " << hwy::TargetName(target);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

// ---- The definition -------------------------------------------------------------------------------------------------

// A few pixels of every picture, composed one by one in plain integers.
void expect_as_walked(const Scene& scene, const FixedSettings& settings, Settings values) {
  Device device = make_device(backend_id(), device_options());
  if (!device.info().software) GTEST_SKIP() << "8-bit blending is the driver's own on GPUs";
  for (const bool perspective : {false, true}) {
    const View view = views_of(scene, perspective)[1];
    const ScalarWalk walk(scene, settings, view, kSize);
    const Image slices = pictures(device, scene, "texture3d_slices", values, {view})[0];
    const Image rays = pictures(device, scene, "raycast", values, {view})[0];
    int seen = 0;
    for (int y = 4; y < kSize; y += 9) {
      for (int x = 4; x < kSize; x += 9) {
        const auto expect = [&](const Image& image, const Levels& want, const char* method) {
          for (size_t c = 0; c < 4; ++c) {
            EXPECT_EQ(std::lround(255 * image.pixel(x, y)[c]), want[c])
                << method << " at " << x << ", " << y << " channel " << c << (perspective ? ", perspective" : "");
          }
          seen += want[3] > 0 ? 1 : 0;
        };
        expect(slices, walk.back_to_front(x, y), "texture3d_slices");
        expect(rays, walk.along_ray(x, y), "raycast");
      }
    }
    EXPECT_GT(seen, 20);
  }
}

TEST(FixedPointWalk, UnlitPixels) {
  const Scene scene = smooth(kClipped);
  expect_as_walked(scene, {Classification::Post, false, 0.8 * scene.volume->spacing.x}, {{"step", "0.8"}});
}
TEST(FixedPointWalk, LitPixels) {
  const Scene scene = smooth(kOneSided);
  expect_as_walked(scene, {Classification::Post, false, 0.8 * scene.volume->spacing.x}, {{"step", "0.8"}});
}

// Samples lie where the pixel's ray does: the uniforms against the geometry of scenes/scene.h.
TEST(FixedPointWalk, PositionsAreOnTheRay) {
  const Scene scene = smooth();
  const Volume& volume = *scene.volume;
  for (const bool perspective : {false, true}) {
    const View view = views_of(scene, perspective)[2];
    const ScalarWalk walk(scene, {Classification::Post, false, 0.1}, view, kSize);
    const glm::dvec3 forward = frame_of(view).forward;
    for (const auto& [x, y] : {std::pair(3, 60), {32, 32}, {50, 11}}) {
      const Ray ray = pixel_ray(view, kSize, kSize, x, y);
      for (const double depth : {2.5, 3.4}) {  // from the eye
        const glm::dvec3 world = ray.origin + ray.direction * (depth / glm::dot(ray.direction, forward));
        const glm::dvec3 index = glm::transpose(volume.axes) * (world - volume.origin) / volume.spacing;
        // A 512th of a texel by rounding, and float arithmetic on numbers of up to some hundred.
        EXPECT_LE(glm::length(walk.position(x, y, depth) - index), std::sqrt(3.) / 512 + 1e-3);
      }
    }
  }
}

// The data on which the walk relies, against their definitions in floating point: half a level.
TEST(FixedPointWalk, PaletteAndTexelsAreTheSceneInLevels) {
  const double half = 0.5 / 255 + 1e-6;
  const Scene scene = smooth(kOneSided);
  const Volume& volume = *scene.volume;
  const FixedSettings settings{Classification::Post, false, 0.03};
  const std::vector<uint8_t> palette = fixed_palette(scene, settings), texels = fixed_texels(scene, settings);
  for (int level = 0; level < 256; ++level) {
    const glm::dvec4 point = scene.transfer.at(level / 255.);
    for (int c = 0; c < 4; ++c) {
      const double expected = c < 3 ? point[c] : -std::expm1(-point.a * settings.step);
      EXPECT_NEAR(palette[static_cast<size_t>(4 * level + c)] / 255., expected, half) << level;
    }
  }
  const double floor = gradient_floor(*scene.effects.lighting, scene.transfer, volume);
  for (const glm::ivec3 p : {glm::ivec3(0, 7, 39), {20, 20, 20}, {39, 0, 3}, {13, 30, 22}}) {
    const auto sample = static_cast<size_t>((p.z * volume.size.y + p.y) * volume.size.x + p.x);
    const size_t at = 4 * sample;
    EXPECT_NEAR(texels[at + 3] / 255., volume.at(p.x, p.y, p.z), half);
    const glm::dvec3 gradient = glm::dvec3(volume.at(p.x + 1, p.y, p.z) - volume.at(p.x - 1, p.y, p.z),
                                           volume.at(p.x, p.y + 1, p.z) - volume.at(p.x, p.y - 1, p.z),
                                           volume.at(p.x, p.y, p.z + 1) - volume.at(p.x, p.y, p.z - 1)) /
                                (2. * volume.spacing);
    const glm::dvec3 normal = -gradient / std::max(glm::length(gradient), floor);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(2 * texels[at + static_cast<size_t>(axis)] / 255. - 1, normal[axis], 2 * half);
    }
  }
}

// Slab of optical depth 1: what the integers give, whatever draws them.
TEST(FixedPointWalk, SlabIsItsRecursion) {
  Device device = make_device(backend_id(), device_options());
  const Scene scene = with_fixed_point(shipped_scene("slab"));
  for (const double step : {1., 0.5, 0.25}) {  // 16, 32 and 64 slices; 8-bit opacities of 15, 8 and 4
    const int alpha = static_cast<int>(std::lround(255 * -std::expm1(-step / 16)));
    int sum = 0;
    for (int k = 0; k < static_cast<int>(16 / step); ++k) {
      const int p = sum * (255 - alpha);
      sum = alpha + ((p + (p >> 8) + 128) >> 8);
    }
    const std::string text = fmt::format("{}", step);
    const Image image = draw(device, scene, kMethods[0], {{"step", text.c_str()}}, scene.views[0], 32, 32).image;
    EXPECT_NEAR(std::lround(255 * image.pixel(16, 16)[3]), sum, device.info().software ? 0 : 16 / step) << step;
  }
}

// ---- What it must look like -----------------------------------------------------------------------------------------

// Each of n samples that are seen rounds its opacity and its colour by half a level, and its blend by half a level
// more: at most n levels from the picture in float, and in the mean some levels, never none.
TEST(FixedPointPicture, IsAsFarFromFloatAsEightBitsMustBe) {
  Device device = make_device(backend_id(), device_options());
  const Scene fixed = with_fixed_point(shipped_scene("cloud"));
  Scene exact = fixed;
  exact.effects.fixed_point = false;
  const View& view = fixed.views[0];
  const Image in_float = draw(device, exact, kMethods[0], {{"end_slabs", "full"}}, view, kSize, kSize).image;
  const Image in_levels = draw(device, fixed, kMethods[0], {}, view, kSize, kSize).image;
  const Difference d = difference(in_levels, in_float);
  std::printf("cloud in fixed point against float: rmse %.5f, largest %.4f\n", d.rmse, d.max);
  EXPECT_GT(d.rmse, 0.25 / 255);
  EXPECT_LT(d.rmse, 8. / 255);
  EXPECT_LT(d.max, 127. / 255);
  for (const float value : in_levels.rgba) {
    const float level = 255 * value;
    ASSERT_NEAR(level, std::nearbyint(level), 1e-4) << "not a level";
  }
}

// What passes 1 is cut off there: a light of twenty times the brightness looks as one that saturates.
TEST(FixedPointPicture, LightIsClampedToOne) {
  Device device = make_device(backend_id(), device_options());
  const auto lit_by = [&](double brightness) {
    Scene scene = smooth(kOneSided);
    scene.effects.lighting->lights.resize(1);
    scene.effects.lighting->lights[0].colour = glm::dvec3(brightness);
    return pictures(device, scene, kMethods[0], {}, views_of(scene, true))[0];
  };
  const Image bright = lit_by(2);
  EXPECT_EQ(difference(bright, lit_by(40)).max, 0);
  EXPECT_GT(difference(bright, lit_by(0.5)).max, 0.05);
  for (size_t i = 0; i < bright.rgba.size(); i += 4) {
    // Colour and opacity go through the same products, so that colour stays below opacity.
    for (size_t c = 0; c < 3; ++c) ASSERT_LE(bright.rgba[i + c], bright.rgba[i + 3]) << "pixel " << i / 4;
  }
}

TEST(FixedPointPicture, TheReferenceIsTheSceneWithoutIt) {
  const Scene fixed = smooth(kClipped);
  Scene exact = fixed;
  exact.effects.fixed_point = false;
  EXPECT_EQ(difference(render_reference(fixed, fixed.views[0], 12, 12).image,
                       render_reference(exact, exact.views[0], 12, 12).image)
                .max,
            0);
}

TEST(FixedPointPicture, TheSceneDecidesTheTarget) {
  const Scene fixed = smooth();
  for (const char* name : kMethods) {
    const Method& method = find_method(name);
    const Values values = default_values(method.info().parameters);
    EXPECT_EQ(target_format(method, fixed, values), Format::RGBA8);
    EXPECT_EQ(target_format(method, shipped_scene("sphere"), values), Format::RGBA32F);
  }
}

TEST(FixedPointPicture, WhatCombinersCannotDoIsRefused) {
  Device device = make_device(backend_id(), device_options());
  const auto refusal = [&](const Scene& scene, Settings settings) -> std::string {
    const Method& method = find_method(kMethods[0]);
    Values values = default_values(method.info().parameters);
    for (const auto& [name, value] : settings) set_value(method.info().parameters, values, name, std::string(value));
    return unsupported_reason(method, scene, values, device.info()).value_or("");
  };
  EXPECT_THAT(refusal(smooth(), {{"classification", "preintegrated"}}),
              HasSubstr("effect fixed_point: 8-bit palettes"));
  Scene scene = smooth(kOneSided);
  EXPECT_EQ(refusal(scene, {}), "");
  scene.effects.lighting->shininess = 12;
  EXPECT_THAT(refusal(scene, {}), HasSubstr("shininess 12 is not a power of two"));
  scene.effects.lighting->specular = 0;
  EXPECT_EQ(refusal(scene, {}), "");
  scene.effects.lighting->lights[0].kind = Light::Kind::Point;
  EXPECT_THAT(refusal(scene, {}), HasSubstr("a point light has another direction at every sample"));
  scene.effects.lighting->lights.assign(9, Light{});
  EXPECT_THAT(refusal(scene, {}), HasSubstr("9 lights, at most 8"));
}

}  // namespace
}  // namespace volumark
