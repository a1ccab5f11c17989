// What the geometry stage hands to the tile rasterizer. Window coordinates: pixels, y down, row 0 on top, pixel (i, j)
// has its centre at (i + .5, j + .5). Everything here is independent of the number of threads.
#pragma once

#include <memory>
#include <vector>

#include "backends/cpu/cpu_program.h"
#include "backends/cpu/resources.h"

namespace volumark {

inline constexpr int kTile = 32;  // pixels on a side; the coverage of a tile row is one uint32_t
inline constexpr int kTilePixels = kTile * kTile;
inline constexpr int kSubPixelBits = 8;

// a * i + b * j + c >= 0 where the centre of pixel (i, j) is inside; the top-left rule is folded into c.
struct Edge {
  int32_t a, b;
  int64_t c;
};

// A quantity that is affine on the screen: value at the triangle's reference point, slopes a pixel.
struct Plane {
  float value, dx, dy;
};

struct Triangle {
  Edge edges[3];
  int32_t x0, y0, x1, y1;  // pixels that may be covered: [x0, x1) x [y0, y1), inside the target
  double reference_x, reference_y;
  uint32_t draw;       // into PassWork::draws
  size_t first_plane;  // into PassWork::planes: depth, 1/w, then the varyings (divided by w if `perspective`)
  bool front;
  bool perspective;  // false: 1/w does not vary, varyings are stored as they are
};

// One recorded draw: all that shading and blending need.
struct DrawState {
  CpuBindings bindings;
  CpuKernels kernels;
  PipelineDesc pipeline;
  bool tests_depth_stencil = false;
};

struct PassWork {
  PassDesc desc;
  int width = 0, height = 0, tiles_x = 0, tiles_y = 0;
  std::shared_ptr<TextureStorage> colour, depth_stencil;
  std::vector<std::unique_ptr<DrawState>> draws;
  std::vector<Triangle> triangles;  // in drawing order
  std::vector<Plane> planes;
  // Triangles of tile t, in drawing order: bin_entries[bin_starts[t] .. bin_starts[t + 1]).
  std::vector<uint32_t> bin_starts, bin_entries;
};

// Fragments waiting to be shaded, structure of arrays. Vector stores may run kBatchPadding past the end.
struct FragmentQueue {
  static constexpr size_t kSize = kMaxBatch + kBatchPadding;
  struct Run {  // fragments [first, first + count) lie on tile pixels pixel, pixel + 1, ...
    uint16_t first, pixel, count;
  };
  alignas(64) float x[kSize], y[kSize], z[kSize];
  alignas(64) float varyings[kMaxVaryings][kSize];
  alignas(64) float rgba[4][kSize];
  alignas(64) uint8_t discard[kSize];
  Run runs[kMaxBatch];
  uint32_t occupied[kTile] = {};  // pixels that are in the queue, a word a row
  size_t run_count = 0, count = 0;
  bool front = true;
};

// What one worker needs while it is on a tile. Colours are float planes holding values the target format can hold.
struct TileScratch {
  alignas(64) float colour[4][kTilePixels + kBatchPadding];
  alignas(64) float depth[kTilePixels];
  alignas(64) uint8_t stencil[kTilePixels];
  FragmentQueue queue;
};

}  // namespace volumark
