// The 8-bit data of the effect fixed_point: palette, texels of the transfer window, stored normals.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "methods/volume/fixed_point.h"

namespace volumark {
namespace {

uint8_t level_of(double unit) { return static_cast<uint8_t>(std::lround(std::clamp(unit, 0., 1.) * 255)); }

// As the programs multiply levels (fixed_point.glsl).
uint8_t product(int a, int b) {
  const int p = a * b;
  return static_cast<uint8_t>((p + (p >> 8) + 128) >> 8);
}

// Data values in widths of the transfer window.
std::vector<float> window_values(const Scene& scene) {
  const Volume& volume = *scene.volume;
  const double lo = scene.transfer.lo, width = scene.transfer.hi - lo;
  std::vector<float> values;
  values.reserve(static_cast<size_t>(volume.size.x) * static_cast<size_t>(volume.size.y) *
                 static_cast<size_t>(volume.size.z));
  for (int k = 0; k < volume.size.z; ++k) {
    for (int j = 0; j < volume.size.y; ++j) {
      for (int i = 0; i < volume.size.x; ++i) values.push_back(static_cast<float>((volume.at(i, j, k) - lo) / width));
    }
  }
  return values;
}

// Normals of scenes/scene.h, at the samples and normalised there: the boards had no square root behind the filter.
class Normals {
 public:
  Normals(const Scene& scene, const std::vector<float>& values)
      : values_(values),
        size_(scene.volume->size),
        per_world_(0.5 / scene.volume->spacing),
        floor_(gradient_floor(*scene.effects.lighting, scene.transfer, *scene.volume) /
               (scene.transfer.hi - scene.transfer.lo)) {}

  glm::dvec3 at(int i, int j, int k) const {
    const glm::dvec3 difference(value(i + 1, j, k) - value(i - 1, j, k), value(i, j + 1, k) - value(i, j - 1, k),
                                value(i, j, k + 1) - value(i, j, k - 1));
    const glm::dvec3 gradient = difference * per_world_;
    return -gradient / std::max(glm::length(gradient), floor_);
  }

 private:
  double value(int i, int j, int k) const {
    const glm::ivec3 p = glm::clamp(glm::ivec3(i, j, k), glm::ivec3(0), size_ - 1);
    return static_cast<double>(
        values_[(static_cast<size_t>(p.z) * static_cast<size_t>(size_.y) + static_cast<size_t>(p.y)) *
                    static_cast<size_t>(size_.x) +
                static_cast<size_t>(p.x)]);
  }

  const std::vector<float>& values_;
  glm::ivec3 size_;
  glm::dvec3 per_world_;
  double floor_;
};

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
  const Normals normals(scene, values);
  const glm::ivec3 size = scene.volume->size;
  texels.reserve(values.size() * 4);
  for (int k = 0; k < size.z; ++k) {
    for (int j = 0; j < size.y; ++j) {
      for (int i = 0; i < size.x; ++i) {
        const glm::dvec3 normal = normals.at(i, j, k);
        for (int axis = 0; axis < 3; ++axis) texels.push_back(level_of(0.5 * normal[axis] + 0.5));
        texels.push_back(level_of(static_cast<double>(values[texels.size() / 4])));
      }
    }
  }
  return texels;
}

}  // namespace volumark
