#include "methods/volume/gradient_texels.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "methods/volume/sample_gradients.h"
#include "methods/volume/volume_texels.h"

namespace volumark {
namespace {

Format format_of(const std::string& name) {
  return name == "rgba8" ? Format::RGBA8 : name == "rgba16f" ? Format::RGBA16F : Format::RGBA32F;
}
// The scalar format with channels of as many bits.
const char* channel_of(Format format) {
  return format == Format::RGBA8 ? "r8" : format == Format::RGBA16F ? "r16f" : "r32f";
}

// visit(index, vector) for every sample, x fastest.
template <class Visit>
void each_vector(const Scene& scene, const SampleGradients& gradients, bool normals, const Visit& visit) {
  const glm::ivec3 size = scene.volume->size;
  const double unit = 2 * smallest_spacing(*scene.volume);
  size_t index = 0;
  for (int k = 0; k < size.z; ++k) {
    for (int j = 0; j < size.y; ++j) {
      for (int i = 0; i < size.x; ++i, ++index) {
        visit(index, normals ? gradients.normal(i, j, k) : unit * gradients.gradient(i, j, k));
      }
    }
  }
}

// Copies the last of `channels` channels of `from` into the alpha of each texel.
void put_alpha(std::span<const std::byte> from, size_t channels, std::vector<std::byte>& texels, size_t channel) {
  const size_t stride = channels * channel, count = texels.size() / (4 * channel);
  for (size_t i = 0; i < count; ++i) {
    std::memcpy(texels.data() + i * 4 * channel + 3 * channel, from.data() + i * stride + stride - channel, channel);
  }
}

}  // namespace

GradientTexels gradient_texels(const Scene& scene, const GradientSettings& settings) {
  const std::vector<float> values = window_values(scene);
  const SampleGradients gradients(scene, values);
  GradientTexels out;
  out.format = format_of(settings.format);
  out.texels.resize(values.size() * texel_bytes(out.format));
  if (out.format == Format::RGBA8) {
    double largest = settings.normals ? 1 : 0;
    if (!settings.normals) {
      each_vector(scene, gradients, false, [&](size_t, const glm::dvec3& v) {
        largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
      });
    }
    if (largest == 0) largest = 1;
    out.scale = static_cast<float>(2 * largest);
    out.offset = static_cast<float>(-largest);
  }
  const double scale = 1. / out.scale, offset = -out.offset * scale;
  each_vector(scene, gradients, settings.normals, [&](size_t index, const glm::dvec3& v) {
    for (int axis = 0; axis < 3; ++axis)
      put_channel(out.texels, out.format, index * 4 + static_cast<size_t>(axis), v[axis] * scale + offset);
  });
  if (settings.alpha == GradientAlpha::None) return out;
  const bool opacity = settings.alpha == GradientAlpha::Opacity;
  VolumeSettings alpha;
  alpha.volume_format = channel_of(out.format);
  alpha.classification = opacity ? Classification::Pre : Classification::Post;
  const VolumeTexels source = volume_texels(scene, alpha);
  put_alpha(source.of(*scene.volume), opacity ? 4 : 1, out.texels, texel_bytes(out.format) / 4);
  out.value_origin = source.value_origin;
  out.value_scale = source.value_scale;
  return out;
}

}  // namespace volumark
