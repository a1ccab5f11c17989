// A scalar field on a regular lattice of point samples, in the units of its data.
// The lattice: sample (i, j, k) lies at origin + axes * (spacing * (i, j, k)), in world units. The volume is the box
// from its first to its last samples (trilinear interpolation inside, nothing outside), so n samples span n - 1 cells.
// An axis with a single sample spans one spacing, centred on the sample, along which the field is constant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace volumark {

enum class VoxelType : uint8_t { U8, U16, I16, F32 };
size_t voxel_bytes(VoxelType type);
const char* to_string(VoxelType type);

struct Volume {
  glm::ivec3 size{0};
  VoxelType type = VoxelType::U8;
  std::vector<std::byte> voxels;        // size.x*size.y*size.z, x fastest, host byte order
  glm::dvec3 spacing{1};                // > 0, world units a sample
  glm::dmat3 axes{1};                   // orthonormal columns: direction of the i, j and k axis (may be a reflection)
  glm::dvec3 origin{0};                 // world position of sample (0, 0, 0)
  double slope = 1, intercept = 0;      // data value = stored * slope + intercept
  double min_value = 0, max_value = 0;  // over all samples, data units

  // Data value of one sample; indices are clamped to the lattice.
  double at(int i, int j, int k) const;
  glm::dvec3 extent() const;        // of the box along i, j, k, world units
  glm::dmat4 box_to_world() const;  // [0,1]^3 (u along i, ...) -> world
  glm::dmat4 world_to_box() const;
  // Continuous sample index of box coordinate u along `axis`: u * (n - 1), or 0 where n = 1.
  glm::dvec3 box_to_index(const glm::dvec3& box) const;
};

}  // namespace volumark
