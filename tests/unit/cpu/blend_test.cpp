// Blending in every target format against the formulas in double, rounded to the format after every fragment.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "backends/texel.h"
#include "raster_fixture.h"

namespace volumark {
namespace {

// Fragment number n (its varying) has this premultiplied colour; large values show clamping.
std::array<float, 4> colour_of(int n) {
  const auto f = static_cast<float>(n);
  const float alpha = 0.05F + 0.9F * std::abs(std::sin(f * 1.7F));
  return {alpha * std::abs(std::sin(f)), alpha * std::abs(std::cos(f)) * 1.3F, alpha * 0.25F, alpha};
}
void numbered(const CpuBindings&, FragmentBatch& batch) {
  for (size_t i = 0; i < batch.count; ++i) {
    const auto colour = colour_of(static_cast<int>(std::lround(batch.varyings[0][i])));
    for (size_t c = 0; c < 4; ++c) batch.rgba[c][i] = colour[c];
  }
}

bool is_unorm(Format format) {
  return format == Format::R8 || format == Format::R16 || format == Format::RG8 || format == Format::RGBA8;
}

std::array<float, 4> rounded(Format format, const std::array<float, 4>& colour) {
  std::byte texel[16];
  encode_texel(format, colour, texel);
  return decode_texel(format, texel);
}

std::array<float, 4> blended(Format format, Blend blend, std::array<float, 4> source, std::array<float, 4> target) {
  if (is_unorm(format)) {
    for (float& c : source) c = std::clamp(c, 0.0F, 1.0F);
  }
  std::array<float, 4> result{};
  for (size_t c = 0; c < 4; ++c) {
    const double s = source[c], t = target[c];
    const double value = blend == Blend::Opaque ? s
                         : blend == Blend::Add  ? t + s
                         : blend == Blend::Over ? s + (1 - static_cast<double>(source[3])) * t
                                                : t + (1 - static_cast<double>(target[3])) * s;
    result[c] = static_cast<float>(value);
  }
  return rounded(format, result);
}

TEST(Blend, EveryFormatAndModeAgainstTheFormulas) {
  for (const Format format : {Format::R8, Format::R16, Format::R16F, Format::R32F, Format::RG8, Format::RGBA8,
                              Format::RGBA16F, Format::RGBA32F}) {
    for (const Blend blend : {Blend::Opaque, Blend::Over, Blend::Under, Blend::Add}) {
      PipelineDesc pipeline;
      pipeline.blend = blend;
      pipeline.colour_format = format;
      RasterFixture raster(37, 5, 1, kernels_of<numbered>, pipeline);
      std::vector<TestVertex> vertices;
      std::array<float, 4> expected = rounded(format, {0, 0, 0, 0});
      for (int n = 1; n <= 12; ++n) {
        const auto v = static_cast<float>(n);
        vertices.insert(vertices.end(), {at_ndc(-3, -1, v), at_ndc(3, -1, v), at_ndc(0, 5, v)});
        expected = blended(format, blend, colour_of(n), expected);
      }
      raster.draw(vertices);
      const std::vector<std::byte> image = raster.bytes(texel_bytes(format));
      // One unit in the last place, for where float and double round to either side of a tie.
      const double ulp = format == Format::R16                                 ? 1.0 / 65535
                         : is_unorm(format)                                    ? 1.0 / 255
                         : format == Format::R16F || format == Format::RGBA16F ? 0x1p-8
                                                                               : 2e-6;
      for (size_t at = 0; at < image.size(); at += texel_bytes(format)) {
        const auto pixel = decode_texel(format, image.data() + at);
        for (size_t c = 0; c < 4; ++c) {
          ASSERT_NEAR(pixel[c], expected[c], ulp * 1.001)
              << to_string(format) << " blend " << static_cast<int>(blend) << " channel " << c;
        }
      }
    }
  }
}

TEST(Blend, UnormRoundsToNearest) {
  PipelineDesc pipeline;
  pipeline.colour_format = Format::RGBA8;
  RasterFixture raster(256, 1, 1, kernels_of<varying_kernel>, pipeline);
  // v runs over (i + .4) / 255 at the pixel centres: rounds down to i.
  const float slope = 256 / 255.0F / 2;
  const auto v = [&](float ndc, float offset) { return (ndc + 1) * slope + (offset - 0.5F) / 255; };
  for (const float offset : {0.4F, -0.4F}) {
    raster.draw({at_ndc(-1, -1, v(-1, offset)), at_ndc(3, -1, v(3, offset)), at_ndc(-1, 3, v(-1, offset))});
    const std::vector<std::byte> image = raster.bytes(4);
    for (size_t i = 0; i < 256; ++i) ASSERT_EQ(std::to_integer<size_t>(image[4 * i]), i) << offset;
  }
}

}  // namespace
}  // namespace volumark
