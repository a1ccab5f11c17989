// What a fragment kernel is handed: a pixel at most once a batch, in drawing order, aligned and padded arrays.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <random>
#include <set>

#include "raster_fixture.h"

namespace volumark {
namespace {

struct Seen {
  int batches = 0, fragments = 0, recurring = 0, misaligned = 0, bad_padding = 0, too_large = 0;
};
Seen seen;  // the tests below use one thread

bool aligned(const void* address) { return reinterpret_cast<uintptr_t>(address) % 64 == 0; }

void inspect(const CpuBindings& bindings, FragmentBatch& batch) {
  ++seen.batches;
  seen.fragments += static_cast<int>(batch.count);
  seen.too_large += batch.count > kMaxBatch ? 1 : 0;
  std::set<std::pair<float, float>> pixels;
  for (size_t i = 0; i < batch.count; ++i) pixels.emplace(batch.x[i], batch.y[i]);
  seen.recurring += static_cast<int>(batch.count - pixels.size());
  for (const float* array : {batch.x, batch.y, batch.z, batch.varyings[0]}) {
    seen.misaligned += aligned(array) ? 0 : 1;
    for (size_t i = batch.count; i % kBatchPadding != 0; ++i) seen.bad_padding += std::isfinite(array[i]) ? 0 : 1;
  }
  for (float* array : batch.rgba) {
    seen.misaligned += aligned(array) ? 0 : 1;
    for (size_t i = batch.count; i % kBatchPadding != 0; ++i) array[i] = NAN;  // may be written, must not be seen
  }
  varying_kernel(bindings, batch);
}

std::vector<TestVertex> quad(float x0, float y0, float x1, float y1, float v) {
  const TestVertex a = at_ndc(x0, y0, v), b = at_ndc(x1, y0, v), c = at_ndc(x1, y1, v), d = at_ndc(x0, y1, v);
  return {a, b, c, a, c, d};
}

TEST(Batches, APixelAtMostOnceAndEverythingInOrder) {
  PipelineDesc pipeline;
  pipeline.blend = Blend::Opaque;  // the last one drawn stays
  RasterFixture raster(64, 48, 1, kernels_of<inspect>, pipeline);
  std::mt19937 random(2);
  std::uniform_real_distribution<float> place(-1, 1), size(0.02F, 0.4F);
  std::vector<TestVertex> vertices;
  std::vector<std::array<float, 5>> boxes;
  for (int i = 0; i < 3000; ++i) {
    const float x = place(random), y = place(random), w = size(random), h = size(random);
    boxes.push_back({x, y, x + w, y + h, static_cast<float>(i + 1)});
    std::ranges::copy(quad(x, y, x + w, y + h, static_cast<float>(i + 1)), std::back_inserter(vertices));
  }
  seen = {};
  raster.draw(vertices);
  EXPECT_EQ(seen.recurring, 0);
  EXPECT_EQ(seen.misaligned, 0);
  EXPECT_EQ(seen.bad_padding, 0);
  EXPECT_EQ(seen.too_large, 0);
  EXPECT_GT(seen.fragments, 10 * seen.batches);  // small polygons share batches
  // The painter's answer: the last box over each pixel centre; centres within a sub-pixel of an edge may go either way.
  const std::vector<float> image = raster.pixels();
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const float px = (static_cast<float>(x) + 0.5F) / 32 - 1, py = 1 - (static_cast<float>(y) + 0.5F) / 24;
      float expected = 0;
      bool near_an_edge = false;
      for (const auto& [x0, y0, x1, y1, v] : boxes) {
        if (px > x0 && px < x1 && py > y0 && py < y1) expected = v, near_an_edge = false;
        const bool beside_x =
            std::min(std::abs(px - x0), std::abs(px - x1)) < 1e-4F && py > y0 - 1e-4F && py < y1 + 1e-4F;
        const bool beside_y =
            std::min(std::abs(py - y0), std::abs(py - y1)) < 1e-4F && px > x0 - 1e-4F && px < x1 + 1e-4F;
        near_an_edge |= beside_x || beside_y;
      }
      if (!near_an_edge) {
        ASSERT_EQ(raster.at(image, x, y, 0), expected) << x << ", " << y;
      }
    }
  }
}

TEST(Batches, AFullTileComesInFullBatches) {
  RasterFixture raster(64, 64, 1, kernels_of<inspect>);
  seen = {};
  raster.draw(quad(-1, -1, 1, 1, 1));
  EXPECT_EQ(seen.fragments, 64 * 64);
  EXPECT_LE(seen.batches, 4 * 5);
}

TEST(Batches, DepthIsTestedBeforeShadingWhereNothingDiscards) {
  PipelineDesc pipeline;
  pipeline.has_depth_stencil = pipeline.depth_test = pipeline.depth_write = true;
  RasterFixture raster(32, 32, 1, kernels_of<inspect>, pipeline);
  std::vector<TestVertex> vertices;
  for (const float z : {0.3F, 0.6F, 0.9F}) {  // front to back: two of three are hidden
    for (TestVertex vertex : quad(-1, -1, 1, 1, z)) {
      vertex.z = z;
      vertices.push_back(vertex);
    }
  }
  seen = {};
  raster.draw(vertices);
  EXPECT_EQ(seen.fragments, 32 * 32);
  EXPECT_NEAR(raster.pixels()[0], 0.3F, 1e-6F);
}

}  // namespace
}  // namespace volumark
