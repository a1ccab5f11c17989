// The 8-bit data of the effect fixed_point: palette, texels of the transfer window, stored normals.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "methods/volume/fixed_point.h"
#include "methods/volume/sample_gradients.h"

namespace volumark {
namespace {

// To nearest: floor(255 v + 1/2), by half levels. NaN becomes 0.
uint8_t level_of(double unit) {
  if (!(unit > 0)) return 0;
  const int half_levels = static_cast<int>(std::min(unit, 1.) * 510);
  return static_cast<uint8_t>((half_levels + 1) / 2);
}

// As the programs multiply levels (fixed_point.glsl).
uint8_t product(int a, int b) {
  const int p = a * b;
  return static_cast<uint8_t>((p + (p >> 8) + 128) >> 8);
}

}  // namespace

std::vector<uint8_t> fixed_palette(const Scene& scene, const FixedSettings& settings) {
  const TransferFunction& transfer = scene.transfer;
  std::vector<uint8_t> palette;
  for (int level = 0; level < 256; ++level) {
    const glm::dvec4 point = transfer.at(transfer.lo + (transfer.hi - transfer.lo) * level / 255);
    const double depth = point.a * settings.step;
    for (const double channel : {point.r, point.g, point.b}) palette.push_back(level_of(channel));
    palette.push_back(level_of(settings.linear_opacity ? depth : -std::expm1(-depth)));
  }
  return palette;
}

std::vector<uint8_t> fixed_texels(const Scene& scene, const FixedSettings& settings) {
  const std::vector<float> values = window_values(scene);
  std::vector<uint8_t> texels;
  if (settings.classification == Classification::Pre) {
    const std::vector<uint8_t> palette = fixed_palette(scene, settings);
    texels.reserve(values.size() * 4);
    for (const float value : values) {
      const uint8_t* entry = palette.data() + size_t{4} * level_of(static_cast<double>(value));
      for (int channel = 0; channel < 3; ++channel) texels.push_back(product(entry[channel], entry[3]));
      texels.push_back(entry[3]);
    }
    return texels;
  }
  if (!scene.effects.lighting) {
    texels.reserve(values.size());
    for (const float value : values) texels.push_back(level_of(static_cast<double>(value)));
    return texels;
  }
  // Normalised at the samples: the boards had no square root behind the filter.
  const SampleGradients gradients(scene, values);
  const glm::ivec3 size = scene.volume->size;
  texels.resize(values.size() * 4);
  size_t texel = 0;
  for (int k = 0; k < size.z; ++k) {
    for (int j = 0; j < size.y; ++j) {
      for (int i = 0; i < size.x; ++i, ++texel) {
        const glm::dvec3 normal = gradients.normal(i, j, k);
        for (int axis = 0; axis < 3; ++axis) {
          texels[4 * texel + static_cast<size_t>(axis)] = level_of(0.5 * normal[axis] + 0.5);
        }
        texels[4 * texel + 3] = level_of(static_cast<double>(values[texel]));
      }
    }
  }
  return texels;
}

}  // namespace volumark
