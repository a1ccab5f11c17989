// One texel of any format to and from float, scalar code: the definition that the SIMD paths must agree with. UNORM
// rounds to nearest on store, half floats to nearest even. (backends/texel.h is for uploads and tests; this one is by
// format at compile time, for the tiles and the samplers.)
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "backends/cpu/cpu_program.h"
#include "backends/texel.h"

namespace volumark::cpu {

inline bool has_alpha(Format format) {
  return format == Format::RGBA8 || format == Format::RGBA16F || format == Format::RGBA32F;
}

namespace texel_detail {
template <class T>
T read(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof(value));
  return value;
}
}  // namespace texel_detail

template <Format format>
inline void decode_texel(const std::byte* at, float (&rgba)[4]) {
  using texel_detail::read;
  rgba[0] = rgba[1] = rgba[2] = 0;
  rgba[3] = 1;
  if constexpr (format == Format::R8) {
    rgba[0] = static_cast<float>(read<uint8_t>(at)) / 255.0F;
  } else if constexpr (format == Format::R16) {
    rgba[0] = static_cast<float>(read<uint16_t>(at)) / 65535.0F;
  } else if constexpr (format == Format::R16F) {
    rgba[0] = float_from_half(read<uint16_t>(at));
  } else if constexpr (format == Format::R32F) {
    rgba[0] = read<float>(at);
  } else if constexpr (format == Format::RG8) {
    rgba[0] = static_cast<float>(read<uint8_t>(at)) / 255.0F;
    rgba[1] = static_cast<float>(read<uint8_t>(at + 1)) / 255.0F;
  } else if constexpr (format == Format::RGBA8) {
    for (int c = 0; c < 4; ++c) rgba[c] = static_cast<float>(read<uint8_t>(at + c)) / 255.0F;
  } else if constexpr (format == Format::RGBA16F) {
    for (int c = 0; c < 4; ++c) rgba[c] = float_from_half(read<uint16_t>(at + 2 * c));
  } else {
    std::memcpy(rgba, at, sizeof(rgba));
  }
}

inline uint8_t unorm8(float value) {
  // The comparison is false for NaN, which becomes 0.
  return value > 0 ? static_cast<uint8_t>(std::lrintf(std::min(value, 1.0F) * 255.0F)) : uint8_t{0};
}

// Writes one texel of a colour format; channels that the format lacks are dropped.
inline void encode_texel(Format format, const float (&rgba)[4], std::byte* at) {
  const int channels = channel_count(format);
  for (int c = 0; c < channels; ++c) {
    switch (format) {
      case Format::R8:
      case Format::RG8:
      case Format::RGBA8:
        at[c] = static_cast<std::byte>(unorm8(rgba[c]));
        break;
      case Format::R16: {
        const float unit = rgba[c] > 0 ? std::min(rgba[c], 1.0F) : 0.0F;
        const auto value = static_cast<uint16_t>(std::lrintf(unit * 65535.0F));
        std::memcpy(at, &value, sizeof(value));
        break;
      }
      case Format::R16F:
      case Format::RGBA16F: {
        const uint16_t value = half_from_float(rgba[c]);
        std::memcpy(at + 2 * c, &value, sizeof(value));
        break;
      }
      default:
        std::memcpy(at + 4 * c, &rgba[c], sizeof(float));
        break;
    }
  }
}

// Texels at data + at[i] * texel_bytes, i < count, channel by channel.
template <Format format>
void decode_texels_of(const CpuTexture& texture, const int32_t* at, size_t count, float* r, float* g, float* b,
                      float* a) {
  constexpr ptrdiff_t kBytes = format == Format::R8                                                       ? 1
                               : format == Format::R16 || format == Format::R16F || format == Format::RG8 ? 2
                               : format == Format::R32F || format == Format::RGBA8                        ? 4
                               : format == Format::RGBA16F                                                ? 8
                                                                                                          : 16;
  for (size_t i = 0; i < count; ++i) {
    float rgba[4];
    decode_texel<format>(texture.data + at[i] * kBytes, rgba);
    r[i] = rgba[0];
    g[i] = rgba[1];
    b[i] = rgba[2];
    a[i] = rgba[3];
  }
}

inline void decode_texels(const CpuTexture& texture, const int32_t* at, size_t count, float* r, float* g, float* b,
                          float* a) {
  switch (texture.format) {
    case Format::R8:
      return decode_texels_of<Format::R8>(texture, at, count, r, g, b, a);
    case Format::R16:
      return decode_texels_of<Format::R16>(texture, at, count, r, g, b, a);
    case Format::R16F:
      return decode_texels_of<Format::R16F>(texture, at, count, r, g, b, a);
    case Format::R32F:
      return decode_texels_of<Format::R32F>(texture, at, count, r, g, b, a);
    case Format::RG8:
      return decode_texels_of<Format::RG8>(texture, at, count, r, g, b, a);
    case Format::RGBA8:
      return decode_texels_of<Format::RGBA8>(texture, at, count, r, g, b, a);
    case Format::RGBA16F:
      return decode_texels_of<Format::RGBA16F>(texture, at, count, r, g, b, a);
    default:
      return decode_texels_of<Format::RGBA32F>(texture, at, count, r, g, b, a);
  }
}

}  // namespace volumark::cpu
