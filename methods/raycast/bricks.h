// Empty-space skipping: the volume's cells in bricks of edge^3, each with the range of its samples (those on its far
// faces included, so that every trilinear value inside lies in the range), and the distance of each brick to the
// nearest occupied one. A brick is occupied where the transfer function is not transparent over its whole range.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

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

struct BrickDistances {
  // Chebyshev distance in bricks to the nearest occupied brick, 0 for an occupied one, at most 255: all bricks nearer
  // than the distance are empty. Same order as the ranges.
  std::vector<uint8_t> distance;
  int64_t occupied = 0;
};

// The opacity is looked up, linearly, in a table of `table_size` entries over the transfer function's window: ranges
// are taken from the entry below to the entry above. `widen` >= 0 (data units) covers the rounding of the volume's
// texture format.
BrickDistances brick_distances(const BrickRanges& ranges, const TransferFunction& transfer, int table_size,
                               double widen);

// Values, normalised by the transfer function's window, outside of which every look-up in a table of `table_size`
// entries is transparent: lo < s_n < hi holds for all others. Values beyond the window read its ends.
struct OpaqueWindow {
  float lo = 0, hi = 0;  // lo >= hi: all is transparent
};
OpaqueWindow opaque_window(const TransferFunction& transfer, int table_size);

}  // namespace volumark
