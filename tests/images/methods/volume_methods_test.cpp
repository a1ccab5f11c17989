// Every volume method on one backend: closed forms, the reference, the order of convergence, the other backend, and
// data at the edge of what is allowed. New volume methods are added to kMethods.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/metrics/metrics.h"
#include "methods/reference/reference.h"
#include "tests/support/backend.h"
#include "tests/support/drawing.h"

namespace volumark {
namespace {

constexpr const char* kMethods[] = {"texture3d_slices", "raycast", "slices2d", "slices2d_viewport"};

// What puts the samples of a method `step` voxels apart.
struct Spacing {
  const char* name;
  std::string value;
};
Spacing spacing_of(const std::string& method, double step) {
  if (method == "slices2d") return {"slices", fmt::format("{}", std::lround(100 / step))};
  return {"step", fmt::format("{}", step)};
}

class VolumeMethods : public testing::TestWithParam<const char*> {
 protected:
  std::string method = GetParam();
  Device device = make_device(backend_id(), device_options());
};
INSTANTIATE_TEST_SUITE_P(Each, VolumeMethods, testing::ValuesIn(kMethods),
                         [](const auto& tested) { return std::string(tested.param); });

// A smooth field under a smooth transfer function; what differs from scene to scene is put in.
std::string smooth_scene(const std::string& views, const std::string& more = "") {
  return fmt::format(R"({{
    "volumark_scene": 1,
    "title": "smooth",
    "volume": {{"generator": {{"kind": "marschner_lobb", "size": 48, "type": "f32", "frequency": 1, "alpha": 0.25}}}},
    "transfer": {{"points": [{{"value": 0, "colour": [0.2, 0.4, 1], "extinction": 0.2}},
                             {{"value": 1, "colour": [1, 0.6, 0.2], "extinction": 2}}], "window": [0, 1]}},
    "views": [{}]{}
  }})",
                     views, more);
}
const char* const kOrthographic = R"({"orbit": {"count": 3, "azimuth": 30, "elevation": 20, "distance": 4,
  "half_height": 1.6, "units": "world", "target": [0, 0, 0]}})";
const char* const kPerspective = R"({"orbit": {"count": 3, "azimuth": 30, "elevation": 20, "distance": 3.4,
  "fov_y": 40, "units": "world", "target": [0, 0, 0]}})";
const char* const kEyeInside = R"({"orbit": {"count": 3, "azimuth": 30, "elevation": 20, "distance": 0.3,
  "fov_y": 70, "units": "world", "target": [0.1, 0, 0.2]}})";

bool simulates(const std::string& method, const char* effect) {
  const std::vector<std::string>& effects = find_method(method).info().effects;
  return std::find(effects.begin(), effects.end(), effect) != effects.end();
}

// Against the reference over all views, at a quarter of a voxel. The bounds are what order 2 leaves at that step on
// these fields, measured once (1e-5 to 8e-5) and rounded up; a seam, a shift or a lost slab is far above them.
void expect_close_to_reference(Device& device, const std::string& method, const Scene& scene, double rmse, double max) {
  for (const View& view : scene.views) {
    const Image reference = render_reference(scene, view, 96, 96).image;
    const Spacing quarter = spacing_of(method, 0.25);
    const Image image = draw(device, scene, method, {{quarter.name, quarter.value.c_str()}}, view, 96, 96).image;
    const Difference d = difference(image, reference);
    EXPECT_LE(d.rmse, rmse) << view.name;
    EXPECT_LE(d.max, max) << view.name << " at " << d.x << ", " << d.y;
  }
}

TEST_P(VolumeMethods, SlabHasItsClosedFormForAnyStep) {
  const Scene scene = shipped_scene("slab");
  const double expected = -std::expm1(-1.0);
  for (const double step : {16., 5., 1., 0.3, 0.125}) {
    const Spacing spacing = spacing_of(method, step);
    const Image image =
        draw(device, scene, method, {{spacing.name, spacing.value.c_str()}}, scene.views[0], 32, 32).image;
    const double slices = 16 / step;
    for (size_t c = 0; c < 4; ++c) {
      // One rounding of 2^-24 a blend, and one for the opacity of the slab.
      EXPECT_NEAR(static_cast<double>(image.pixel(16, 16)[c]), expected, (slices + 4) * 1.2e-7) << "step " << step;
    }
  }
}

TEST_P(VolumeMethods, AgreesWithTheReferenceOrthographic) {
  expect_close_to_reference(device, method, scene_from_text(smooth_scene(kOrthographic)), 2e-4, 2e-3);
}
TEST_P(VolumeMethods, AgreesWithTheReferenceInPerspective) {
  expect_close_to_reference(device, method, scene_from_text(smooth_scene(kPerspective)), 2e-4, 2e-3);
}
TEST_P(VolumeMethods, AgreesWithTheReferenceFromInside) {
  expect_close_to_reference(device, method, scene_from_text(smooth_scene(kEyeInside)), 2e-4, 2e-3);
}
TEST_P(VolumeMethods, AgreesWithTheReferenceUnderClipPlanes) {
  const Scene scene = scene_from_text(smooth_scene(kPerspective, R"(, "effects": {"clip_planes": [
      {"normal": [1, 0.3, 0.2], "distance": -0.3}, {"normal": [-0.2, 1, -0.5], "distance": -0.4}]})"));
  expect_close_to_reference(device, method, scene, 2e-4, 2e-3);
}
TEST_P(VolumeMethods, AgreesWithTheReferenceUnderLights) {
  if (!simulates(method, "lighting")) return;  // then the cell is refused, as for any effect
  const Scene scene = scene_from_text(smooth_scene(kPerspective, R"(, "effects": {"lighting": {
      "ambient": 0.2, "diffuse": 0.7, "specular": 0.3, "shininess": 12, "two_sided": false,
      "lights": [{"directional": [0.5, 1, 0.3], "colour": [1, 0.9, 0.8]},
                 {"point": [2, 0.5, 2], "colour": [0.3, 0.4, 0.6]}]}})"));
  expect_close_to_reference(device, method, scene, 1e-3, 2e-2);
}

// Order of the root mean square error from a step of 4 voxels to one of 1, with one more setting. Slices of stacks lie
// on the samples, where the interpolated field has its kinks: their error has its constant from a step of 1 on.
double fitted_order(Device& device, const std::string& method, const Scene& scene, const char* name,
                    const char* value) {
  const View& view = scene.views[0];
  const Image reference = render_reference(scene, view, 64, 64).image;
  const auto error = [&](double step) {
    const Spacing spacing = spacing_of(method, step);
    const Settings settings = {{spacing.name, spacing.value.c_str()}, {name, value}};
    return difference(draw(device, scene, method, settings, view, 64, 64).image, reference).rmse;
  };
  const double first = method == "slices2d" ? 1 : 4;
  return std::log(error(first) / error(first / 4)) / std::log(4.0);
}

TEST_P(VolumeMethods, ConvergeWithOrderTwo) {
  const Scene scene = scene_from_text(smooth_scene(kPerspective));
  EXPECT_NEAR(fitted_order(device, method, scene, "classification", "post"), 2, 0.3);
  if (!method.starts_with("slices2d")) {
    EXPECT_NEAR(fitted_order(device, method, scene, "classification", "preintegrated"), 2, 0.3);
  }
}

TEST_P(VolumeMethods, LoseAnOrderWithoutWhatMakesItTwo) {
  if (method != "texture3d_slices" && method != "slices2d_viewport") return;
  const Scene scene = scene_from_text(smooth_scene(kPerspective));
  EXPECT_NEAR(fitted_order(device, method, scene, "end_slabs", "full"), 1, 0.4);
  EXPECT_NEAR(fitted_order(device, method, scene, "opacity_correction", "linear"), 1, 0.4);
}

TEST_P(VolumeMethods, BackToFrontAndFrontToBackAgree) {
  if (method != "texture3d_slices" && method != "slices2d_viewport") return;
  const Scene scene = scene_from_text(smooth_scene(kPerspective));
  const auto picture = [&](const char* order) {
    return draw(device, scene, method, {{"order", order}}, scene.views[0], 64, 64).image;
  };
  EXPECT_LE(difference(picture("back_to_front"), picture("front_to_back")).max, 2e-5);
}

TEST_P(VolumeMethods, TargetsOfFewerBitsAreWithinTheirRounding) {
  const Scene scene = scene_from_text(smooth_scene(kPerspective));
  const Spacing spacing = spacing_of(method, 4);
  const auto picture = [&](const char* format) {
    const Settings settings = {{spacing.name, spacing.value.c_str()}, {"target_format", format}};
    return draw(device, scene, method, settings, scene.views[0], 64, 64).image;
  };
  const Image full = picture("rgba32f");
  // A ray meets at most 21 slices of 4 voxels (the diagonal of 47 cells); each blend loses up to one step.
  EXPECT_LE(difference(picture("rgba16f"), full).max, 30 * 0x1p-11);
  EXPECT_LE(difference(picture("rgba8"), full).max, 30 * 0.5 / 255);
}

// The other backend that the picture is compared with: cpu against gl, gl and vulkan against cpu.
std::string other_backend() { return backend_id() == "cpu" ? "gl" : "cpu"; }

TEST_P(VolumeMethods, BackendsAgreeOnEveryShippedScene) {
  Device other = make_device(other_backend());
  for (const char* name : {"engine", "brain", "ch2", "marschner_lobb", "cloud", "sphere", "slab"}) {
    Scene scene = shipped_scene(name);
    if (!simulates(method, "lighting")) scene.effects.lighting.reset();
    const View& view = scene.views[1];
    const Spacing spacing = spacing_of(method, 1);
    const Image here = draw(device, scene, method, {{spacing.name, spacing.value.c_str()}}, view, 128, 128).image;
    const Image there = draw(other, scene, method, {{spacing.name, spacing.value.c_str()}}, view, 128, 128).image;
    const Parity agreement = parity(here, there);
    EXPECT_TRUE(agreement.agree) << name << ": interior " << agreement.interior_max << " at " << agreement.interior_x
                                 << ", " << agreement.interior_y << "; silhouettes over the limit "
                                 << agreement.silhouette_over << " of " << agreement.silhouette_pixels;
    EXPECT_GT(agreement.interior_pixels, 0) << name;
  }
}

TEST_P(VolumeMethods, DegenerateVolumesAreDefined) {
  for (const char* size : {"[1, 1, 1]", "[1, 9, 9]", "[9, 1, 9]", "[9, 9, 1]", "[1, 1, 9]", "[2, 2, 2]"}) {
    const Scene scene = scene_from_text(fmt::format(R"({{
      "volumark_scene": 1, "title": "flat",
      "volume": {{"generator": {{"kind": "constant", "size": {}, "type": "u8", "value": 1}}}},
      "transfer": {{"points": [{{"value": 1, "colour": [1, 0.5, 0.25], "extinction": 0.5}}], "window": [0, 2]}},
      "views": [{}]}})",
                                                    size, kPerspective));
    const View& view = scene.views[0];
    const Image reference = render_reference(scene, view, 48, 48).image;
    const Parity d = parity(draw(device, scene, method, {}, view, 48, 48).image, reference);
    // Constant: exact for any step, edges included. What is left is float rounding: both ends of up to 14 stretches,
    // each within 8 ulp of the box of 2 units (box coordinates come from plane equations of small polygons), times the
    // extinction. Where a ray grazes an edge, the end of its chord moves by that over the sine of the angle.
    const double bound = 14 * 2 * 0x1p-20 * 2 * 0.5;
    EXPECT_LE(d.interior_max, bound) << size << " at " << d.interior_x << ", " << d.interior_y;
    EXPECT_LE(d.silhouette_max, bound / 0.05) << size;
  }
}

TEST_P(VolumeMethods, NothingToSeeIsExactlyNothing) {
  const Scene scene = scene_from_text(fmt::format(R"({{
    "volumark_scene": 1, "title": "clear",
    "volume": {{"generator": {{"kind": "ramp", "size": 16, "type": "f32", "axis": "x", "from": 0, "to": 1}}}},
    "transfer": {{"points": [{{"value": 0, "colour": [1, 1, 1], "extinction": 0}}], "window": [0, 1]}},
    "views": [{}]}})",
                                                  kPerspective));
  for (const float value : draw(device, scene, method, {}, scene.views[0], 32, 32).image.rgba) ASSERT_EQ(value, 0.f);
}

TEST_P(VolumeMethods, HugeExtinctionSaturatesAndStaysFinite) {
  const Scene scene = scene_from_text(fmt::format(R"({{
    "volumark_scene": 1, "title": "opaque",
    "volume": {{"generator": {{"kind": "ramp", "size": 16, "type": "f32", "axis": "x", "from": 0, "to": 1}}}},
    "transfer": {{"points": [{{"value": 0, "colour": [0.5, 1, 0.25], "extinction": 1e6}}], "window": [0, 1]}},
    "views": [{}]}})",
                                                  kPerspective));
  const Image image = draw(device, scene, method, {}, scene.views[0], 32, 32).image;
  const float* centre = image.pixel(16, 16);
  EXPECT_NEAR(centre[0], 0.5, 1e-6);
  EXPECT_NEAR(centre[3], 1, 1e-6);
  for (const float value : image.rgba) ASSERT_TRUE(std::isfinite(value) && value >= 0 && value <= 1.000001f);
}

TEST_P(VolumeMethods, ThreadsDoNotChangeABit) {
  if (backend_id() != "cpu") return;
  const Scene scene = scene_from_text(smooth_scene(kPerspective));
  std::vector<Image> images;
  for (const int threads : {1, 2, 5}) {
    DeviceOptions options;
    options.threads = threads;
    Device limited = make_device("cpu", options);
    images.push_back(draw(limited, scene, method, {}, scene.views[0], 200, 120).image);
  }
  EXPECT_EQ(images[0].rgba, images[1].rgba);
  EXPECT_EQ(images[0].rgba, images[2].rgba);
}

}  // namespace
}  // namespace volumark
