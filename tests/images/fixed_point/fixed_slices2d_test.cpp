// The effect fixed_point on slices2d: the same bits on every backend and as a scalar walk gives, with no tolerance.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "methods/reference/reference.h"
#include "tests/images/fixed_point/stack_walk.h"
#include "tests/support/backend.h"
#include "tests/support/drawing.h"

namespace volumark {
namespace {

constexpr int kSize = 64;

// `view`: members of a view but its up and units.
Scene smooth(const std::string& view, const std::string& effects = "", const std::string& size = "[40, 33, 24]") {
  return scene_from_text(fmt::format(R"({{
    "volumark_scene": 1, "title": "smooth",
    "volume": {{"generator": {{"kind": "marschner_lobb", "size": {}, "type": "f32", "frequency": 2, "alpha": 0.25}}}},
    "transfer": {{"points": [{{"value": 0.4, "colour": [0.2, 0.4, 1], "extinction": 0}},
                             {{"value": 0.6, "colour": [1, 0.6, 0.2], "extinction": 20}}], "window": [0, 1]}},
    "views": [{{{}, "up": [0, 1, 0.01], "units": "world"}}],
    "effects": {{"fixed_point": true{}}}}})",
                                     size, view, effects));
}
constexpr const char* kClipped = R"(, "clip_planes": [{"normal": [1, 0.3, 0.2], "distance": -0.3}])";

// From in front of each stack, in perspective and orthographic, and from within.
constexpr const char* kOutside[] = {R"("eye": [3, 1.1, 1.4], "target": [0, 0, 0], "fov_y": 40)",
                                    R"("eye": [1.4, -3, 1.1], "target": [0, 0, 0], "fov_y": 40)",
                                    R"("eye": [1.1, 1.4, 3], "target": [0, 0, 0], "fov_y": 40)",
                                    R"("eye": [1.1, 1.4, -3], "target": [0, 0, 0], "half_height": 1.6)",
                                    R"("eye": [-3, 1.4, 2], "target": [0, 0, 0], "half_height": 1.6)"};
constexpr const char* kInside = R"("eye": [0.1, 0.2, 0.3], "target": [0.3, -1, -0.2], "fov_y": 70, "near": 0.05)";

Image picture(Device& device, const Scene& scene, Settings settings = {}) {
  return draw(device, scene, "slices2d", settings, scene.views.at(0), kSize, kSize).image;
}

double light_in(const Image& image) {
  double sum = 0;
  for (const float value : image.rgba) sum += static_cast<double>(value);
  return sum;
}

class FixedSlices2d : public testing::Test {
 protected:
  void SetUp() override {
    if (!device.info().software) GTEST_SKIP() << "8-bit blending is the driver's own on GPUs";
  }
  void expect_same_bits(const Scene& scene, Settings settings = {}) {
    const Image ours = picture(device, scene, settings);
    const Difference d = difference(ours, picture(other, scene, settings));
    EXPECT_EQ(d.max, 0) << "at " << d.x << ", " << d.y << ": " << std::lround(255 * d.max) << " levels";
    EXPECT_GT(light_in(ours), 50) << "an empty picture agrees with anything";
  }

  Device device = make_device(backend_id(), device_options());
  Device other = make_device(backend_id() == "cpu" ? "gl" : "cpu");
};

TEST_F(FixedSlices2d, TheSameBitsFromEverywhere) {
  for (const char* view : kOutside) expect_same_bits(smooth(view), {{"slices", "170"}});
  expect_same_bits(smooth(kInside, kClipped), {{"slices", "170"}});
}
TEST_F(FixedSlices2d, TheSameBitsWithEveryParameter) {
  const Scene scene = smooth(kOutside[2], kClipped);
  for (const char* textures : {"1", "2", "4"}) {
    expect_same_bits(scene, {{"textures_per_polygon", textures}, {"classification", "pre"}, {"slices", "130"}});
    expect_same_bits(scene, {{"textures_per_polygon", textures}, {"texture_coordinates", "uncorrected"}});
  }
  expect_same_bits(scene, {{"interpolation", "false"}, {"slices", "250"}, {"opacity_correction", "linear"}});
}
TEST_F(FixedSlices2d, TheSameBitsOfFlatVolumes) {
  for (const char* size : {"[40, 1, 24]", "[1, 40, 24]", "[40, 24, 1]"})
    expect_same_bits(smooth(kOutside[0], "", size), {{"slices", "300"}});
}
TEST_F(FixedSlices2d, TheSameBitsOfShippedScenes) {
  for (const char* name : {"cloud", "brain"}) {
    Scene scene = shipped_scene(name);
    scene.effects = {};
    scene.effects.fixed_point = true;
    expect_same_bits(scene);
  }
}
TEST_F(FixedSlices2d, TheSameBitsOfAnyNumberOfThreads) {
  if (backend_id() != "cpu") return;
  const Scene scene = smooth(kOutside[1]);
  std::vector<Image> images;
  for (const int threads : {1, 3}) {
    DeviceOptions options = device_options();
    options.threads = threads;
    Device limited = make_device("cpu", options);
    images.push_back(picture(limited, scene));
  }
  EXPECT_EQ(images[0].rgba, images[1].rgba);
}

// Pixels composed one by one in plain integers.
TEST_F(FixedSlices2d, PixelsAreThoseOfAScalarWalk) {
  int seen = 0;
  const auto expect_as_walked = [&](const std::string& view, const SliceSettings& slices,
                                    Classification classification) {
    const Scene scene = smooth(view, kClipped);
    const std::string percent = fmt::format("{}", slices.percent), textures = fmt::format("{}", slices.textures);
    const Image image = picture(device, scene,
                                {{"slices", percent.c_str()},
                                 {"textures_per_polygon", textures.c_str()},
                                 {"interpolation", slices.interpolate ? "true" : "false"},
                                 {"texture_coordinates", slices.corrected ? "corrected" : "uncorrected"},
                                 {"classification", classification == Classification::Pre ? "pre" : "post"}});
    const StackWalk walk(scene, slices, classification, scene.views[0], kSize);
    for (int y = 2; y < kSize; y += 5) {
      for (int x = 2; x < kSize; x += 5) {
        const std::array<int, 4> want = walk.pixel(x, y);
        for (size_t c = 0; c < 4; ++c) {
          EXPECT_EQ(std::lround(255 * image.pixel(x, y)[c]), want[c])
              << view << " at " << x << ", " << y << " channel " << c << ", " << textures << " textures";
        }
        seen += want[3] > 0 ? 1 : 0;
      }
    }
  };
  for (const char* view : kOutside) {
    SliceSettings slices;
    expect_as_walked(view, slices, Classification::Post);
    slices.percent = 170;
    slices.textures = 4;
    expect_as_walked(view, slices, Classification::Pre);
    slices.textures = 2;
    slices.corrected = false;
    slices.interpolate = false;
    expect_as_walked(view, slices, Classification::Post);
  }
  expect_as_walked(kInside, {}, Classification::Post);
  EXPECT_GT(seen, 500);
}

// Slab of optical depth 1, seen across its slices: what the integers give, whatever draws them.
TEST_F(FixedSlices2d, SlabIsItsRecursion) {
  Scene scene = shipped_scene("slab");
  scene.effects.fixed_point = true;
  for (const int64_t percent : {100, 200, 400}) {
    const std::string text = fmt::format("{}", percent);
    const Drawing drawing = draw(device, scene, "slices2d", {{"slices", text.c_str()}}, scene.views[0], 32, 32);
    const auto slices = static_cast<int>(drawing.counters.at("slices"));
    const int alpha = static_cast<int>(std::lround(255 * -std::expm1(-1. / (slices - 1))));
    int sum = 0;
    for (int k = 0; k < slices; ++k) {
      const int p = sum * (255 - alpha);
      sum = std::min(alpha + ((p + (p >> 8) + 128) >> 8), 255);
    }
    EXPECT_EQ(std::lround(255 * drawing.image.pixel(16, 16)[3]), sum) << percent;
  }
}

// Levels are lost where slices grow thin: from some point on more of them make the picture worse.
TEST_F(FixedSlices2d, ManySlicesMakeItWorse) {
  if (backend_id() != "cpu") return;  // the bits are the same elsewhere
  Scene scene = shipped_scene("cloud");
  scene.effects = {};
  const Image reference = render_reference(scene, scene.views[0], kSize, kSize).image;
  scene.effects.fixed_point = true;
  const auto error = [&](const char* slices) {
    return difference(picture(device, scene, {{"slices", slices}}), reference).rmse;
  };
  EXPECT_LT(error("100"), 0.04);
  EXPECT_GT(error("800"), 2 * error("100"));
}

}  // namespace
}  // namespace volumark
