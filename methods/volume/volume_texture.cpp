// The volume as texels: native formats go up as they are stored, without a copy; the others are converted once.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "backends/defects.h"
#include "methods/volume/volume_texels.h"

namespace volumark {
namespace {

size_t voxel_count(const Volume& volume) {
  return static_cast<size_t>(volume.size.x) * static_cast<size_t>(volume.size.y) * static_cast<size_t>(volume.size.z);
}

Format scalar_format(const std::string& name, VoxelType type) {
  if (name == "r8") return Format::R8;
  if (name == "r16") return Format::R16;
  if (name == "r16f") return Format::R16F;
  if (name == "r32f") return Format::R32F;
  return type == VoxelType::U8 ? Format::R8 : type == VoxelType::F32 ? Format::R32F : Format::R16;
}

Format classified_format(const std::string& name, VoxelType type) {
  switch (scalar_format(name, type)) {
    case Format::R8:
      return Format::RGBA8;
    case Format::R32F:
      return Format::RGBA32F;
    default:
      return Format::RGBA16F;
  }
}

// body(index, stored value as double) for every voxel.
template <class T, class Body>
void each_of(const Volume& volume, const Body& body) {
  const size_t count = voxel_count(volume);
  for (size_t i = 0; i < count; ++i) {
    T value;
    std::memcpy(&value, volume.voxels.data() + i * sizeof(T), sizeof(T));
    body(i, static_cast<double>(value));
  }
}
template <class Body>
void each_voxel(const Volume& volume, const Body& body) {
  switch (volume.type) {
    case VoxelType::U8:
      return each_of<uint8_t>(volume, body);
    case VoxelType::U16:
      return each_of<uint16_t>(volume, body);
    case VoxelType::I16:
      return each_of<int16_t>(volume, body);
    case VoxelType::F32:
      return each_of<float>(volume, body);
  }
}

template <class T>
void put(std::vector<std::byte>& texels, size_t index, T value) {
  std::memcpy(texels.data() + index * sizeof(T), &value, sizeof(T));
}

// data value = stored * slope + intercept.
struct Line {
  double slope, intercept;
};

}  // namespace

void put_channel(std::vector<std::byte>& texels, Format format, size_t index, double value) {
  switch (format) {
    case Format::R8:
    case Format::RGBA8:
      return put(texels, index, static_cast<uint8_t>(std::lround(std::clamp(value, 0., 1.) * 255)));
    case Format::R16:
      return put(texels, index, static_cast<uint16_t>(std::lround(std::clamp(value, 0., 1.) * 65535)));
    case Format::R16F:
    case Format::RGBA16F:
      return put(texels, index, glm::packHalf1x16(static_cast<float>(value)));
    default:
      return put(texels, index, static_cast<float>(value));
  }
}

std::span<const std::byte> VolumeTexels::of(const Volume& volume) const {
  if (converted.empty()) return volume.voxels;
  return converted;
}

namespace {

VolumeTexels scalar_texels(const Scene& scene, const VolumeSettings& settings) {
  const Volume& volume = *scene.volume;
  const double lo = scene.transfer.lo, window = scene.transfer.hi - scene.transfer.lo;
  VolumeTexels texels;
  texels.format = scalar_format(settings.volume_format, volume.type);
  const bool raw = texels.format == scalar_format("native", volume.type) && volume.slope != 0;
  Line sampled{};  // data value = what the texture returns * slope + intercept
  if (raw && volume.type != VoxelType::I16) {
    const double largest = texels.format == Format::R8 ? 255 : texels.format == Format::R16 ? 65535 : 1;
    sampled = {volume.slope * largest, volume.intercept};
  } else {
    texels.converted.resize(voxel_count(volume) * texel_bytes(texels.format));
    if (raw) {
      sampled = {volume.slope * 65535,
                 volume.intercept - (defect(Defect::SignedOffByOne) ? 32767 : 32768) * volume.slope};
      each_voxel(volume, [&](size_t i, double v) { put(texels.converted, i, static_cast<uint16_t>(v + 32768)); });
    } else {
      // Integer texels cover the range of the data; float texels hold the value normalised by the window.
      const bool unorm = texels.format == Format::R8 || texels.format == Format::R16;
      const double range = volume.max_value > volume.min_value ? volume.max_value - volume.min_value : 1;
      sampled = unorm ? Line{range, volume.min_value} : Line{window, lo};
      each_voxel(volume, [&](size_t i, double v) {
        const double value = v * volume.slope + volume.intercept;
        put_channel(texels.converted, texels.format, i, (value - sampled.intercept) / sampled.slope);
      });
    }
  }
  texels.value_origin = static_cast<float>((lo - sampled.intercept) / sampled.slope);
  texels.value_scale = static_cast<float>(sampled.slope / window);
  return texels;
}

VolumeTexels classified_texels(const Scene& scene, const VolumeSettings& settings) {
  const Volume& volume = *scene.volume;
  const double voxel = smallest_spacing(volume);
  const auto classify = [&](double stored) {
    const glm::dvec4 point =
        scene.transfer.at(std::clamp(stored * volume.slope + volume.intercept, scene.transfer.lo, scene.transfer.hi));
    const double opacity = -std::expm1(-point.a * voxel);
    return glm::dvec4(glm::dvec3(point) * (defect(Defect::UnassociatedColours) ? 1 : opacity), opacity);
  };
  VolumeTexels texels;
  texels.format = classified_format(settings.volume_format, volume.type);
  texels.converted.resize(voxel_count(volume) * texel_bytes(texels.format));
  const auto store = [&](size_t i, const glm::dvec4& colour) {
    for (int channel = 0; channel < 4; ++channel) {
      put_channel(texels.converted, texels.format, i * 4 + static_cast<size_t>(channel), colour[channel]);
    }
  };
  if (volume.type == VoxelType::F32) {
    each_voxel(volume, [&](size_t i, double v) { store(i, classify(v)); });
  } else {
    const int first = volume.type == VoxelType::I16 ? -32768 : 0;
    const int count = volume.type == VoxelType::U8 ? 256 : 65536;
    std::vector<glm::dvec4> classes(static_cast<size_t>(count));
    for (int i = 0; i < count; ++i) classes[static_cast<size_t>(i)] = classify(first + i);
    each_voxel(volume,
               [&](size_t i, double v) { store(i, classes[static_cast<size_t>(static_cast<int>(v) - first)]); });
  }
  return texels;
}

}  // namespace

VolumeTexels volume_texels(const Scene& scene, const VolumeSettings& settings) {
  return settings.classification == Classification::Pre ? classified_texels(scene, settings)
                                                        : scalar_texels(scene, settings);
}

void VolumeResources::create_volume(const Scene& scene, const VolumeSettings& settings) {
  const Volume& volume = *scene.volume;
  const VolumeTexels texels = volume_texels(scene, settings);
  TextureDesc desc;
  desc.label = "volume";
  desc.dimension = 3;
  desc.format = texels.format;
  desc.width = volume.size.x;
  desc.height = volume.size.y;
  desc.depth = volume.size.z;
  desc.data = texels.of(volume);
  volume_ = create(desc);
  value_origin_ = texels.value_origin;
  value_scale_ = texels.value_scale;
}

}  // namespace volumark
