// Twin of shell_slices.frag and of the three vertex programs. Vertices one by one, in the very arithmetic of the host
// (shell_frame.h); fragments on SIMD lanes.
#include "methods/shell_slices/shell_twin.h"

#include "methods/shell_slices/section.h"
#include "methods/shell_slices/shell_frame.h"

// After the headers without Highway.
#include "backends/cpu/highway_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "methods/shell_slices/shell_twin.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "methods/volume/volume_twin-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {
namespace {

const ShellUniforms& uniforms_of(const CpuBindings& bindings) {
  return *reinterpret_cast<const ShellUniforms*>(bindings.buffers[4].data);
}

// ---- Vertices ----
void put_vertex(VertexBatch& batch, size_t i, const glm::vec2& ndc, const glm::vec3& texture) {
  const float position[4] = {ndc.x, ndc.y, .5F, 1.F};
  std::copy_n(position, 4, batch.position + 4 * i);
  std::copy_n(&texture.x, 3, batch.varyings + batch.varying_stride * i);
}

// What light needs: the varyings after the texture coordinates.
void put_light(VertexBatch& batch, size_t i, const glm::vec3& box, const glm::mat3& cotangent) {
  float* out = batch.varyings + batch.varying_stride * i + 3;
  std::copy_n(&box.x, 3, out);
  std::copy_n(&cotangent[0].x, 9, out + 3);
}

template <bool lit>
void software_vertex(const CpuBindings&, VertexBatch& batch) {
  for (size_t i = 0; i < batch.count; ++i) {
    const float* ndc = attribute_of(batch, 0, i);
    const float* texture = attribute_of(batch, 1, i);
    put_vertex(batch, i, {ndc[0], ndc[1]}, {texture[0], texture[1], texture[2]});
    if constexpr (lit) {
      float* out = batch.varyings + batch.varying_stride * i + 3;
      for (int column = 0; column < 4; ++column) std::copy_n(attribute_of(batch, 2 + column, i), 3, out + 3 * column);
    }
  }
}

template <bool lit>
void hybrid_vertex(const CpuBindings& bindings, VertexBatch& batch) {
  const ShellUniforms& u = uniforms_of(bindings);
  const auto* edges = reinterpret_cast<const FakeVertex*>(bindings.buffers[5].data);
  for (size_t i = 0; i < batch.count; ++i) {
    const float* pair = attribute_of(batch, 0, i);
    const FakeVertex& edge = edges[static_cast<size_t>(pair[0])];
    const float plane = pair[1];
    const EdgeWeights weights = edge_weights(plane_depth(u, edge.a) - plane, plane_depth(u, edge.b) - plane);
    const glm::vec3 p = on_edge(weights, edge.a, edge.b);
    put_vertex(batch, i, to_ndc(u, p, plane), on_edge(weights, edge.texture_a, edge.texture_b));
    if constexpr (lit) {
      const auto* ends =
          reinterpret_cast<const glm::mat3*>(bindings.buffers[7].data) + 2 * static_cast<size_t>(pair[0]);
      put_light(batch, i, to_box(u, p), on_edge(weights, ends[0], ends[1]));
    }
  }
}

// The weighted sums of the GLSL choose what the branches choose; one twin serves both.
template <bool listed, bool lit>
void hardware_vertex(const CpuBindings& bindings, VertexBatch& batch) {
  const ShellUniforms& u = uniforms_of(bindings);
  const auto* corners = reinterpret_cast<const glm::vec3*>(bindings.buffers[5].data);
  const auto* pairs = reinterpret_cast<const uint32_t*>(bindings.buffers[6].data);
  for (size_t i = 0; i < batch.count; ++i) {
    size_t vertex = batch.vertex_index[i];
    float plane = u.lens[2] - 1.F - static_cast<float>(batch.instance);
    if constexpr (listed) {
      const uint32_t* pair = pairs + 2 * (vertex / 6);
      vertex = 6 * static_cast<size_t>(pair[0]) + vertex % 6;
      plane = static_cast<float>(pair[1]);
    }
    const glm::vec3* p = corners + 12 * vertex;
    float depth[6];
    bool far[6];
    for (size_t c = 0; c < 6; ++c) {
      depth[c] = plane_depth(u, p[c]);
      far[c] = depth[c] >= plane;
    }
    size_t a = 0, b = 0;
    if (far[0] != far[1]) {
      b = 1;
    } else {
      for (size_t other = 2; other < 6 && b == 0; other += 2) {
        const size_t third = 6 - other;
        const bool lower = far[0] != far[other], upper = far[1] != far[other + 1];
        const bool reversed = far[third] != far[third + 1] && far[third];
        if (lower && (!upper || far[0] != reversed)) {
          b = other;
        } else if (upper) {
          a = 1;
          b = other + 1;
        }
      }
    }
    if (b == 0) {
      put_vertex(batch, i, {4.F, 4.F}, glm::vec3(0));
      if constexpr (lit) put_light(batch, i, glm::vec3(0), glm::mat3(0));
      continue;
    }
    const EdgeWeights weights = edge_weights(depth[a] - plane, depth[b] - plane);
    const glm::vec3 point = on_edge(weights, p[a], p[b]);
    put_vertex(batch, i, to_ndc(u, point, plane), on_edge(weights, p[6 + a], p[6 + b]));
    if constexpr (lit) {
      const auto* own = reinterpret_cast<const glm::mat3*>(bindings.buffers[7].data) + 6 * vertex;
      put_light(batch, i, to_box(u, point), on_edge(weights, own[a], own[b]));
    }
  }
}

// ---- Fragments ----

// The two texels along a repeating axis and the weight of the second. The coordinate may be anything finite.
struct RepeatCell {
  Ints i0, i1;
  Floats t;
};
HWY_INLINE RepeatCell repeat_cell(Floats coordinate, int extent) {
  const IntTag di;
  const Floats at =
      hn::MulSub(hn::Sub(coordinate, hn::Floor(coordinate)), splat(static_cast<float>(extent)), splat(.5F));
  const Floats floor = hn::Floor(at);
  const Ints last = hn::Set(di, extent - 1), zero = hn::Zero(di);
  Ints i0 = hn::Min(truncate(floor), last);
  i0 = hn::IfThenElse(hn::Lt(i0, zero), last, i0);
  Ints i1 = hn::Add(i0, hn::Set(di, 1));
  i1 = hn::IfThenElse(hn::Gt(i1, last), zero, i1);
  return {i0, i1, hn::Sub(at, floor)};
}

// Where the eight texels of `count` samples lie, in floats, and their weights.
template <size_t count>
struct alignas(64) TexelCells {
  int32_t x[2][count], row[4][count];
  float weight[3][count];
};

template <size_t count>
HWY_INLINE void locate(const CpuTexture& texture, const Floats3& at, size_t i, TexelCells<count>& cells) {
  const IntTag di;
  const RepeatCell x = repeat_cell(at.x, texture.width), y = repeat_cell(at.y, texture.height),
                   z = repeat_cell(at.z, texture.depth);
  const Ints row = hn::Set(di, static_cast<int32_t>(texture.row_stride)),
             slice = hn::Set(di, static_cast<int32_t>(texture.slice_stride));
  const Ints y0 = hn::Mul(y.i0, row), y1 = hn::Mul(y.i1, row), z0 = hn::Mul(z.i0, slice), z1 = hn::Mul(z.i1, slice);
  hn::Store(hn::ShiftLeft<2>(x.i0), di, cells.x[0] + i);
  hn::Store(hn::ShiftLeft<2>(x.i1), di, cells.x[1] + i);
  hn::Store(hn::ShiftLeft<2>(hn::Add(y0, z0)), di, cells.row[0] + i);
  hn::Store(hn::ShiftLeft<2>(hn::Add(y1, z0)), di, cells.row[1] + i);
  hn::Store(hn::ShiftLeft<2>(hn::Add(y0, z1)), di, cells.row[2] + i);
  hn::Store(hn::ShiftLeft<2>(hn::Add(y1, z1)), di, cells.row[3] + i);
  store(x.t, cells.weight[0] + i);
  store(y.t, cells.weight[1] + i);
  store(z.t, cells.weight[2] + i);
}

// textureLod of RGBA32F texels, linear and repeating: eight 128-bit loads a lane, interpolated as whole texels.
template <size_t count>
HWY_INLINE Rgba sample_cells(const CpuTexture& texture, const TexelCells<count>& cells, size_t i) {
  const FloatTag d;
  const hn::Full128<float> d4;
  alignas(64) float quad[4 * kMaxLanes];
  const auto* texels = reinterpret_cast<const float*>(texture.data);
  for (size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    const size_t k = i + lane;
    const auto tx = hn::Set(d4, cells.weight[0][k]), ty = hn::Set(d4, cells.weight[1][k]),
               tz = hn::Set(d4, cells.weight[2][k]);
    const auto mix4 = [&](auto a, auto b, auto s) HWY_ATTR { return hn::MulAdd(hn::Sub(b, a), s, a); };
    const auto along_row = [&](int r) HWY_ATTR {
      const float* base = texels + cells.row[r][k];
      return mix4(hn::LoadU(d4, base + cells.x[0][k]), hn::LoadU(d4, base + cells.x[1][k]), tx);
    };
    const auto low = mix4(along_row(0), along_row(1), ty), high = mix4(along_row(2), along_row(3), ty);
    hn::Store(mix4(low, high, tz), d4, quad + 4 * lane);
  }
  Rgba out;
  hn::LoadInterleaved4(d, quad, out.r, out.g, out.b, out.a);
  return out;
}

HWY_INLINE Rgba sample_texels(const CpuTexture& texture, const Floats3& at) {
  TexelCells<kMaxLanes> cells;
  locate(texture, at, 0, cells);
  return sample_cells(texture, cells, 0);
}

// The texture is far larger than a cache, and the batch knows all it will need of it.
template <size_t count>
HWY_INLINE void prefetch(const CpuTexture& texture, const TexelCells<count>& cells, size_t i) {
  const auto* texels = reinterpret_cast<const float*>(texture.data);
  for (size_t k = i; k < i + hn::Lanes(FloatTag()); ++k) {
    for (int r = 0; r < 4; ++r) hwy::Prefetch(texels + cells.row[r][k] + cells.x[0][k]);
  }
}

// The int32 offsets of sample_texels, in floats, reach.
bool fits_texels(const CpuTexture& texture) {
  return texture.format == Format::RGBA32F && texture.slice_stride * texture.depth < (ptrdiff_t{1} << 29);
}

template <bool texels>
HWY_INLINE Rgba fetch(const CpuTexture& texture, const Floats3& at) {
  return texels ? sample_texels(texture, at) : sample_3d(texture, at.x, at.y, at.z);
}

HWY_INLINE Floats3 within(const ShellUniforms& u, const Floats3& at) {
  return {at.x, at.y, hn::Min(hn::Max(at.z, splat(u.texture[0])), splat(u.texture[1]))};
}

HWY_INLINE Floats3 varying3(const FragmentBatch& batch, int first, size_t i) {
  return {load(batch.varyings[first] + i), load(batch.varyings[first + 1] + i), load(batch.varyings[first + 2] + i)};
}

template <bool texels>
HWY_INLINE Floats3 world_gradient(const ShellUniforms& u, const CpuTexture& texture, const FragmentBatch& batch,
                                  size_t i, const Floats3& at) {
  const Floats zero = splat(0.F);
  const auto difference = [&](const Floats3& e) HWY_ATTR {
    return hn::Sub(fetch<texels>(texture, within(u, at + e)).a, fetch<texels>(texture, within(u, at - e)).a);
  };
  const Floats3 d = Floats3{difference({splat(u.texel[0]), zero, zero}), difference({zero, splat(u.texel[1]), zero}),
                            difference({zero, zero, splat(u.texel[2])})} *
                    splat3(u.slope);
  return along(along(scaled(varying3(batch, 6, i), d.x), d.y, varying3(batch, 9, i)), d.z, varying3(batch, 12, i));
}

template <bool linear_opacity, bool lit, bool texels>
void shade(const CpuBindings& bindings, FragmentBatch& batch) {
  const ShellUniforms& u = uniforms_of(bindings);
  const CpuTexture& texture = bindings.textures[1];
  const Floats one = splat(1.F), tiny = splat(1e-30F), scale = splat(u.texture[3]);
  TexelCells<kMaxBatch + kBatchPadding> cells;
  if constexpr (texels) {
    for_lanes(batch.count, [&](size_t i) HWY_ATTR {
      locate(texture, within(u, varying3(batch, 0, i)), i, cells);
      prefetch(texture, cells, i);
    });
  }
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const Floats x = hn::Mul(hn::MulAdd(load(batch.x + i), splat(u.window[0]), splat(-1.F)), splat(u.window[2]));
    const Floats y = hn::Mul(hn::MulAdd(load(batch.y + i), splat(u.window[1]), one), splat(u.window[3]));
    const Floats len = hn::Mul(splat(u.texture[2]), hn::Sqrt(hn::Add(one, hn::MulAdd(x, x, hn::Mul(y, y)))));
    const Floats3 at = within(u, varying3(batch, 0, i));
    Rgba stored;
    if constexpr (texels) {
      stored = sample_cells(texture, cells, i);
    } else {
      stored = sample_3d(texture, at.x, at.y, at.z);
    }
    const Floats tau = hn::Mul(stored.a, scale);
    const Floats alpha = opacity_of<linear_opacity>(hn::Mul(tau, len));
    Floats3 emission = scaled(colour_of(stored), scale);
    if constexpr (lit) {
      if (!all_zero(alpha)) {
        const auto& vm = *reinterpret_cast<const VolumeUniforms*>(bindings.buffers[0].data);
        const Floats ambient = splat(vm.lighting[0]), zero = splat(0.F);
        Light3 light{{ambient, ambient, ambient}, {zero, zero, zero}};
        add_lights(vm, normal_of(vm, world_gradient<texels>(u, texture, batch, i, at)), varying3(batch, 3, i), light);
        emission = along(emission * light.diffuse, tau, light.specular);
      }
    }
    const auto seen = hn::Gt(tau, tiny);
    const Floats weight = hn::IfThenElse(seen, hn::Div(alpha, hn::IfThenElse(seen, tau, one)), len);
    store_rgba(batch, i, with_alpha(scaled(emission, weight), alpha));
  });
}

template <bool linear_opacity, bool lit>
void fragment(const CpuBindings& bindings, FragmentBatch& batch) {
  if (fits_texels(bindings.textures[1])) return shade<linear_opacity, lit, true>(bindings, batch);
  shade<linear_opacity, lit, false>(bindings, batch);
}

// Constants in the order of their ids: volume_common.glsl, then those of shell_hardware.vert.
CpuKernels kernels_of(std::span<const int32_t> constants, CpuVertexKernel vertex) {
  const bool linear_opacity = constants[1] != 0;
  CpuKernels kernels;
  kernels.vertex = vertex;
  kernels.reads_front_facing = false;
  if (constants[2] > 0) {
    kernels.fragment = linear_opacity ? fragment<true, true> : fragment<false, true>;
    kernels.varyings = 15;
  } else {
    kernels.fragment = linear_opacity ? fragment<true, false> : fragment<false, false>;
    kernels.varyings = 3;
  }
  return kernels;
}

CpuKernels specialise_software(std::span<const int32_t> constants) {
  return kernels_of(constants, constants[2] > 0 ? software_vertex<true> : software_vertex<false>);
}
CpuKernels specialise_hybrid(std::span<const int32_t> constants) {
  return kernels_of(constants, constants[2] > 0 ? hybrid_vertex<true> : hybrid_vertex<false>);
}
CpuKernels specialise_hardware(std::span<const int32_t> constants) {
  const bool listed = constants[7] != 0;
  if (constants[2] > 0)
    return kernels_of(constants, listed ? hardware_vertex<true, true> : hardware_vertex<false, true>);
  return kernels_of(constants, listed ? hardware_vertex<true, false> : hardware_vertex<false, false>);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumark {
HWY_EXPORT(specialise_software);
HWY_EXPORT(specialise_hybrid);
HWY_EXPORT(specialise_hardware);
const CpuProgram shell_software_twin{
    "shell_software", [](std::span<const int32_t> c) { return HWY_DYNAMIC_DISPATCH(specialise_software)(c); }};
const CpuProgram shell_hybrid_twin{
    "shell_hybrid", [](std::span<const int32_t> c) { return HWY_DYNAMIC_DISPATCH(specialise_hybrid)(c); }};
const CpuProgram shell_hardware_twin{
    "shell_hardware", [](std::span<const int32_t> c) { return HWY_DYNAMIC_DISPATCH(specialise_hardware)(c); }};
}  // namespace volumark
#endif
