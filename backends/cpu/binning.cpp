#include "backends/cpu/binning.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace volumark {
namespace {

// Whether some pixel of the tile can be inside all edges; false only if one edge has none of them inside.
bool may_cover(const Triangle& triangle, int tile_x, int tile_y) {
  for (const Edge& edge : triangle.edges) {
    const int64_t origin = int64_t{edge.a} * (tile_x * kTile) + int64_t{edge.b} * (tile_y * kTile) + edge.c;
    const int64_t most = origin + (int64_t{std::max(edge.a, 0)} + std::max(edge.b, 0)) * (kTile - 1);
    if (most < 0) {
      return false;
    }
  }
  return true;
}

template <class Visit>
void for_each_tile(const PassWork& work, const Triangle& triangle, const Visit& visit) {
  const int x0 = triangle.x0 / kTile, x1 = (triangle.x1 - 1) / kTile;
  const int y0 = triangle.y0 / kTile, y1 = (triangle.y1 - 1) / kTile;
  const bool several = x0 != x1 || y0 != y1;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      if (!several || may_cover(triangle, x, y)) {
        visit(static_cast<size_t>(y) * static_cast<size_t>(work.tiles_x) + static_cast<size_t>(x));
      }
    }
  }
}

}  // namespace

void bin_triangles(PassWork& work) {
  constexpr size_t kChunk = 16384;
  const size_t tiles = static_cast<size_t>(work.tiles_x) * static_cast<size_t>(work.tiles_y);
  const size_t chunks = (work.triangles.size() + kChunk - 1) / kChunk;
  // cursors[chunk * tiles + tile]: first the count of the chunk, then where its next entry goes.
  std::vector<uint32_t> cursors(chunks * tiles, 0);
  const auto chunk_range = [&](size_t chunk) {
    return std::pair(chunk * kChunk, std::min((chunk + 1) * kChunk, work.triangles.size()));
  };
  tbb::parallel_for(size_t{0}, chunks, [&](size_t chunk) {
    const auto [begin, end] = chunk_range(chunk);
    uint32_t* counts = cursors.data() + chunk * tiles;
    for (size_t i = begin; i < end; ++i) {
      for_each_tile(work, work.triangles[i], [&](size_t tile) { ++counts[tile]; });
    }
  });
  work.bin_starts.assign(tiles + 1, 0);
  uint32_t total = 0;
  for (size_t tile = 0; tile < tiles; ++tile) {
    work.bin_starts[tile] = total;
    for (size_t chunk = 0; chunk < chunks; ++chunk) {
      total += std::exchange(cursors[chunk * tiles + tile], total);
    }
  }
  work.bin_starts[tiles] = total;
  work.bin_entries.resize(total);
  tbb::parallel_for(size_t{0}, chunks, [&](size_t chunk) {
    const auto [begin, end] = chunk_range(chunk);
    uint32_t* next = cursors.data() + chunk * tiles;
    for (size_t i = begin; i < end; ++i) {
      for_each_tile(work, work.triangles[i],
                    [&](size_t tile) { work.bin_entries[next[tile]++] = static_cast<uint32_t>(i); });
    }
  });
}

}  // namespace volumark
