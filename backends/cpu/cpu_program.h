// The CPU twin of a program: what a method writes beside its GLSL so that the cpu backend can run it. A twin is
// compiled with Highway for several instruction sets; `specialise` picks the kernels once, when the program is made.
// Kernels are pure functions of the bindings and their input: they are called from several threads at once.
#pragma once

#include "backends/types.h"

namespace volumark {

inline constexpr int kMaxBindings = 16;
inline constexpr int kMaxVaryings = 16;      // floats a vertex hands to the rasterizer
inline constexpr size_t kMaxBatch = 256;     // fragments in one batch
inline constexpr size_t kBatchPadding = 16;  // batch arrays are 64-byte aligned and readable (finite values) and
                                             // writable up to the next multiple of this many elements

struct CpuBuffer {
  std::byte* data = nullptr;
  size_t size = 0;  // bytes from the bound offset on
};

// Texels lie at data + (x + y * row_stride + z * slice_stride) * texel_bytes. Rows and slices are padded, so that
// reading one texel past the end of a row, one row past the end of a slice, and one slice past the end is allowed (the
// values there repeat the edge); 16 readable bytes follow the last texel.
struct CpuTexture {
  const std::byte* data = nullptr;
  std::byte* writable = nullptr;  // storage images
  Format format = Format::RGBA32F;
  int dimension = 2;
  int width = 0, height = 1, depth = 1;
  ptrdiff_t row_stride = 0, slice_stride = 0;  // texels
  Sampler sampler;
};

struct CpuBindings {
  CpuBuffer buffers[kMaxBindings];    // by slot: Uniform and Storage
  CpuTexture textures[kMaxBindings];  // by slot: Sampled and Image
};

// Vertices [first, first + count) of one instance. attribute[l] + i * stride[l] is the attribute at location l of
// vertex index[i] (index resolved by the backend: use `vertex_index[i]` for what GLSL calls VM_VERTEX).
struct VertexBatch {
  size_t count = 0;
  uint32_t instance = 0;
  const uint32_t* vertex_index = nullptr;
  const std::byte* attribute[8] = {};  // base of the vertex buffer + offset, by location
  uint32_t stride[8] = {};             // bytes; 0 for per-instance attributes (base already advanced)
  float* position = nullptr;           // out: 4 floats a vertex, clip space
  float* varyings = nullptr;           // out: `varying_stride` floats a vertex
  size_t varying_stride = 0;
};
inline const float* attribute_of(const VertexBatch& batch, int location, size_t i) {
  return reinterpret_cast<const float*>(batch.attribute[location] +
                                        static_cast<size_t>(batch.vertex_index[i]) * batch.stride[location]);
}

// Fragments of one tile, structure of arrays, in drawing order; a pixel occurs at most once in a batch.
struct FragmentBatch {
  size_t count = 0;          // <= kMaxBatch
  const float* x = nullptr;  // window coordinates of the sample, pixel centres (.5); y down, row 0 on top
  const float* y = nullptr;
  const float* z = nullptr;                  // window depth; null unless CpuKernels::reads_depth
  const float* varyings[kMaxVaryings] = {};  // perspective-correct
  bool front_facing = true;
  float* rgba[4] = {};         // out
  uint8_t* discard = nullptr;  // out, zeroed before the call: set to 1 where the fragment is dropped
};

using CpuVertexKernel = void (*)(const CpuBindings&, VertexBatch&);
using CpuFragmentKernel = void (*)(const CpuBindings&, FragmentBatch&);
// One workgroup; the kernel loops over its own local invocations.
using CpuComputeKernel = void (*)(const CpuBindings&, const std::array<uint32_t, 3>& group);

struct CpuKernels {
  CpuVertexKernel vertex = nullptr;
  CpuFragmentKernel fragment = nullptr;
  CpuComputeKernel compute = nullptr;
  int varyings = 0;
  bool discards = false;           // the fragment kernel may set `discard`
  bool reads_depth = false;        // the fragment kernel reads z
  bool reads_front_facing = true;  // false: batches may mix faces (front_facing is then meaningless), which fills them
                                   // better where small front and back faces alternate
};

struct CpuProgram {
  const char* name;
  // constants[i]: value of the VM_SPEC constant with id i.
  CpuKernels (*specialise)(std::span<const int32_t> constants);
};

}  // namespace volumark
