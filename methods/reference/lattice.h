// A volume's samples as the reference walks them: cells of eight samples, and bricks of cells that the transfer
// function leaves empty. In index space cell (i, j, k) is [i, i+1] x ...; an axis with one sample has one cell, along
// which the field is constant. Reads the voxels in place, whatever their type.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "scenes/volume.h"

namespace volumark {

class Lattice {
 public:
  static constexpr int kBrick = 4;  // cells along each edge

  // The volume must outlive it.
  explicit Lattice(const Volume& volume);

  const Volume& volume() const { return volume_; }
  glm::ivec3 cells() const { return cells_; }
  // World position to index space, in which the volume is the box [0, cells()].
  glm::dvec3 index_of_point(const glm::dvec3& world) const;
  glm::dvec3 index_of_vector(const glm::dvec3& world) const;

  // The samples at the corners of a cell, x fastest.
  using Corners = std::array<double, 8>;
  void load(const glm::ivec3& cell, Corners& out) const { (this->*load_)(cell, out); }
  // Central-difference gradients at the corners of a cell, along the volume's axes, data units a world unit.
  using CornerGradients = std::array<Corners, 3>;
  void load_gradients(const glm::ivec3& cell, CornerGradients& out) const;

  // Finds the bricks whose values, all within [lo, hi], show nothing; without it, none is known to be empty.
  void mark_empty_bricks(const std::function<bool(double lo, double hi)>& shows_nothing);
  bool brick_empty(const glm::ivec3& brick) const { return !empty_.empty() && empty_[brick_index(brick)] != 0; }
  glm::ivec3 bricks() const { return bricks_; }

 private:
  template <typename T>
  void use_type();
  template <typename T>
  void load_as(const glm::ivec3& cell, Corners& out) const;
  size_t brick_index(const glm::ivec3& brick) const {
    const size_t row = static_cast<size_t>(brick.z) * static_cast<size_t>(bricks_.y) + static_cast<size_t>(brick.y);
    return row * static_cast<size_t>(bricks_.x) + static_cast<size_t>(brick.x);
  }
  // The samples of the cell and its neighbours, cell - 1 .. cell + 2 along each axis, indices clamped to the lattice.
  using Block = double[4][4][4];
  template <typename T>
  void load_block_as(const glm::ivec3& cell, Block& out) const;
  template <typename T>
  void brick_range(const glm::ivec3& brick, double& lo, double& hi) const;

  const Volume& volume_;
  glm::ivec3 cells_, bricks_;
  std::array<size_t, 3> stride_, to_next_;  // voxels; to_next_ is 0 along an axis with one sample
  void (Lattice::*load_)(const glm::ivec3&, Corners&) const;
  void (Lattice::*load_block_)(const glm::ivec3&, Block&) const;
  void (Lattice::*range_)(const glm::ivec3&, double&, double&) const;
  std::vector<uint8_t> empty_;
};

}  // namespace volumark
