// Scalar twins: a kernel is a plain function, so what needs no speed needs no Highway.
#include "tests/conformance/twins.h"

#include <cstring>

namespace volumark::conformance {
namespace {

void copy4(float* to, const float* from) { std::memcpy(to, from, 4 * sizeof(float)); }

void flat_vertex(const CpuBindings&, VertexBatch& batch) {
  for (size_t i = 0; i < batch.count; ++i) {
    copy4(batch.position + 4 * i, attribute_of(batch, 0, i));
    copy4(batch.varyings + batch.varying_stride * i, attribute_of(batch, 1, i));
  }
}

void instanced_vertex(const CpuBindings&, VertexBatch& batch) {
  for (size_t i = 0; i < batch.count; ++i) {
    const float* position = attribute_of(batch, 0, i);
    const float* offset = attribute_of(batch, 1, i);
    for (size_t c = 0; c < 4; ++c) batch.position[4 * i + c] = position[c] + offset[c];
    const float out[4] = {static_cast<float>(batch.instance), static_cast<float>(batch.vertex_index[i]), 0, 1};
    copy4(batch.varyings + batch.varying_stride * i, out);
  }
}

void flat_fragment(const CpuBindings&, FragmentBatch& batch) {
  for (size_t c = 0; c < 4; ++c) std::memcpy(batch.rgba[c], batch.varyings[c], batch.count * sizeof(float));
}

void window_fragment(const CpuBindings&, FragmentBatch& batch) {
  for (size_t i = 0; i < batch.count; ++i) {
    batch.rgba[0][i] = batch.x[i];
    batch.rgba[1][i] = batch.y[i];
    batch.rgba[2][i] = batch.z[i];
    batch.rgba[3][i] = batch.front_facing ? 1.f : 2.f;
  }
}

template <int kMode>
void special_fragment(const CpuBindings& bindings, FragmentBatch& batch, float scale) {
  float colours[8];
  std::memcpy(colours, bindings.buffers[3].data, sizeof colours);
  for (size_t i = 0; i < batch.count; ++i) {
    if (kMode == 2 && (static_cast<int>(batch.x[i]) & 1) == 1) batch.discard[i] = 1;
    for (size_t c = 0; c < 4; ++c) batch.rgba[c][i] = colours[(kMode == 1 ? 4 : 0) + c] * scale;
  }
}
template <int kMode, int kScaleValue>
void special_kernel(const CpuBindings& bindings, FragmentBatch& batch) {
  special_fragment<kMode>(bindings, batch, static_cast<float>(kScaleValue));
}

void scale_compute(const CpuBindings& bindings, const std::array<uint32_t, 3>& group) {
  float factor;
  uint32_t count;
  std::memcpy(&factor, bindings.buffers[0].data, 4);
  std::memcpy(&count, bindings.buffers[0].data + 4, 4);
  const auto* source = reinterpret_cast<const float*>(bindings.buffers[1].data);
  auto* result = reinterpret_cast<float*>(bindings.buffers[2].data);
  for (uint32_t i = group[0] * 64; i < group[0] * 64 + 64 && i < count; ++i) {
    result[i] = source[i] * factor + static_cast<float>(group[0]);
  }
}

void paint_compute(const CpuBindings& bindings, const std::array<uint32_t, 3>& group) {
  const CpuTexture& picture = bindings.textures[0];
  for (int j = 0; j < 8; ++j) {
    for (int i = 0; i < 8; ++i) {
      const int x = static_cast<int>(group[0]) * 8 + i, y = static_cast<int>(group[1]) * 8 + j;
      if (x >= picture.width || y >= picture.height) continue;
      const float texel[4] = {static_cast<float>(x), static_cast<float>(y), 3, 4};
      std::memcpy(picture.writable + (x + y * picture.row_stride) * 16, texel, 16);
    }
  }
}

CpuKernels raster(CpuVertexKernel vertex, CpuFragmentKernel fragment) {
  CpuKernels kernels;
  kernels.vertex = vertex;
  kernels.fragment = fragment;
  kernels.varyings = 4;
  return kernels;
}
CpuKernels compute(CpuComputeKernel kernel) {
  CpuKernels kernels;
  kernels.compute = kernel;
  return kernels;
}

CpuKernels specialise_special(std::span<const int32_t> constants) {
  CpuFragmentKernel kernels[3][2] = {{special_kernel<0, 1>, special_kernel<0, 2>},
                                     {special_kernel<1, 1>, special_kernel<1, 2>},
                                     {special_kernel<2, 1>, special_kernel<2, 2>}};
  CpuKernels out = raster(flat_vertex, kernels[constants[0]][constants[1] - 1]);
  out.discards = constants[0] == 2;
  return out;
}

}  // namespace

const CpuProgram kFlat{"flat", [](std::span<const int32_t>) { return raster(flat_vertex, flat_fragment); }};
const CpuProgram kWindow{"window", [](std::span<const int32_t>) {
                           CpuKernels kernels = raster(flat_vertex, window_fragment);
                           kernels.reads_depth = true;
                           return kernels;
                         }};
const CpuProgram kInstanced{"instanced",
                            [](std::span<const int32_t>) { return raster(instanced_vertex, flat_fragment); }};
const CpuProgram kSpecial{"special", &specialise_special};
const CpuProgram kScale{"scale", [](std::span<const int32_t>) { return compute(scale_compute); }};
const CpuProgram kPaint{"paint", [](std::span<const int32_t>) { return compute(paint_compute); }};

}  // namespace volumark::conformance
