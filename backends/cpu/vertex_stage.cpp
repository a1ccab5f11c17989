#include "backends/cpu/vertex_stage.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <numeric>

namespace volumark {
namespace {

constexpr size_t kVerticesAtOnce = 1024;

// Fills scratch.vertices (what to shade) and scratch.corners (positions in it).
void list_vertices(const DrawInput& input, VertexScratch& scratch) {
  scratch.corners.resize(input.count);
  if (!input.indexed) {
    scratch.vertices.resize(input.count);
    std::iota(scratch.vertices.begin(), scratch.vertices.end(), input.first);
    std::iota(scratch.corners.begin(), scratch.corners.end(), 0U);
    return;
  }
  std::memcpy(scratch.corners.data(), input.index_buffer.data() + sizeof(uint32_t) * size_t{input.first},
              sizeof(uint32_t) * size_t{input.count});
  const auto [low, high] = std::ranges::minmax(scratch.corners);
  if (uint64_t{high} - low < 2 * uint64_t{input.count}) {
    scratch.vertices.resize(size_t{high} - low + 1);
    std::iota(scratch.vertices.begin(), scratch.vertices.end(), low);
    for (uint32_t& corner : scratch.corners) {
      corner -= low;
    }
  } else {  // few vertices of a large buffer: shade them where they occur
    scratch.vertices = scratch.corners;
    std::iota(scratch.corners.begin(), scratch.corners.end(), 0U);
  }
}

void check_range(const PipelineDesc& pipeline, const DrawInput& input, std::span<const uint32_t> vertices) {
  const uint32_t last = *std::ranges::max_element(vertices);
  for (size_t layout = 0; layout < pipeline.vertex_layouts.size(); ++layout) {
    const VertexLayout& vertex = pipeline.vertex_layouts[layout];
    if (!vertex.per_instance && (size_t{last} + 1) * vertex.stride > input.vertex_buffers[layout].size()) {
      throw DeviceError(DeviceErrorKind::OutOfRange, "draw", pipeline.label,
                        "index " + std::to_string(last) + " points past the end of vertex buffer " +
                            std::to_string(layout) + " (" + std::to_string(input.vertex_buffers[layout].size()) +
                            " bytes, " + std::to_string(vertex.stride) + " a vertex)");
    }
  }
}

VertexBatch batch_of_instance(const PipelineDesc& pipeline, const DrawInput& input, uint32_t instance) {
  VertexBatch batch;
  batch.instance = instance;
  for (size_t layout = 0; layout < pipeline.vertex_layouts.size(); ++layout) {
    const VertexLayout& vertex = pipeline.vertex_layouts[layout];
    for (const VertexAttribute& attribute : vertex.attributes) {
      const size_t advance = vertex.per_instance ? size_t{instance} * vertex.stride : 0;
      batch.attribute[attribute.location] = input.vertex_buffers[layout].data() + attribute.offset + advance;
      batch.stride[attribute.location] = vertex.per_instance ? 0 : vertex.stride;
    }
  }
  return batch;
}

}  // namespace

void run_vertex_stage(PassWork& work, const DrawInput& input, VertexScratch& scratch) {
  const DrawState& state = *work.draws.back();
  if (input.count == 0 || input.instances == 0) {
    return;
  }
  list_vertices(input, scratch);
  if (input.indexed) {
    check_range(state.pipeline, input, scratch.vertices);
  }
  const size_t count = scratch.vertices.size();
  const auto varyings = static_cast<size_t>(state.kernels.varyings);
  scratch.position.resize(4 * count);
  scratch.varyings.resize(varyings * count);
  for (uint32_t instance = 0; instance < input.instances; ++instance) {
    const VertexBatch whole = batch_of_instance(state.pipeline, input, instance);
    const auto shade = [&](size_t begin, size_t end) {
      VertexBatch batch = whole;
      batch.count = end - begin;
      batch.vertex_index = scratch.vertices.data() + begin;
      batch.position = scratch.position.data() + 4 * begin;
      batch.varyings = scratch.varyings.data() + varyings * begin;
      batch.varying_stride = varyings;
      state.kernels.vertex(state.bindings, batch);
    };
    if (count <= kVerticesAtOnce) {
      shade(0, count);
    } else {
      tbb::parallel_for(size_t{0}, (count + kVerticesAtOnce - 1) / kVerticesAtOnce, [&](size_t chunk) {
        shade(chunk * kVerticesAtOnce, std::min(count, (chunk + 1) * kVerticesAtOnce));
      });
    }
    append_primitives(work, static_cast<uint32_t>(work.draws.size() - 1), state.pipeline.topology, state.pipeline.cull,
                      {scratch.position.data(), scratch.varyings.data(), varyings}, scratch.corners);
  }
}

}  // namespace volumark
