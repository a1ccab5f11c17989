// Blending into each colour format, clears and loads. Bounds: float exact up to rounding; half 2^-10 of the value (Mesa
// truncates); 8 bits one step a layer.
#include <algorithm>
#include <cmath>

#include "tests/conformance/fixture.h"

namespace volumark::conformance {
namespace {

constexpr std::array<float, 4> kDestination{0.5f, 0.25f, 0.125f, 0.5f};
constexpr std::array<float, 4> kSource{0.25f, 0.125f, 0.0625f, 0.75f};

float blended(Blend blend, size_t c) {
  const float s = kSource[c], d = kDestination[c];
  switch (blend) {
    case Blend::Opaque:
      return s;
    case Blend::Over:
      return s + (1 - kSource[3]) * d;
    case Blend::Under:
      return d + (1 - kDestination[3]) * s;
    case Blend::Add:
      return d + s;
  }
  return 0;
}

float bound(Format format) {
  switch (format) {
    case Format::RGBA8:
      return 1.01f / 255;
    case Format::RGBA16F:
      return 1.01f / 1024;
    default:
      return 1e-6f;
  }
}

TEST(Blending, FormulasHoldInEveryTargetFormat) {
  for (const Format format : {Format::RGBA32F, Format::RGBA16F, Format::RGBA8}) {
    for (const Blend blend : {Blend::Opaque, Blend::Over, Blend::Under, Blend::Add}) {
      SCOPED_TRACE(std::string(to_string(format)) + " blend " + std::to_string(static_cast<int>(blend)));
      Canvas canvas(4, 4, format);
      const auto pipeline = canvas.pipeline(Kind::Flat, [&](PipelineDesc& desc) { desc.blend = blend; });
      canvas.pass.colour_value = kDestination;
      canvas.begin();
      canvas.draw(pipeline, screen(kSource));
      canvas.end();
      const auto texels = canvas.read();
      for (size_t c = 0; c < 4; ++c) {
        const float clamped = format == Format::RGBA8 ? std::min(blended(blend, c), 1.f) : blended(blend, c);
        EXPECT_NEAR(canvas.at(texels, 2, 1)[c], clamped, bound(format)) << "channel " << c;
      }
    }
  }
}

TEST(Blending, DrawsOfAPassBlendInOrder) {
  Canvas canvas(2, 2);
  const auto over = canvas.pipeline(Kind::Flat, [](PipelineDesc& desc) { desc.blend = Blend::Over; });
  canvas.begin();
  canvas.draw(over, screen({1, 0, 0, 1}));
  canvas.draw(over, screen({0, 0.5f, 0, 0.5f}));
  std::vector<Vertex> both = screen({0, 0, 0.25f, 0.25f});  // two layers in one draw
  const auto last = screen({0.125f, 0, 0, 0.5f});
  both.insert(both.end(), last.begin(), last.end());
  canvas.draw(over, both);
  canvas.end();
  expect_texel(canvas.at(canvas.read(), 1, 1), {0.375f * 0.5f + 0.125f, 0.1875f, 0.125f, 1});
}

TEST(Blending, ManyLayersInFloatKeepTheirSum) {
  Canvas canvas(4, 4);
  const auto over = canvas.pipeline(Kind::Flat, [](PipelineDesc& desc) { desc.blend = Blend::Over; });
  const int layers = 256;
  const float alpha = 1 - std::exp(-1.f / layers);
  std::vector<Vertex> all;
  for (int i = 0; i < layers; ++i) {
    const auto one = screen({alpha, alpha, alpha, alpha});
    all.insert(all.end(), one.begin(), one.end());
  }
  canvas.begin();
  canvas.draw(over, all);
  canvas.end();
  expect_texel(canvas.at(canvas.read(), 3, 3), {0.6321206f, 0.6321206f, 0.6321206f, 0.6321206f}, 5e-6f);
}

TEST(Blending, ValuesOutsideZeroToOne) {
  for (const Format format : {Format::RGBA32F, Format::RGBA16F, Format::RGBA8}) {
    Canvas canvas(2, 2, format);
    const auto pipeline = canvas.pipeline(Kind::Flat);
    canvas.begin();
    canvas.draw(pipeline, screen({-1, 2, 0.5f, 1}));
    canvas.end();
    const bool clamped = format == Format::RGBA8;
    expect_texel(canvas.at(canvas.read(), 0, 0), {clamped ? 0.f : -1.f, clamped ? 1.f : 2.f, 0.5f, 1}, bound(format));
  }
}

TEST(Blending, ColourWritesCanBeOff) {
  Canvas canvas(2, 2);
  const auto off = canvas.pipeline(Kind::Flat, [](PipelineDesc& desc) { desc.colour_write = false; });
  canvas.pass.colour_value = kDestination;
  canvas.begin();
  canvas.draw(off, screen(kSource));
  canvas.end();
  expect_texel(canvas.at(canvas.read(), 0, 0), kDestination);
}

TEST(Blending, APassKeepsWhatItDoesNotClear) {
  Canvas canvas(2, 2);
  const auto half = canvas.pipeline(Kind::Flat);
  canvas.pass.colour_value = kDestination;
  canvas.begin();
  canvas.end();
  canvas.pass.clear_colour = false;
  canvas.begin();
  canvas.draw(half, rectangle(-1, -1, 0, 1, kSource));
  canvas.end();
  const auto texels = canvas.read();
  expect_texel(canvas.at(texels, 0, 0), kSource);
  expect_texel(canvas.at(texels, 1, 0), kDestination);
}

TEST(Blending, SingleChannelTargets) {
  for (const Format format : {Format::R32F, Format::R16F, Format::R8}) {
    Canvas canvas(2, 2, format);
    const auto add = canvas.pipeline(Kind::Flat, [](PipelineDesc& desc) { desc.blend = Blend::Add; });
    canvas.begin();
    canvas.draw(add, screen({0.25f, 9, 9, 9}));
    canvas.draw(add, screen({0.5f, 9, 9, 9}));
    canvas.end();
    EXPECT_NEAR(canvas.at(canvas.read(), 0, 0)[0], 0.75f, format == Format::R8 ? 2.01f / 255 : 1e-3f)
        << to_string(format);
  }
}

}  // namespace
}  // namespace volumark::conformance
