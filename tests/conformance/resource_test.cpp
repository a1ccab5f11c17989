// Buffers, limits, exhaustion, zones and what a backend says of itself.
#include <algorithm>

#include "tests/conformance/fixture.h"

namespace volumark::conformance {
namespace {

TEST(Resources, BuffersReadBackAsWritten) {
  Canvas canvas(2, 2);
  std::vector<uint32_t> words(1000);
  for (uint32_t i = 0; i < words.size(); ++i) words[i] = i * 2654435761u;
  const Buffer buffer = canvas.device.create_buffer({.label = "words", .size = 4000, .data = bytes_of(words)});
  const std::vector<uint32_t> patch = {1, 2, 3};
  canvas.device.update_buffer(buffer, 400, bytes_of(patch));
  std::copy(patch.begin(), patch.end(), words.begin() + 100);
  const auto all = bytes_of(words);
  EXPECT_EQ(canvas.device.read_buffer(buffer, 0, 4000), std::vector<std::byte>(all.begin(), all.end()));
  EXPECT_EQ(canvas.device.read_buffer(buffer, 396, 12), std::vector<std::byte>(all.begin() + 396, all.begin() + 408));
  const Buffer empty = canvas.device.create_buffer({.label = "empty", .size = 64, .data = {}});
  for (const std::byte byte : canvas.device.read_buffer(empty, 0, 64)) EXPECT_EQ(byte, std::byte{0});
}

TEST(Resources, WhatExceedsTheLimitsIsRefusedAndTheDeviceLivesOn) {
  Canvas canvas(2, 2);
  const int largest = canvas.device.info().limits.texture_3d;
  EXPECT_GE(largest, 256);
  expect_refused(DeviceErrorKind::LimitExceeded, "create_texture", [&] {
    canvas.device.create_texture({.label = "long", .dimension = 3, .format = Format::R8, .width = largest + 1});
  });
  const auto flat = canvas.pipeline(Kind::Flat);
  canvas.begin();
  canvas.draw(flat, screen({1, 2, 3, 4}));
  canvas.end();
  expect_texel(canvas.at(canvas.read(), 1, 1), {1, 2, 3, 4});
}

TEST(Resources, ExhaustionIsAnErrorAndTheDeviceLivesOn) {
  Canvas canvas(2, 2);
  const size_t before = canvas.device.live_bytes();
  expect_refused(DeviceErrorKind::OutOfMemory, "create_buffer",
                 [&] { canvas.device.create_buffer({.label = "1 PiB", .size = size_t{1} << 50, .data = {}}); });
  EXPECT_EQ(canvas.device.live_bytes(), before);
  const int n = std::min(2048, canvas.device.info().limits.texture_3d);
  if (canvas.device.info().software) {  // 128 GiB: more than such a machine has; a real GPU may have it
    expect_refused(DeviceErrorKind::OutOfMemory, "create_texture", [&] {
      canvas.device.create_texture(
          {.label = "128 GiB", .dimension = 3, .format = Format::RGBA32F, .width = n, .height = n, .depth = n});
    });
  }
  const auto flat = canvas.pipeline(Kind::Flat);
  canvas.begin();
  canvas.draw(flat, screen({1, 2, 3, 4}));
  canvas.end();
  expect_texel(canvas.at(canvas.read(), 1, 1), {1, 2, 3, 4});
}

TEST(Resources, MemoryIsCountedAndGivenBack) {
  Canvas canvas(2, 2);
  const size_t before = canvas.device.live_bytes();
  for (int i = 0; i < 50; ++i) {
    const Texture texture = canvas.device.create_texture(
        {.label = "volume", .dimension = 3, .format = Format::R8, .width = 64, .height = 64, .depth = 64});
    EXPECT_EQ(canvas.device.live_bytes(), before + 64 * 64 * 64);
    canvas.device.destroy(texture);
  }
  EXPECT_EQ(canvas.device.live_bytes(), before);
  EXPECT_EQ(canvas.device.peak_bytes(), before + 64 * 64 * 64);
}

TEST(Resources, ObjectsMayDieBetweenRecordingAndSubmission) {
  Canvas canvas(2, 2);
  const auto flat = canvas.pipeline(Kind::Flat);
  const auto corners = screen({1, 2, 3, 4});
  const Buffer vertices = canvas.vertices(corners);
  DrawDesc draw;
  draw.pipeline = flat;
  draw.vertex_buffers = {vertices};
  draw.count = 6;
  canvas.begin();
  canvas.device.draw(draw);
  canvas.end();
  canvas.device.destroy(vertices);
  canvas.device.destroy(flat);
  expect_texel(canvas.at(canvas.read(), 1, 1), {1, 2, 3, 4});
}

TEST(Zones, AreReportedInOrderWithTheirTimes) {
  Canvas canvas(256, 256);
  const auto flat = canvas.pipeline(Kind::Flat, [](PipelineDesc& desc) { desc.blend = Blend::Over; });
  canvas.device.submit_and_wait();
  canvas.device.begin_zone("upload");
  canvas.device.end_zone();
  canvas.device.begin_zone("raster");
  canvas.begin();
  for (int i = 0; i < 20; ++i) canvas.draw(flat, screen({0, 0, 0, 0.5f}));
  canvas.end();
  canvas.device.end_zone();
  const auto zones = canvas.device.submit_and_wait();
  ASSERT_EQ(zones.size(), 2u);
  EXPECT_EQ(zones[0].name, "upload");
  EXPECT_EQ(zones[1].name, "raster");
  EXPECT_GT(zones[1].seconds, zones[0].seconds);
  EXPECT_LT(zones[1].seconds, 60);
  EXPECT_TRUE(canvas.device.submit_and_wait().empty());
}

TEST(Info, SaysWhatItIs) {
  Canvas canvas(2, 2);
  const BackendInfo& info = canvas.device.info();
  EXPECT_EQ(info.id, backend_id());
  for (const std::string& text : {info.api, info.vendor, info.renderer, info.version}) EXPECT_FALSE(text.empty());
  EXPECT_GE(info.threads, info.software ? 1 : 0);
  // Every capability is either there or absent with a reason.
  for (const Capability capability : kAllCapabilities) {
    const bool there = canvas.device.has(capability);
    const bool absent = std::ranges::any_of(
        info.absent, [&](const auto& entry) { return entry.first == capability && !entry.second.empty(); });
    EXPECT_NE(there, absent) << to_string(capability);
  }
}

}  // namespace
}  // namespace volumark::conformance
