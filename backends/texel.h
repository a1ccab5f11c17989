// Texels as bytes: one colour or depth/stencil value written in a Format, and read back as floats. Host side of every
// backend's uploads, clears and tests; not for inner loops.
#pragma once

#include <array>
#include <bit>
#include <span>

#include "backends/types.h"

namespace volumark {

// IEEE half precision, round to nearest even; overflow becomes infinity, NaN stays NaN.
inline float float_from_half(uint16_t half) {
  const uint32_t sign = static_cast<uint32_t>(half & 0x8000U) << 16;
  const uint32_t magnitude = half & 0x7fffU;
  if (magnitude >= 0x7c00U) {  // infinity and NaN
    return std::bit_cast<float>(sign | 0x7f800000U | ((magnitude & 0x3ffU) << 13));
  }
  // Shifted into place the exponent is 112 too small; the product corrects it, for subnormal numbers too.
  const float scaled = std::bit_cast<float>(magnitude << 13) * 0x1p112F;
  return std::bit_cast<float>(sign | std::bit_cast<uint32_t>(scaled));
}

inline uint16_t half_from_float(float value) {
  const auto bits = std::bit_cast<uint32_t>(value);
  const auto sign = static_cast<uint16_t>((bits >> 16) & 0x8000U);
  const uint32_t magnitude = bits & 0x7fffffffU;
  if (magnitude > 0x7f800000U) {
    return static_cast<uint16_t>(sign | 0x7e00U);
  }
  if (magnitude >= 0x477ff000U) {  // rounds to 65536 or more
    return static_cast<uint16_t>(sign | 0x7c00U);
  }
  if (magnitude < 0x38800000U) {  // subnormal: adding 0.5 lets the float unit round at 2^-24
    const float shifted = std::bit_cast<float>(magnitude) + 0.5F;
    return static_cast<uint16_t>(sign | (std::bit_cast<uint32_t>(shifted) - 0x3f000000U));
  }
  const uint32_t rounded = magnitude + 0xfffU + ((magnitude >> 13) & 1U);
  return static_cast<uint16_t>(sign | ((rounded - 0x38000000U) >> 13));
}

// One texel of a colour format; 8- and 16-bit channels are clamped to [0, 1] and rounded to nearest (NaN becomes 0).
void encode_texel(Format format, const std::array<float, 4>& rgba, std::byte* out);
// Missing channels are 0, missing alpha is 1.
std::array<float, 4> decode_texel(Format format, const std::byte* in);

void fill_texels(Format format, const std::array<float, 4>& rgba, std::span<std::byte> out);
void fill_depth_stencil(float depth, uint8_t stencil, std::span<std::byte> out);

}  // namespace volumark
