#include "backends/texel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace volumark {
namespace {

TEST(Texel, EveryHalfSurvivesTheWayThroughFloat) {
  for (uint32_t half = 0; half < 0x10000; ++half) {
    const float value = float_from_half(static_cast<uint16_t>(half));
    if (std::isnan(value)) {
      EXPECT_TRUE(std::isnan(float_from_half(half_from_float(value))));
    } else {
      ASSERT_EQ(half_from_float(value), half) << value;
    }
  }
}

TEST(Texel, HalvesRoundToNearestEven) {
  EXPECT_EQ(half_from_float(1.f), 0x3c00);
  EXPECT_EQ(half_from_float(1.f + 0x1p-11f), 0x3c00);      // a tie, to even
  EXPECT_EQ(half_from_float(1.f + 3 * 0x1p-11f), 0x3c02);  // a tie, to even
  EXPECT_EQ(half_from_float(1.f + 0x1p-11f + 0x1p-20f), 0x3c01);
  EXPECT_EQ(half_from_float(65504.f), 0x7bff);
  EXPECT_EQ(half_from_float(65519.f), 0x7bff);
  EXPECT_EQ(half_from_float(65520.f), 0x7c00);
  EXPECT_EQ(half_from_float(0x1p-24f), 0x0001);
  EXPECT_EQ(half_from_float(0x1p-25f), 0x0000);  // a tie, to even
  EXPECT_EQ(half_from_float(-0.f), 0x8000);
}

TEST(Texel, UnormsClampAndRound) {
  std::byte texel[16];
  encode_texel(Format::RGBA8, {-1, 2, 0.5f, std::numeric_limits<float>::quiet_NaN()}, texel);
  EXPECT_EQ(decode_texel(Format::RGBA8, texel), (std::array<float, 4>{0, 1, 128 / 255.f, 0}));
  encode_texel(Format::R16, {1.f / 65535, 0, 0, 0}, texel);
  EXPECT_EQ(decode_texel(Format::R16, texel), (std::array<float, 4>{1.f / 65535, 0, 0, 1}));
}

TEST(Texel, EveryFormatReadsWhatItWrote) {
  for (const Format format : {Format::R8, Format::R16, Format::R16F, Format::R32F, Format::RG8, Format::RGBA8,
                              Format::RGBA16F, Format::RGBA32F}) {
    std::byte texel[16];
    encode_texel(format, {1, 0, 1, 0}, texel);
    const int channels = channel_count(format);
    EXPECT_EQ(decode_texel(format, texel),
              (std::array<float, 4>{1, 0, channels == 4 ? 1.f : 0.f, channels == 4 ? 0.f : 1.f}));
  }
}

}  // namespace
}  // namespace volumark
