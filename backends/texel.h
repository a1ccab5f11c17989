// Texels as bytes: one colour or depth/stencil value written in a Format, and read back as floats. Host side of every
// backend's uploads, clears and tests; not for inner loops.
#pragma once

#include <array>
#include <span>

#include "backends/types.h"

namespace volumark {

// IEEE half precision, round to nearest even; overflow becomes infinity, NaN stays NaN.
uint16_t half_from_float(float value);
float float_from_half(uint16_t half);

// One texel of a colour format; 8- and 16-bit channels are clamped to [0, 1] and rounded to nearest (NaN becomes 0).
void encode_texel(Format format, const std::array<float, 4>& rgba, std::byte* out);
// Missing channels are 0, missing alpha is 1.
std::array<float, 4> decode_texel(Format format, const std::byte* in);

void fill_texels(Format format, const std::array<float, 4>& rgba, std::span<std::byte> out);
void fill_depth_stencil(float depth, uint8_t stencil, std::span<std::byte> out);

}  // namespace volumark
