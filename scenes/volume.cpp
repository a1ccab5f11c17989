#include "scenes/volume.h"

#include <algorithm>
#include <cstring>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace volumark {

size_t voxel_bytes(VoxelType type) {
  switch (type) {
    case VoxelType::U8:
      return 1;
    case VoxelType::U16:
    case VoxelType::I16:
      return 2;
    case VoxelType::F32:
      return 4;
  }
  return 0;
}

const char* to_string(VoxelType type) {
  switch (type) {
    case VoxelType::U8:
      return "u8";
    case VoxelType::U16:
      return "u16";
    case VoxelType::I16:
      return "i16";
    case VoxelType::F32:
      return "f32";
  }
  return "?";
}

namespace {

template <typename T>
double stored(const std::vector<std::byte>& voxels, size_t index) {
  T value;
  std::memcpy(&value, voxels.data() + index * sizeof(T), sizeof(T));
  return static_cast<double>(value);
}

}  // namespace

double Volume::at(int i, int j, int k) const {
  const auto x = static_cast<size_t>(std::clamp(i, 0, size.x - 1));
  const auto y = static_cast<size_t>(std::clamp(j, 0, size.y - 1));
  const auto z = static_cast<size_t>(std::clamp(k, 0, size.z - 1));
  const size_t index = (z * static_cast<size_t>(size.y) + y) * static_cast<size_t>(size.x) + x;
  double value = 0;
  switch (type) {
    case VoxelType::U8:
      value = stored<uint8_t>(voxels, index);
      break;
    case VoxelType::U16:
      value = stored<uint16_t>(voxels, index);
      break;
    case VoxelType::I16:
      value = stored<int16_t>(voxels, index);
      break;
    case VoxelType::F32:
      value = stored<float>(voxels, index);
      break;
  }
  return value * slope + intercept;
}

glm::dvec3 Volume::extent() const { return spacing * glm::dvec3(glm::max(size - 1, glm::ivec3(1))); }

glm::dmat4 Volume::box_to_world() const {
  const glm::dvec3 length = extent();
  glm::dvec3 corner = origin;
  for (int a = 0; a < 3; ++a) {
    if (size[a] == 1) corner -= axes[a] * (0.5 * spacing[a]);
  }
  return {glm::dvec4(axes[0] * length[0], 0), glm::dvec4(axes[1] * length[1], 0), glm::dvec4(axes[2] * length[2], 0),
          glm::dvec4(corner, 1)};
}

glm::dmat4 Volume::world_to_box() const {
  // The axes are orthonormal: the inverse is their transpose, scaled.
  const glm::dvec3 length = extent();
  const glm::dvec3 corner(box_to_world()[3]);
  const glm::dmat3 back = glm::transpose(axes);
  glm::dmat4 m(1);
  for (int column = 0; column < 3; ++column) m[column] = glm::dvec4(back[column] / length, 0);
  m[3] = glm::dvec4(-(back * corner) / length, 1);
  return m;
}

glm::dvec3 Volume::box_to_index(const glm::dvec3& box) const { return box * glm::dvec3(size - 1); }

}  // namespace volumark
