// The toy scene, drawn by the toy method through the toy backend, on each backend of the house.
#include <gtest/gtest.h>

#include <algorithm>

#include "harness/frame.h"
#include "methods/volume/volume_uniforms.h"
#include "scenes/scene_io.h"
#include "tests/examples/counting_backend.h"
#include "tests/examples/toy_mip.h"
#include "tests/support/backend.h"
#include "tests/support/drawing.h"

namespace volumark {
namespace {

std::unique_ptr<Backend> make_backend_under_test() {
  const auto list = backend_list();
  const auto entry = std::find_if(list.begin(), list.end(), [](const auto& e) { return backend_id() == e.id; });
  return entry->make(device_options());
}

class Examples : public testing::Test {
 protected:
  Values values(const char* samples) const {
    Values out = default_values(toy_mip().info().parameters);
    set_value(toy_mip().info().parameters, out, "samples", std::string(samples));
    return out;
  }
  Image draw_view(const Values& with, size_t view) {
    FrameSource source(scene, toy_mip(), with, device, scene.width, scene.height);
    source.frame(scene.views[view]);
    return source.read_back();
  }

  BackendCounts counts;
  Device device{make_counting_backend(make_backend_under_test(), counts)};
  Scene scene = load_scene(VM_EXAMPLES "/toy_ramp.json", DataOptions{});
};

// Place across the box of a pixel's centre, from the scene file: half_height 1.25, box 2 x 1 x 0.5.
double world(int pixel, int count) { return ((pixel + 0.5) / count * 2 - 1) * 1.25; }

TEST_F(Examples, FromTheFrontAPixelShowsItsPlaceAcrossTheRamp) {
  const Image image = draw_view(values("8"), 0);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double across = world(x, image.width);
      const bool inside = std::abs(across) < 1 && std::abs(world(y, image.height)) < 0.5;
      const double grey = inside ? (across + 1) / 2 : 0;
      for (size_t c = 0; c < 3; ++c)
        ASSERT_NEAR(static_cast<double>(image.pixel(x, y)[c]), grey, 1e-5) << x << ", " << y;
      ASSERT_EQ(image.pixel(x, y)[3], inside ? 1.F : 0.F) << x << ", " << y;
    }
  }
}

TEST_F(Examples, AlongTheRampTheNearestSampleToItsEndIsTheLargest) {
  for (const int samples : {1, 4, 64}) {
    const Image image = draw_view(values(std::to_string(samples).c_str()), 1);
    const double largest = 1 - 0.5 / samples;
    EXPECT_NEAR(static_cast<double>(image.pixel(40, 40)[0]), largest, 1e-5) << samples << " samples";
  }
}

TEST_F(Examples, WhatTheMethodCannotSimulateIsUnsupportedWithAReason) {
  scene.effects.lighting.emplace().lights.emplace_back();
  EXPECT_EQ(unsupported_reason(toy_mip(), scene, values("8"), device.info()),
            "effect lighting: toy_mip does not simulate it");
}

TEST_F(Examples, TheBackendCountsOneDrawAndOneUniformBlockAFrame) {
  {
    FrameSource source(scene, toy_mip(), values("8"), device, scene.width, scene.height);
    counts = {};
    source.frame(scene.views[0]);
    source.frame(scene.views[1]);
    EXPECT_EQ(counts.draws, 2);
    EXPECT_EQ(counts.vertices, 6);
    EXPECT_EQ(counts.passes, 2);
    EXPECT_EQ(counts.submissions, 2);
    EXPECT_EQ(counts.uploaded, 2 * sizeof(VolumeUniforms));
    EXPECT_EQ(counts.read_back, 0U);
    source.read_back();
    EXPECT_EQ(counts.read_back, 80U * 80U * 16U);
  }
  EXPECT_EQ(device.live_bytes(), 0U);
  EXPECT_EQ(device.info().id, "counting_" + backend_id());
}

}  // namespace
}  // namespace volumark
