// The image has the same bits for any number of threads.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "raster_fixture.h"

namespace volumark {
namespace {

// An order-dependent colour: rounding shows every change of order.
void tinted(const CpuBindings&, FragmentBatch& batch) {
  for (size_t i = 0; i < batch.count; ++i) {
    const float v = batch.varyings[0][i];
    const float alpha = 0.1F + 0.5F * std::abs(std::sin(v * 40 + batch.x[i]));
    for (int c = 0; c < 3; ++c) batch.rgba[c][i] = alpha * std::abs(std::cos(v * static_cast<float>(c + 3)));
    batch.rgba[3][i] = alpha;
    if (std::sin(v * 91 + batch.y[i]) > 0.8F) batch.discard[i] = 1;
  }
}

std::vector<TestVertex> soup(int triangles) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-1.2F, 1.2F), depth(0, 1), w(0.5F, 3), size(-0.3F, 0.3F);
  std::vector<TestVertex> vertices;
  for (int i = 0; i < triangles; ++i) {
    const float x = place(random), y = place(random);
    for (int k = 0; k < 3; ++k) {
      vertices.push_back(at_ndc(x + size(random), y + size(random), depth(random), w(random), depth(random)));
    }
  }
  return vertices;
}

std::vector<std::byte> image_with(int threads, Format format, bool depth) {
  PipelineDesc pipeline;
  pipeline.blend = Blend::Over;
  pipeline.colour_format = format;
  pipeline.has_depth_stencil = depth;
  pipeline.depth_test = pipeline.depth_write = depth;
  RasterFixture raster(301, 203, threads, kernels_of<tinted, true>, pipeline);
  raster.draw(soup(1500));
  return raster.bytes(texel_bytes(format));
}

TEST(Threads, SameBitsForAnyNumber) {
  for (const Format format : {Format::RGBA32F, Format::RGBA16F, Format::RGBA8}) {
    for (const bool depth : {false, true}) {
      const std::vector<std::byte> one = image_with(1, format, depth);
      EXPECT_TRUE(std::ranges::any_of(one, [](std::byte b) { return b != std::byte{0}; }));
      for (const int threads : {2, 3, 7}) {
        EXPECT_EQ(image_with(threads, format, depth), one) << to_string(format) << ", " << threads << " threads";
      }
    }
  }
}

TEST(Threads, TheBackendSaysHowMany) {
  DeviceOptions options;
  options.threads = 3;
  EXPECT_EQ(make_cpu_backend(options)->info().threads, 3);
  options.threads = -1;
  EXPECT_THROW(make_cpu_backend(options), DeviceError);
}

}  // namespace
}  // namespace volumark
