// Empty-space skipping: the volume's cells in bricks of edge^3, each with the range of its samples (those on its far
// faces included, so that every trilinear value inside lies in the range), and the distance of each brick to the
// nearest occupied one. A brick is occupied where the classification table is not transparent over its whole range.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "methods/volume/volume_parameters.h"
#include "methods/volume/volume_uniforms.h"
#include "scenes/scene.h"

namespace volumark {

struct BrickRanges {
  int edge = 0;               // cells
  glm::ivec3 count{0};        // bricks along each axis, at least 1
  std::vector<float> lo, hi;  // data units, x fastest
  size_t index(int x, int y, int z) const {
    return (static_cast<size_t>(z) * static_cast<size_t>(count.y) + static_cast<size_t>(y)) *
               static_cast<size_t>(count.x) +
           static_cast<size_t>(x);
  }
};

// `edge` >= 1. Brick (x, y, z) holds the cells [x edge, (x + 1) edge) ..., an axis with one sample has one brick.
BrickRanges brick_ranges(const Volume& volume, int edge);

// Which normalised values look opaque through a classification table with linear interpolation: places 0, 2, 4 ... are
// the table's nodes, 1, 3, 5 ... the open intervals between them. Values outside of the window read its ends.
class OpaqueValues {
 public:
  OpaqueValues(const TransferFunction& transfer, Classification classification, int table_size);
  // Whether a value in the closed interval is opaque; data units.
  bool any(double lo, double hi) const;
  // lo < s_n < hi holds for every opaque value; lo >= hi: there are none.
  struct Window {
    float lo = 0, hi = 0;
  };
  Window window() const;

 private:
  size_t place(double value) const;

  double lo_, scale_;                  // nodes per data unit
  std::vector<size_t> opaque_before_;  // one more than there are places
};

struct BrickDistances {
  // Chebyshev distance in bricks to the nearest occupied brick, 0 for an occupied one, at most 255: all bricks nearer
  // than the distance are empty. Same order as the ranges.
  std::vector<uint8_t> distance;
  int64_t occupied = 0;
};

// `occupied`: not 0 for each brick that is, in the order of the ranges.
BrickDistances brick_distances(const glm::ivec3& count, const std::vector<uint8_t>& occupied);
// `widen` >= 0 (data units) covers the rounding of the volume's texture format.
BrickDistances brick_distances(const BrickRanges& ranges, const OpaqueValues& opaque, double widen);

// What walk.glsl wants of them: vm.own[0].xyz and vm.own[1].
void put_bricks(const BrickRanges& ranges, const Volume& volume, VolumeUniforms& uniforms);

}  // namespace volumark
