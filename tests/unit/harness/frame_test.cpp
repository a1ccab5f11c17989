// Texels of targets as images.
#include "harness/frame.h"

#include <gtest/gtest.h>

#include "backends/texel.h"

namespace volumark {
namespace {

TEST(DecodeImage, EveryTargetFormat) {
  for (const Format format : {Format::RGBA32F, Format::RGBA16F, Format::RGBA8}) {
    std::vector<std::byte> texels(2 * texel_bytes(format));
    encode_texel(format, {0.25F, 0.5F, 0.75F, 1}, texels.data());
    encode_texel(format, {1, 0, 0, 0.5F}, texels.data() + texel_bytes(format));
    const Image image = decode_image(format, 2, 1, texels);
    const float tolerance = format == Format::RGBA8 ? 0.5001F / 255 : 1e-6F;
    EXPECT_NEAR(image.pixel(0, 0)[1], 0.5F, tolerance) << to_string(format);
    EXPECT_NEAR(image.pixel(0, 0)[2], 0.75F, tolerance) << to_string(format);
    EXPECT_NEAR(image.pixel(1, 0)[0], 1, tolerance) << to_string(format);
    EXPECT_NEAR(image.pixel(1, 0)[3], 0.5F, tolerance) << to_string(format);
  }
}

}  // namespace
}  // namespace volumark
