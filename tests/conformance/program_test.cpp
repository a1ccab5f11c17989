// Programs: uniforms, switches fixed at creation, discard.
#include "tests/conformance/fixture.h"

namespace volumark::conformance {
namespace {

constexpr std::array<float, 8> kColours{0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.8f};

struct SpecialCanvas : Canvas {
  SpecialCanvas() : Canvas(4, 2) {
    // The block lies at byte 256 of its buffer.
    std::vector<float> contents(64 + 8);
    std::copy(kColours.begin(), kColours.end(), contents.begin() + 64);
    colours = device.create_buffer({.label = "colours", .size = contents.size() * 4, .data = bytes_of(contents)});
  }
  std::vector<std::array<float, 4>> picture(int mode, int scale) {
    const auto made = pipeline(Kind::Special, {}, {{"kMode", mode}, {"kScale", scale}});
    begin();
    draw(made, screen({0, 0, 0, 0}), {bind_uniform(3, colours, 256, 32)});
    end();
    return read();
  }
  Buffer colours;
};

TEST(Programs, SpecialisationConstantsChooseTheBranch) {
  SpecialCanvas canvas;
  expect_texel(canvas.at(canvas.picture(0, 1), 1, 1), {0.1f, 0.2f, 0.3f, 0.4f});
  expect_texel(canvas.at(canvas.picture(1, 1), 1, 1), {0.5f, 0.6f, 0.7f, 0.8f});
  expect_texel(canvas.at(canvas.picture(1, 2), 1, 1), {1.0f, 1.2f, 1.4f, 1.6f});
}

TEST(Programs, Discard) {
  SpecialCanvas canvas;
  const auto texels = canvas.picture(2, 1);
  for (int x = 0; x < 4; ++x) {
    const std::array<float, 4> want = x & 1 ? std::array<float, 4>{} : std::array<float, 4>{0.1f, 0.2f, 0.3f, 0.4f};
    expect_texel(canvas.at(texels, x, 1), want);
  }
}

TEST(Programs, UniformUpdatesTakeEffectBetweenPasses) {
  SpecialCanvas canvas;
  const auto pipeline = canvas.pipeline(Kind::Special, {}, {{"kMode", 0}, {"kScale", 1}});
  const auto half = [&](float x0, float x1) {
    canvas.begin();
    canvas.draw(pipeline, rectangle(x0, -1, x1, 1, {}), {bind_uniform(3, canvas.colours, 256)});
    canvas.end();
  };
  half(-1, 0);
  canvas.pass.clear_colour = false;
  const std::array<float, 4> changed{9, 8, 7, 6};
  canvas.device.update_buffer(canvas.colours, 256, bytes_of(changed));  // after the first pass, before the second
  half(0, 1);
  const auto texels = canvas.read();
  expect_texel(canvas.at(texels, 0, 0), {0.1f, 0.2f, 0.3f, 0.4f});
  expect_texel(canvas.at(texels, 3, 0), changed);
}

TEST(Programs, SeveralDevicesDoNotDisturbEachOther) {
  SpecialCanvas one, two;
  const auto first = one.picture(0, 1);
  const auto second = two.picture(1, 1);
  const auto again = one.picture(0, 1);
  EXPECT_EQ(first, again);
  expect_texel(two.at(second, 0, 0), {0.5f, 0.6f, 0.7f, 0.8f});
}

}  // namespace
}  // namespace volumark::conformance
