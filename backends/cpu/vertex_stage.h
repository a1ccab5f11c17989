// Runs the vertex kernel of one draw over its vertices, each once even if indices repeat it, and hands the corners on
// to the geometry stage.
#pragma once

#include "backends/backend.h"
#include "backends/cpu/geometry.h"

namespace volumark {

// The bytes that a draw reads, by vertex layout.
struct DrawInput {
  std::vector<std::span<const std::byte>> vertex_buffers;
  std::span<const std::byte> index_buffer;  // empty: not indexed
  bool indexed = false;
  uint32_t first = 0, count = 0, instances = 1;
};

// Kept between draws so that memory is reused.
struct VertexScratch {
  std::vector<uint32_t> vertices, corners;
  std::vector<float> position, varyings;
};

// Appends the draw's triangles to `work`, whose last draw it is. Throws DeviceError OutOfRange where an index points
// past the end of a vertex buffer. Runs in the calling task arena.
void run_vertex_stage(PassWork& work, const DrawInput& input, VertexScratch& scratch);

}  // namespace volumark
