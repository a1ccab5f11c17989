#include "backends/texel.h"

#include <cmath>
#include <cstring>

namespace volumark {
namespace {

template <class T>
T load(const std::byte* in, int channel) {
  T value;
  std::memcpy(&value, in + static_cast<size_t>(channel) * sizeof(T), sizeof(T));
  return value;
}
template <class T>
void store(std::byte* out, int channel, T value) {
  std::memcpy(out + static_cast<size_t>(channel) * sizeof(T), &value, sizeof(T));
}

float unorm(float value, float largest) {
  if (!(value > 0)) return 0;  // also NaN
  return std::nearbyint(std::fmin(value, 1.f) * largest);
}

enum class Channel { Unorm8, Unorm16, Half, Float };
Channel channel_type(Format format) {
  switch (format) {
    case Format::R8:
    case Format::RG8:
    case Format::RGBA8:
      return Channel::Unorm8;
    case Format::R16:
      return Channel::Unorm16;
    case Format::R16F:
    case Format::RGBA16F:
      return Channel::Half;
    default:
      return Channel::Float;
  }
}

}  // namespace

void encode_texel(Format format, const std::array<float, 4>& rgba, std::byte* out) {
  for (int c = 0; c < channel_count(format); ++c) {
    const float value = rgba[static_cast<size_t>(c)];
    switch (channel_type(format)) {
      case Channel::Unorm8:
        store(out, c, static_cast<uint8_t>(unorm(value, 255)));
        break;
      case Channel::Unorm16:
        store(out, c, static_cast<uint16_t>(unorm(value, 65535)));
        break;
      case Channel::Half:
        store(out, c, half_from_float(value));
        break;
      case Channel::Float:
        store(out, c, value);
        break;
    }
  }
}

std::array<float, 4> decode_texel(Format format, const std::byte* in) {
  std::array<float, 4> rgba{0, 0, 0, 1};
  for (int c = 0; c < channel_count(format); ++c) {
    float& value = rgba[static_cast<size_t>(c)];
    switch (channel_type(format)) {
      case Channel::Unorm8:
        value = static_cast<float>(load<uint8_t>(in, c)) / 255.f;
        break;
      case Channel::Unorm16:
        value = static_cast<float>(load<uint16_t>(in, c)) / 65535.f;
        break;
      case Channel::Half:
        value = float_from_half(load<uint16_t>(in, c));
        break;
      case Channel::Float:
        value = load<float>(in, c);
        break;
    }
  }
  return rgba;
}

void fill_texels(Format format, const std::array<float, 4>& rgba, std::span<std::byte> out) {
  std::byte texel[16];
  encode_texel(format, rgba, texel);
  const size_t step = texel_bytes(format);
  for (size_t at = 0; at + step <= out.size(); at += step) std::memcpy(out.data() + at, texel, step);
}

void fill_depth_stencil(float depth, uint8_t stencil, std::span<std::byte> out) {
  const uint32_t word = stencil;
  for (size_t at = 0; at + 8 <= out.size(); at += 8) {
    std::memcpy(out.data() + at, &depth, 4);
    std::memcpy(out.data() + at + 4, &word, 4);
  }
}

}  // namespace volumark
