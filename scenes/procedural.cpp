#include "scenes/procedural.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "scenes/noise.h"
#include "scenes/volume_finish.h"

namespace volumark {
namespace {

double cloud_value(const PerlinCloudField& field, const PerlinNoise& noise, const glm::dvec3& p) {
  double fbm = 0, weight = 1;
  glm::dvec3 q = p * field.frequency;
  for (int octave = 0; octave < field.octaves; ++octave) {
    fbm += weight * noise(q);
    weight *= field.gain;
    q *= 2.0;
  }
  return 1 / (1 + std::exp(-field.steepness * (field.radius - glm::length(p) + field.amplitude * fbm)));
}

// Value at p (longest axis [-1, 1]) and u (box coordinates).
using Sampler = std::function<double(const glm::dvec3& p, const glm::dvec3& u)>;

struct MakeSampler {
  double extent;
  glm::dvec3 half;  // of the box, in units of p
  Sampler operator()(const ConstantField& f) const {
    return [f](const glm::dvec3&, const glm::dvec3&) { return f.value; };
  }
  Sampler operator()(const DistanceField&) const {
    return [half = extent / 2](const glm::dvec3& p, const glm::dvec3&) { return glm::length(p) * half; };
  }
  Sampler operator()(const RampField& f) const {
    return [f](const glm::dvec3&, const glm::dvec3& u) { return std::lerp(f.from, f.to, u[f.axis]); };
  }
  Sampler operator()(const MarschnerLobbField& f) const {
    return [f](const glm::dvec3& p, const glm::dvec3&) { return marschner_lobb(f, p); };
  }
  Sampler operator()(const PerlinCloudField& f) const {
    return
        [f, noise = PerlinNoise(f.seed)](const glm::dvec3& p, const glm::dvec3&) { return cloud_value(f, noise, p); };
  }
  Sampler operator()(const VesselTreeField& f) const {
    return [tree = VesselTree(f, half)](const glm::dvec3& p, const glm::dvec3&) { return tree.value(p); };
  }
};

glm::dvec3 cells_of(const glm::ivec3& size) { return glm::dvec3(glm::max(size - 1, glm::ivec3(1))); }

double spacing_of(const ProceduralSpec& spec) {
  const glm::dvec3 cells = cells_of(spec.size);
  return spec.extent / std::max({cells.x, cells.y, cells.z});
}

double largest_level(VoxelType type) { return type == VoxelType::U8 ? 255 : type == VoxelType::U16 ? 65535 : 32767; }

template <typename T>
void put(std::vector<std::byte>& voxels, size_t index, T value) {
  std::memcpy(voxels.data() + index * sizeof(T), &value, sizeof(T));
}

void store(Volume& volume, size_t index, double value) {
  const double level = volume.slope == 0 ? 0 : std::round((value - volume.intercept) / volume.slope);
  switch (volume.type) {
    case VoxelType::U8:
      return put(volume.voxels, index, static_cast<uint8_t>(level));
    case VoxelType::U16:
      return put(volume.voxels, index, static_cast<uint16_t>(level));
    case VoxelType::I16:
      return put(volume.voxels, index, static_cast<int16_t>(level));
    case VoxelType::F32:
      return put(volume.voxels, index, static_cast<float>(value));
  }
}

}  // namespace

double marschner_lobb(const MarschnerLobbField& field, const glm::dvec3& p) {
  constexpr double pi = std::numbers::pi;
  const double r = std::hypot(p.x, p.y);
  const double rho_r = std::cos(2 * pi * field.frequency * std::cos(pi * r / 2));
  return (1 - std::sin(pi * p.z / 2) + field.alpha * (1 + rho_r)) / (2 * (1 + field.alpha));
}

double perlin_cloud(const PerlinCloudField& field, const glm::dvec3& p) {
  return cloud_value(field, PerlinNoise(field.seed), p);
}

FieldRange field_range(const ProceduralSpec& spec) {
  if (const auto* constant = std::get_if<ConstantField>(&spec.field)) {
    return {std::min(0.0, constant->value), std::max(0.0, constant->value)};
  }
  if (const auto* ramp = std::get_if<RampField>(&spec.field)) {
    return {std::min(ramp->from, ramp->to), std::max(ramp->from, ramp->to)};
  }
  if (std::holds_alternative<DistanceField>(spec.field)) {
    return {0, glm::length(cells_of(spec.size)) * spacing_of(spec) / 2};
  }
  return {0, 1};
}

Volume make_volume(const ProceduralSpec& spec) {
  Volume volume;
  volume.size = spec.size;
  volume.type = spec.type;
  const double spacing = spacing_of(spec);
  volume.spacing = glm::dvec3(spacing);
  volume.origin = glm::dvec3(spec.size - 1) * (-0.5 * spacing);
  if (spec.type != VoxelType::F32) {
    const FieldRange range = field_range(spec);
    const double width = range.hi > range.lo ? range.hi - range.lo : 1;
    volume.slope = width / largest_level(spec.type);
    volume.intercept = range.lo;
  }
  const auto n = glm::dvec3(spec.size);
  volume.voxels.resize(static_cast<size_t>(n.x * n.y * n.z) * voxel_bytes(spec.type));
  const double to_p = 2 / spec.extent;
  const glm::dvec3 cells = cells_of(spec.size);
  const Sampler sample = std::visit(MakeSampler{spec.extent, 0.5 * spacing * to_p * cells}, spec.field);
  size_t index = 0;
  for (int k = 0; k < spec.size.z; ++k) {
    for (int j = 0; j < spec.size.y; ++j) {
      for (int i = 0; i < spec.size.x; ++i) {
        const glm::dvec3 at(i, j, k);
        store(volume, index++, sample((volume.origin + at * spacing) * to_p, at / cells));
      }
    }
  }
  finish_volume(volume, NonFinite::Refuse, "generator");
  return volume;
}

}  // namespace volumark
