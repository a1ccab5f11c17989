#include "methods/volume/sample_gradients.h"

#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>

namespace volumark {

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

SampleGradients::SampleGradients(const Scene& scene, std::span<const float> values)
    : values_(values),
      size_(scene.volume->size),
      per_world_(0.5 / scene.volume->spacing),
      floor_(gradient_floor(scene.effects.lighting.value_or(Lighting{}), scene.transfer, *scene.volume) /
             (scene.transfer.hi - scene.transfer.lo)) {}

// From the sample before to the one after, each clamped to the lattice.
double SampleGradients::difference(size_t here, size_t stride, int index, int size) const {
  const float after = values_[index + 1 < size ? here + stride : here];
  return static_cast<double>(after - values_[index > 0 ? here - stride : here]);
}

glm::dvec3 SampleGradients::gradient(int i, int j, int k) const {
  const size_t row = static_cast<size_t>(size_.x), slice = row * static_cast<size_t>(size_.y);
  const auto here = static_cast<size_t>(k) * slice + static_cast<size_t>(j) * row + static_cast<size_t>(i);
  return per_world_ * glm::dvec3(difference(here, 1, i, size_.x), difference(here, row, j, size_.y),
                                 difference(here, slice, k, size_.z));
}

glm::dvec3 SampleGradients::normal(int i, int j, int k) const {
  const glm::dvec3 g = gradient(i, j, k);
  return g * (-1 / std::max(glm::length(g), floor_));
}

}  // namespace volumark
