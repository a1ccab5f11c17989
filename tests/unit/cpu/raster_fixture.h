// Draws triangles on the cpu backend alone: a tiny twin whose vertices are (clip position, one varying v), and whose
// fragments are (v, v, v, 1), (x, y, z, facing) or whatever a test's own kernel says.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "backends/backend.h"
#include "backends/cpu/cpu_program.h"

namespace volumark {

struct TestVertex {
  float x, y, z, w;  // clip space
  float v = 0;
};

inline TestVertex at_ndc(float x, float y, float v = 0, float w = 1, float z = 0.5F) {
  return {x * w, y * w, z * w, w, v};
}

inline void test_vertex_kernel(const CpuBindings&, VertexBatch& batch) {
  for (size_t i = 0; i < batch.count; ++i) {
    std::copy_n(attribute_of(batch, 0, i), 4, batch.position + 4 * i);
    batch.varyings[i * batch.varying_stride] = *attribute_of(batch, 1, i);
  }
}
inline void constant_kernel(const CpuBindings&, FragmentBatch& batch) {
  for (float* channel : batch.rgba) std::fill_n(channel, batch.count, 1.0F);
}
inline void varying_kernel(const CpuBindings&, FragmentBatch& batch) {
  for (int c = 0; c < 3; ++c) std::copy_n(batch.varyings[0], batch.count, batch.rgba[c]);
  std::fill_n(batch.rgba[3], batch.count, 1.0F);
}

template <CpuFragmentKernel fragment, bool discards = false>
CpuKernels kernels_of(std::span<const int32_t>) {
  CpuKernels kernels;
  kernels.vertex = test_vertex_kernel;
  kernels.fragment = fragment;
  kernels.varyings = 1;
  kernels.discards = discards;
  kernels.reads_depth = true;
  return kernels;
}

class RasterFixture {
 public:
  static constexpr uint32_t kColour = 1, kDepthStencil = 2, kVertices = 1, kProgram = 1, kPipeline = 1;

  RasterFixture(int width, int height, int threads, CpuKernels (*specialise)(std::span<const int32_t>),
                PipelineDesc pipeline = {})
      : width_(width), height_(height), program_{"test", specialise} {
    DeviceOptions options;
    options.threads = threads;
    backend_ = make_cpu_backend(options);
    TextureDesc colour;
    colour.width = width;
    colour.height = height;
    colour.format = pipeline.colour_format;
    colour.target = true;
    backend_->create_texture(kColour, colour);
    colour.format = Format::D32FS8;
    backend_->create_texture(kDepthStencil, colour);
    static const ShaderText vertex{"test", Stage::Vertex, "", {}}, fragment{"test", Stage::Fragment, "", {}};
    ProgramDesc program;
    program.stages = {&vertex, &fragment};
    program.cpu = &program_;
    backend_->create_program(kProgram, program);
    pipeline.vertex_layouts = {{sizeof(TestVertex), false, {{0, 4, 0}, {1, 1, 16}}}};
    backend_->create_pipeline(kPipeline, kProgram, pipeline, program);
    has_depth_stencil_ = pipeline.has_depth_stencil;
  }

  // One pass that clears to 0 and draws all vertices in order.
  void draw(const std::vector<TestVertex>& vertices) {
    BufferDesc buffer;
    buffer.size = vertices.size() * sizeof(TestVertex);
    buffer.data = bytes_of(vertices);
    backend_->create_buffer(kVertices, buffer);
    const PassDesc desc;
    backend_->begin_pass({kColour, has_depth_stencil_, kDepthStencil, width_, height_, &desc});
    ResolvedDraw draw;
    draw.pipeline = kPipeline;
    draw.vertex_buffers = {kVertices};
    draw.count = static_cast<uint32_t>(vertices.size());
    backend_->draw(draw);
    backend_->end_pass();
    backend_->destroy_buffer(kVertices);
  }

  // RGBA32F: 4 floats a pixel, row 0 on top.
  std::vector<float> pixels() {
    std::vector<float> out(static_cast<size_t>(width_) * static_cast<size_t>(height_) * 4);
    backend_->read_texture(kColour, std::as_writable_bytes(std::span(out)));
    return out;
  }
  std::vector<std::byte> bytes(size_t texel) {
    std::vector<std::byte> out(static_cast<size_t>(width_) * static_cast<size_t>(height_) * texel);
    backend_->read_texture(kColour, out);
    return out;
  }
  float at(const std::vector<float>& image, int x, int y, int channel) const {
    return image[static_cast<size_t>((y * width_ + x) * 4 + channel)];
  }
  Backend& backend() { return *backend_; }

 private:
  int width_, height_;
  CpuProgram program_;
  bool has_depth_stencil_ = false;
  std::unique_ptr<Backend> backend_;
};

}  // namespace volumark
