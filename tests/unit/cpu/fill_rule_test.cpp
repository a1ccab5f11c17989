// Every pixel of a surface cut into triangles is drawn exactly once, whatever the triangles look like; clipping changes
// nothing inside the frustum.
#include "backends/cpu/highway_targets.h"
// Before anything of Highway.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <random>

#include "raster_fixture.h"

namespace volumark {
namespace {

PipelineDesc adding() {
  PipelineDesc pipeline;
  pipeline.blend = Blend::Add;
  return pipeline;
}

// How many pixels are not drawn exactly once.
int wrong_pixels(RasterFixture& raster) {
  const std::vector<float> image = raster.pixels();
  int wrong = 0;
  for (size_t i = 0; i < image.size(); i += 4) wrong += image[i] == 1 ? 0 : 1;
  return wrong;
}

class Fan {
 public:
  explicit Fan(unsigned seed) : random_(seed) {}
  float uniform(float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(random_); }

  // Triangles around (cx, cy) to points on the border of [-reach, reach]^2, with slivers where points are close.
  std::vector<TestVertex> around(float cx, float cy, float reach, int points_a_side, bool random_w) {
    std::vector<TestVertex> ring;
    const float corners[5][2] = {{-reach, -reach}, {reach, -reach}, {reach, reach}, {-reach, reach}, {-reach, -reach}};
    for (int side = 0; side < 4; ++side) {
      std::vector<float> cuts{0};
      for (int i = 0; i < points_a_side; ++i) cuts.push_back(uniform(0, 1));
      std::ranges::sort(cuts);
      for (const float t : cuts) {
        const float x = corners[side][0] + t * (corners[side + 1][0] - corners[side][0]);
        const float y = corners[side][1] + t * (corners[side + 1][1] - corners[side][1]);
        ring.push_back(at_ndc(x, y, 0, random_w ? uniform(0.5F, 4) : 1));
      }
    }
    const TestVertex centre = at_ndc(cx, cy, 0, random_w ? 1.7F : 1);
    std::vector<TestVertex> triangles;
    for (size_t i = 0; i < ring.size(); ++i) {
      triangles.insert(triangles.end(), {centre, ring[i], ring[(i + 1) % ring.size()]});
    }
    return triangles;
  }

 private:
  std::mt19937 random_;
};

TEST(FillRule, EveryPixelOfRandomFansExactlyOnce) {
  RasterFixture raster(131, 97, 2, kernels_of<constant_kernel>, adding());
  Fan fan(7);
  for (int i = 0; i < 300; ++i) {
    raster.draw(fan.around(fan.uniform(-1, 1), fan.uniform(-1, 1), 1.25F, i % 60, false));
    ASSERT_EQ(wrong_pixels(raster), 0) << "fan " << i;
  }
}

TEST(FillRule, EveryInstructionSet) {
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    RasterFixture raster(131, 97, 1, kernels_of<constant_kernel>, adding());
    EXPECT_EQ(raster.backend().info().renderer, std::string("CPU, ") + hwy::TargetName(target));
    Fan fan(9);
    for (int i = 0; i < 40; ++i) {
      raster.draw(fan.around(fan.uniform(-1, 1), fan.uniform(-1, 1), 1.25F, i, false));
      ASSERT_EQ(wrong_pixels(raster), 0) << hwy::TargetName(target) << ", fan " << i;
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(FillRule, SharedVerticesOnPixelCentresAndEdges) {
  // Corners on pixel centres (odd sixteenths of a 16 pixel image) and on pixel borders make every tie happen.
  RasterFixture raster(16, 16, 1, kernels_of<constant_kernel>, adding());
  Fan fan(3);
  for (int x = -16; x <= 16; ++x) {
    for (int y = -16; y <= 16; ++y) {
      raster.draw(fan.around(static_cast<float>(x) / 16, static_cast<float>(y) / 16, 1, 0, false));
      ASSERT_EQ(wrong_pixels(raster), 0) << x << ", " << y;
    }
  }
}

TEST(FillRule, SliversThinnerThanASubPixel) {
  RasterFixture raster(64, 64, 1, kernels_of<constant_kernel>, adding());
  Fan fan(11);
  for (int i = 0; i < 20; ++i) {
    raster.draw(fan.around(fan.uniform(-1, 1), fan.uniform(-1, 1), 1.01F, 2000, false));
    ASSERT_EQ(wrong_pixels(raster), 0) << "fan " << i;
  }
}

TEST(FillRule, PerspectiveAndClippingAtTheGuardBand) {
  RasterFixture raster(130, 70, 2, kernels_of<constant_kernel>, adding());
  Fan fan(5);
  for (int i = 0; i < 100; ++i) {
    // A reach of 1000 lies far outside of the guard band.
    raster.draw(fan.around(fan.uniform(-1, 1), fan.uniform(-1, 1), i % 2 == 0 ? 1000.0F : 3.0F, i % 7, true));
    ASSERT_EQ(wrong_pixels(raster), 0) << "fan " << i;
  }
}

TEST(Clip, NearPlaneCutsWhereDepthIsZero) {
  RasterFixture raster(64, 64, 1, kernels_of<constant_kernel>, adding());
  // A quad whose depth runs from -1 at the left to 1 at the right: only the right half is in front of the near plane.
  const TestVertex a{-1, -1, -1, 1}, b{1, -1, 1, 1}, c{1, 1, 1, 1}, d{-1, 1, -1, 1};
  raster.draw({a, b, c, a, c, d});
  const std::vector<float> image = raster.pixels();
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) ASSERT_EQ(raster.at(image, x, y, 0), x >= 32 ? 1 : 0) << x << ", " << y;
  }
}

TEST(Clip, VerticesBehindTheEye) {
  // The floor plane y = -1 seen by an eye at the origin that looks along +z, w = z: it fills the lower half.
  RasterFixture raster(64, 64, 1, kernels_of<varying_kernel>, adding());
  const auto floor_at = [](float x, float depth) { return TestVertex{x, -1, depth - 0.01F, depth, depth}; };
  const TestVertex a = floor_at(-1e3F, -5), b = floor_at(1e3F, -5), c = floor_at(1e3F, 400), d = floor_at(-1e3F, 400);
  raster.draw({a, b, c, a, c, d});
  const std::vector<float> image = raster.pixels();
  for (int y = 0; y < 64; ++y) {
    const double ndc = 1 - (y + 0.5) / 32;  // the depth seen there is -1 / ndc
    for (int x = 0; x < 64; ++x) {
      const double expected = ndc < -1.0 / 400 ? -1 / ndc : 0;
      ASSERT_NEAR(raster.at(image, x, y, 0), expected, 1e-4 * expected) << x << ", " << y;
    }
  }
}

TEST(Interpolation, PerspectiveCorrect) {
  RasterFixture raster(100, 100, 1, kernels_of<varying_kernel>, adding());
  // v = u at the corners of a quad whose w runs from 1 (left) to 5 (right): v / w is affine on the screen.
  const TestVertex a = at_ndc(-1, -1, 0, 1), b = at_ndc(1, -1, 1, 5), c = at_ndc(1, 1, 1, 5), d = at_ndc(-1, 1, 0, 1);
  raster.draw({a, b, c, a, c, d});
  const std::vector<float> image = raster.pixels();
  for (int x = 0; x < 100; ++x) {
    const double t = (x + 0.5) / 100;
    const double expected = (t / 5) / ((1 - t) + t / 5);
    for (int y = 0; y < 100; ++y) ASSERT_NEAR(raster.at(image, x, y, 0), expected, 2e-6);
  }
}

TEST(Cull, CounterClockwiseIsFront) {
  PipelineDesc pipeline = adding();
  pipeline.cull = Cull::Back;
  RasterFixture raster(8, 8, 1, kernels_of<constant_kernel>, pipeline);
  const TestVertex a = at_ndc(-3, -1), b = at_ndc(3, -1), c = at_ndc(0, 5);
  raster.draw({a, b, c});
  EXPECT_EQ(wrong_pixels(raster), 0);
  raster.draw({a, c, b});
  EXPECT_EQ(wrong_pixels(raster), 64);
}

}  // namespace
}  // namespace volumark
