#include "methods/reference/lattice.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

namespace volumark {
namespace {

template <typename T>
T voxel(const std::byte* data, size_t index) {
  T value;
  std::memcpy(&value, data + index * sizeof(T), sizeof(T));
  return value;
}

}  // namespace

template <typename T>
void Lattice::use_type() {
  load_ = &Lattice::load_as<T>;
  load_block_ = &Lattice::load_block_as<T>;
  range_ = &Lattice::brick_range<T>;
}

Lattice::Lattice(const Volume& volume)
    : volume_(volume),
      cells_(glm::max(volume.size - 1, glm::ivec3(1))),
      bricks_((cells_ + kBrick - 1) / kBrick),
      stride_{1, static_cast<size_t>(volume.size.x),
              static_cast<size_t>(volume.size.x) * static_cast<size_t>(volume.size.y)} {
  for (int a = 0; a < 3; ++a) {
    const size_t i = static_cast<size_t>(a);
    to_next_[i] = volume.size[a] > 1 ? stride_[i] : 0;
  }
  switch (volume.type) {
    case VoxelType::U8:
      use_type<uint8_t>();
      break;
    case VoxelType::U16:
      use_type<uint16_t>();
      break;
    case VoxelType::I16:
      use_type<int16_t>();
      break;
    case VoxelType::F32:
      use_type<float>();
      break;
  }
}

glm::dvec3 Lattice::index_of_vector(const glm::dvec3& world) const {
  return (glm::transpose(volume_.axes) * world) / volume_.spacing;
}

glm::dvec3 Lattice::index_of_point(const glm::dvec3& world) const {
  glm::dvec3 index = index_of_vector(world - volume_.origin);
  for (int a = 0; a < 3; ++a)
    if (volume_.size[a] == 1) index[a] += 0.5;
  return index;
}

template <typename T>
void Lattice::load_as(const glm::ivec3& cell, Corners& out) const {
  const std::byte* data = volume_.voxels.data();
  const size_t base =
      static_cast<size_t>(cell.x) + static_cast<size_t>(cell.y) * stride_[1] + static_cast<size_t>(cell.z) * stride_[2];
  const size_t offsets[4] = {base, base + to_next_[1], base + to_next_[2], base + to_next_[1] + to_next_[2]};
  const double slope = volume_.slope, intercept = volume_.intercept;
  for (size_t k = 0; k < 4; ++k) {
    out[2 * k] = static_cast<double>(voxel<T>(data, offsets[k])) * slope + intercept;
    out[2 * k + 1] = static_cast<double>(voxel<T>(data, offsets[k] + to_next_[0])) * slope + intercept;
  }
}

template <typename T>
void Lattice::load_block_as(const glm::ivec3& cell, Block& out) const {
  size_t offset[3][4];
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < 4; ++i)
      offset[a][i] =
          static_cast<size_t>(std::clamp(cell[a] + i - 1, 0, volume_.size[a] - 1)) * stride_[static_cast<size_t>(a)];
  const std::byte* data = volume_.voxels.data();
  const double slope = volume_.slope, intercept = volume_.intercept;
  for (size_t k = 0; k < 4; ++k)
    for (size_t j = 0; j < 4; ++j)
      for (size_t i = 0; i < 4; ++i)
        out[k][j][i] =
            static_cast<double>(voxel<T>(data, offset[0][i] + offset[1][j] + offset[2][k])) * slope + intercept;
}

void Lattice::load_gradients(const glm::ivec3& cell, CornerGradients& out) const {
  Block block;
  (this->*load_block_)(cell, block);
  // Along an axis of one sample both corners are that sample, and clamping makes its differences 0.
  const glm::dvec3 scale = 0.5 / volume_.spacing;
  for (size_t c = 0; c < 8; ++c) {
    const size_t i = 1 + (c & 1), j = 1 + ((c >> 1) & 1), k = 1 + (c >> 2);
    out[0][c] = (block[k][j][i + 1] - block[k][j][i - 1]) * scale.x;
    out[1][c] = (block[k][j + 1][i] - block[k][j - 1][i]) * scale.y;
    out[2][c] = (block[k + 1][j][i] - block[k - 1][j][i]) * scale.z;
  }
}

template <typename T>
void Lattice::brick_range(const glm::ivec3& brick, double& lo, double& hi) const {
  const glm::ivec3 first = brick * kBrick, last = glm::min(first + kBrick, volume_.size - 1);
  const std::byte* data = volume_.voxels.data();
  T least = voxel<T>(data, static_cast<size_t>(first.x) + static_cast<size_t>(first.y) * stride_[1] +
                               static_cast<size_t>(first.z) * stride_[2]);
  T most = least;
  for (int k = first.z; k <= last.z; ++k) {
    for (int j = first.y; j <= last.y; ++j) {
      const size_t row = static_cast<size_t>(j) * stride_[1] + static_cast<size_t>(k) * stride_[2];
      for (int i = first.x; i <= last.x; ++i) {
        const T value = voxel<T>(data, row + static_cast<size_t>(i));
        least = std::min(least, value);
        most = std::max(most, value);
      }
    }
  }
  const double a = static_cast<double>(least) * volume_.slope + volume_.intercept;
  const double b = static_cast<double>(most) * volume_.slope + volume_.intercept;
  lo = std::min(a, b);
  hi = std::max(a, b);
}

void Lattice::mark_empty_bricks(const std::function<bool(double lo, double hi)>& shows_nothing) {
  empty_.assign(static_cast<size_t>(bricks_.x) * static_cast<size_t>(bricks_.y) * static_cast<size_t>(bricks_.z), 0);
  const int rows = bricks_.y * bricks_.z;
  tbb::parallel_for(tbb::blocked_range<int>(0, rows), [&](const tbb::blocked_range<int>& range) {
    for (int row = range.begin(); row < range.end(); ++row) {
      for (int x = 0; x < bricks_.x; ++x) {
        double lo = 0, hi = 0;
        const glm::ivec3 brick(x, row % bricks_.y, row / bricks_.y);
        (this->*range_)(brick, lo, hi);
        empty_[brick_index(brick)] = shows_nothing(lo, hi) ? 1 : 0;
      }
    }
  });
}

}  // namespace volumark
