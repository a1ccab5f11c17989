// From clip-space vertices to triangles ready for the tiles: assembly, clipping, perspective division, culling,
// snapping to the sub-pixel grid, edge and plane equations. Points and lines become triangles one pixel wide.
#pragma once

#include "backends/cpu/raster_types.h"

namespace volumark {

// Vertices as the vertex kernel left them; `varyings` counts floats a vertex in both arrays' strides.
struct ShadedVertices {
  const float* position = nullptr;  // 4 a vertex
  const float* varyings = nullptr;
  size_t varying_count = 0;
};

// Appends the triangles of one instance to `work`: primitive corners are vertices corners[0], corners[1], ...
void append_primitives(PassWork& work, uint32_t draw, Topology topology, Cull cull, const ShadedVertices& vertices,
                       std::span<const uint32_t> corners);

}  // namespace volumark
