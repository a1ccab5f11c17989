// The effect fixed_point: the same bits on every backend, whatever rasterizes, filters and blends there; the same as a
// scalar walk along single rays; clamped where combiners clamp; as far from the picture in float as 8 bits must be.
#include "methods/volume/fixed_point.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "methods/reference/reference.h"
#include "tests/support/backend.h"
#include "tests/support/drawing.h"

namespace volumark {
namespace {

constexpr int kSize = 96;
constexpr const char* kMethods[] = {"texture3d_slices", "raycast"};

Scene with_fixed_point(Scene scene) {
  scene.effects.fixed_point = true;
  return scene;
}

// Views of the scene from about the same place, `perspective` or not; three of its orbit.
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

// Lit from one side, with a square and a clip plane: what engine does not have.
Scene one_sided() {
  return with_fixed_point(scene_from_text(R"({
    "volumark_scene": 1,
    "title": "one-sided",
    "volume": {"generator": {"kind": "marschner_lobb", "size": 40, "type": "f32", "frequency": 2, "alpha": 0.25}},
    "transfer": {"points": [{"value": 0.4, "colour": [0.2, 0.4, 1], "extinction": 0},
                            {"value": 0.6, "colour": [1, 0.6, 0.2], "extinction": 20}], "window": [0, 1]},
    "views": [{"orbit": {"count": 8, "azimuth": 25, "elevation": 35, "distance": 3.4, "fov_y": 40, "units": "world",
                         "target": [0, 0, 0]}}],
    "effects": {"lighting": {"ambient": 0.2, "diffuse": 0.7, "specular": 0.6, "shininess": 8, "two_sided": false,
                             "lights": [{"directional": [0.5, 1, 0.3], "colour": [1, 0.9, 0.8]},
                                        {"directional": [-1, 0.2, 0.6], "colour": [0.3, 0.5, 1]}]},
                "clip_planes": [{"normal": [1, 0.3, 0.2], "distance": -0.3}]}
  })"));
}

std::string other_backend() { return backend_id() == "cpu" ? "gl" : "cpu"; }

void expect_same_bits(const Scene& scene, Settings settings = {}) {
  Device device = make_device(backend_id(), device_options()), other = make_device(other_backend());
  if (!device.info().software || !other.info().software) GTEST_SKIP() << "8-bit blending is the driver's own on GPUs";
  for (const char* method : kMethods) {
    for (const bool perspective : {false, true}) {
      for (const View& view : views_of(scene, perspective)) {
        const Image a = draw(device, scene, method, settings, view, kSize, kSize).image;
        const Image b = draw(other, scene, method, settings, view, kSize, kSize).image;
        const Difference d = difference(a, b);
        EXPECT_EQ(d.max, 0) << method << (perspective ? ", perspective" : ", orthographic") << " at " << d.x << ", "
                            << d.y << ", " << std::lround(255 * d.max) << " levels";
        double seen = 0;
        for (const float value : a.rgba) seen += static_cast<double>(value);
        EXPECT_GT(seen, 50) << method << ": an empty picture agrees with anything";
      }
    }
  }
}

TEST(FixedPoint, SameBitsOfASphere) { expect_same_bits(with_fixed_point(shipped_scene("sphere"))); }
TEST(FixedPoint, SameBitsOfACloud) { expect_same_bits(with_fixed_point(shipped_scene("cloud"))); }
TEST(FixedPoint, SameBitsOfAnEngineUnderLights) { expect_same_bits(with_fixed_point(shipped_scene("engine"))); }
TEST(FixedPoint, SameBitsOneSidedAndClipped) { expect_same_bits(one_sided(), {{"step", "0.37"}}); }

}  // namespace
}  // namespace volumark
