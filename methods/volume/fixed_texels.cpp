// The 8-bit data of the effect fixed_point: palette, texels of the transfer window, stored normals.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "methods/volume/fixed_point.h"

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

// Data values in widths of the transfer window.
std::vector<float> window_values(const Scene& scene) {
  const Volume& volume = *scene.volume;
  const size_t count =
      static_cast<size_t>(volume.size.x) * static_cast<size_t>(volume.size.y) * static_cast<size_t>(volume.size.z);
  const double width = scene.transfer.hi - scene.transfer.lo;
  const double slope = volume.slope / width, intercept = (volume.intercept - scene.transfer.lo) / width;
  std::vector<float> values(count);
  const auto convert = [&](auto stored) {
    for (size_t i = 0; i < count; ++i) {
      std::memcpy(&stored, volume.voxels.data() + i * sizeof(stored), sizeof(stored));
      values[i] = static_cast<float>(static_cast<double>(stored) * slope + intercept);
    }
  };
  switch (volume.type) {
    case VoxelType::U8:
      convert(uint8_t{});
      break;
    case VoxelType::U16:
      convert(uint16_t{});
      break;
    case VoxelType::I16:
      convert(int16_t{});
      break;
    case VoxelType::F32:
      convert(float{});
      break;
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
    const size_t row = static_cast<size_t>(size_.x), slice = row * static_cast<size_t>(size_.y);
    const auto here = static_cast<size_t>(k) * slice + static_cast<size_t>(j) * row + static_cast<size_t>(i);
    const glm::dvec3 gradient =
        per_world_ * glm::dvec3(difference(here, 1, i, size_.x), difference(here, row, j, size_.y),
                                difference(here, slice, k, size_.z));
    return gradient * (-1 / std::max(glm::length(gradient), floor_));
  }

 private:
  // From the sample before to the one after, each clamped to the lattice.
  double difference(size_t here, size_t stride, int index, int size) const {
    const float after = values_[index + 1 < size ? here + stride : here];
    return static_cast<double>(after - values_[index > 0 ? here - stride : here]);
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
  texels.resize(values.size() * 4);
  size_t texel = 0;
  for (int k = 0; k < size.z; ++k) {
    for (int j = 0; j < size.y; ++j) {
      for (int i = 0; i < size.x; ++i, ++texel) {
        const glm::dvec3 normal = normals.at(i, j, k);
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
