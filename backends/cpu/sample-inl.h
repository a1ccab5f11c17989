// Textures on SIMD lanes for CPU twins, per instruction set (include inside a foreach_target file). GLSL semantics:
// texel centres at (i + .5) / n, missing channels read 0 and alpha 1, border is transparent black.
//
// How a twin is laid out (methods/x/x_cpu.cpp; one file, compiled once an instruction set by foreach_target):
//
//   #include "methods/x/x_cpu.h"                 // declares `extern const CpuProgram x_cpu;`
//   #include "backends/cpu/highway_targets.h"    // before anything of Highway
//   #undef HWY_TARGET_INCLUDE
//   #define HWY_TARGET_INCLUDE "methods/x/x_cpu.cpp"
//   #include <hwy/foreach_target.h>              // includes this file again for every target
//   #include <hwy/highway.h>
//   #include "backends/cpu/sample-inl.h"
//   HWY_BEFORE_NAMESPACE();
//   namespace volumark {
//   namespace HWY_NAMESPACE {
//   namespace {
//   template <bool lit> void shade(const CpuBindings& bindings, FragmentBatch& batch) {
//     const FloatTag d;
//     const CpuTexture& volume = bindings.textures[1];
//     for_lanes(batch.count, [&](size_t i) HWY_ATTR {        // lambdas: HWY_ATTR before the brace
//       const Floats value = sample_3d_red(volume, load(batch.varyings[0] + i), load(batch.varyings[1] + i), ...);
//       store_rgba(batch, i, sample_1d(bindings.textures[2], value));
//     });
//   }
//   CpuKernels specialise(std::span<const int32_t> constants) {
//     return {.vertex = vertex, .fragment = constants[0] ? shade<true> : shade<false>, .varyings = 3};
//   }
//   }  // namespace
//   }  // namespace HWY_NAMESPACE
//   }  // namespace volumark
//   HWY_AFTER_NAMESPACE();
//   #if HWY_ONCE
//   namespace volumark {
//   HWY_EXPORT(specialise);
//   const CpuProgram x_cpu{"x", [](std::span<const int32_t> c) { return HWY_DYNAMIC_DISPATCH(specialise)(c); }};
//   }  // namespace volumark
//   #endif
//
// The lanes past batch.count up to the next multiple of the vector length are readable and writable: no masked tails.
#include <hwy/cache_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "backends/cpu/cpu_program.h"
#include "backends/cpu/texel.h"

#if defined(VOLUMARK_CPU_SAMPLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMARK_CPU_SAMPLE_INL_H_
#undef VOLUMARK_CPU_SAMPLE_INL_H_
#else
#define VOLUMARK_CPU_SAMPLE_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = HWY_CAPPED(float, 16);
using IntTag = hn::RebindToSigned<FloatTag>;
using Floats = hn::Vec<FloatTag>;
using Ints = hn::Vec<IntTag>;
using FloatMask = hn::Mask<FloatTag>;
inline constexpr size_t kMaxLanes = 16;

struct Rgba {
  Floats r, g, b, a;
};

// ---- Loops over a batch ---------------------------------------------------------------------------------------------

HWY_INLINE Floats load(const float* aligned) { return hn::Load(FloatTag(), aligned); }
HWY_INLINE void store(Floats value, float* aligned) { hn::Store(value, FloatTag(), aligned); }
HWY_INLINE Floats splat(float value) { return hn::Set(FloatTag(), value); }

// Towards zero, for values that an int32 holds: hn::ConvertTo spends four more instructions on those that it does not.
HWY_INLINE Ints truncate(Floats v) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3
  return Ints{_mm512_cvttps_epi32(v.raw)};
#elif HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
  return Ints{_mm256_cvttps_epi32(v.raw)};
#elif HWY_ARCH_X86 && HWY_TARGET <= HWY_SSE4
  return Ints{_mm_cvttps_epi32(v.raw)};
#else
  return hn::ConvertTo(IntTag(), v);
#endif
}

// Makes lanes that were just stored be read back one by one: extracting them from the vector, which the compiler would
// prefer, takes twice the instructions.
HWY_INLINE void keep_in_memory([[maybe_unused]] int32_t (&lanes)[kMaxLanes]) {
#if HWY_COMPILER_GCC || HWY_COMPILER_CLANG
  asm("" : "+m"(lanes));
#endif
}

// body(i) for i = 0, lanes, 2 lanes, ... below count.
template <class Body>
HWY_INLINE void for_lanes(size_t count, const Body& body) {
  for (size_t i = 0; i < count; i += hn::Lanes(FloatTag())) {
    body(i);
  }
}

HWY_INLINE void store_rgba(FragmentBatch& batch, size_t i, const Rgba& colour) {
  store(colour.r, batch.rgba[0] + i);
  store(colour.g, batch.rgba[1] + i);
  store(colour.b, batch.rgba[2] + i);
  store(colour.a, batch.rgba[3] + i);
}

// Sets batch.discard where `dropped` holds; lanes past the end of the batch are left alone.
HWY_INLINE void store_discard(FragmentBatch& batch, size_t i, FloatMask dropped) {
  const FloatTag d;
  alignas(64) float flag[kMaxLanes];
  hn::Store(hn::IfThenElseZero(dropped, hn::Set(d, 1.0F)), d, flag);
  const size_t end = std::min(hn::Lanes(d), batch.count - i);
  for (size_t lane = 0; lane < end; ++lane) {
    batch.discard[i + lane] |= static_cast<uint8_t>(flag[lane] != 0);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#include "backends/cpu/volume-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {

// ---- texelFetch -----------------------------------------------------------------------------------------------------

// Texels at `offset` (in texels from data); lanes where `inside` is false get transparent black (alpha 1 in formats
// without alpha) and are not read.
HWY_INLINE Rgba fetch_texels(const CpuTexture& texture, Ints offset, FloatMask inside) {
  const FloatTag d;
  const IntTag di;
  alignas(64) int32_t at[kMaxLanes];
  alignas(64) float channel[4][kMaxLanes];
  hn::Store(hn::IfThenElseZero(hn::RebindMask(di, inside), offset), di, at);
  cpu::decode_texels(texture, at, hn::Lanes(d), channel[0], channel[1], channel[2], channel[3]);
  const Floats missing = hn::Set(d, cpu::has_alpha(texture.format) ? 0.0F : 1.0F);
  return {hn::IfThenElseZero(inside, hn::Load(d, channel[0])), hn::IfThenElseZero(inside, hn::Load(d, channel[1])),
          hn::IfThenElseZero(inside, hn::Load(d, channel[2])),
          hn::IfThenElse(inside, hn::Load(d, channel[3]), missing)};
}

// texelFetch; integer coordinates outside the texture read its border value.
HWY_INLINE Rgba texel_fetch(const CpuTexture& texture, Ints x, Ints y, Ints z) {
  const FloatTag d;
  const IntTag di;
  const auto in = [&](Ints i, int n)
                      HWY_ATTR { return hn::And(hn::Gt(i, hn::Set(di, -1)), hn::Lt(i, hn::Set(di, n))); };
  const auto inside = hn::And(in(x, texture.width), hn::And(in(y, texture.height), in(z, texture.depth)));
  const Ints offset = hn::Add(x, hn::Add(hn::Mul(y, hn::Set(di, static_cast<int32_t>(texture.row_stride))),
                                         hn::Mul(z, hn::Set(di, static_cast<int32_t>(texture.slice_stride)))));
  return fetch_texels(texture, offset, hn::RebindMask(d, inside));
}
HWY_INLINE Rgba texel_fetch(const CpuTexture& texture, Ints x, Ints y) {
  return texel_fetch(texture, x, y, hn::Zero(IntTag()));
}

// ---- texture() ------------------------------------------------------------------------------------------------------

// The one or two texels along an axis and the weight of the second.
struct AxisCell {
  Ints i0, i1;
  Floats t;
};

HWY_INLINE AxisCell axis_cell(const Sampler& sampler, Floats coordinate, int extent) {
  const FloatTag d;
  const IntTag di;
  const Floats n = hn::Set(d, static_cast<float>(extent));
  const Ints last = hn::Set(di, extent - 1);
  const Ints zero = hn::Zero(di);
  Floats u = coordinate;
  if (sampler.wrap == Wrap::Repeat) {
    u = hn::Sub(u, hn::Floor(u));
  }
  Floats at = hn::Mul(u, n);
  if (sampler.filter == Filter::Linear) {
    at = hn::Sub(at, hn::Set(d, 0.5F));
  }
  // One texel outside on either side is enough to tell; keeps the conversion in range (NaN becomes -1).
  at = hn::Min(hn::Max(at, hn::Set(d, -1.0F)), n);
  const Floats floor = hn::Floor(at);
  Ints i0 = hn::ConvertTo(di, floor);
  Ints i1 = sampler.filter == Filter::Linear ? hn::Add(i0, hn::Set(di, 1)) : i0;
  if (sampler.wrap == Wrap::Repeat) {
    i0 = hn::IfThenElse(hn::Lt(i0, zero), last, i0);
    i0 = hn::IfThenElse(hn::Gt(i0, last), zero, i0);
    i1 = hn::IfThenElse(hn::Gt(i1, last), zero, i1);
    i1 = hn::Max(i1, zero);
  } else if (sampler.wrap == Wrap::Clamp) {
    i0 = hn::Min(hn::Max(i0, zero), last);
    i1 = hn::Min(hn::Max(i1, zero), last);
  }
  return {i0, i1, hn::Sub(at, floor)};
}

HWY_INLINE Rgba lerp(const Rgba& a, const Rgba& b, Floats t) {
  return {lerp(a.r, b.r, t), lerp(a.g, b.g, t), lerp(a.b, b.b, t), lerp(a.a, b.a, t)};
}

// Any format, filter and wrap; correct first. Axes past the texture's dimension are not looked at.
HWY_INLINE Rgba sample_any(const CpuTexture& texture, Floats u, Floats v, Floats w) {
  const Ints zero = hn::Zero(IntTag());
  const Sampler& s = texture.sampler;
  const bool linear = s.filter == Filter::Linear;
  const AxisCell none{zero, zero, hn::Zero(FloatTag())};
  const AxisCell x = axis_cell(s, u, texture.width);
  const AxisCell y = texture.dimension > 1 ? axis_cell(s, v, texture.height) : none;
  const AxisCell z = texture.dimension > 2 ? axis_cell(s, w, texture.depth) : none;
  const auto row = [&](Ints iy, Ints iz) HWY_ATTR {
    const Rgba first = texel_fetch(texture, x.i0, iy, iz);
    return linear ? lerp(first, texel_fetch(texture, x.i1, iy, iz), x.t) : first;
  };
  const auto plane = [&](Ints iz) HWY_ATTR {
    const Rgba first = row(y.i0, iz);
    return linear && texture.dimension > 1 ? lerp(first, row(y.i1, iz), y.t) : first;
  };
  const Rgba first = plane(z.i0);
  return linear && texture.dimension > 2 ? lerp(first, plane(z.i1), z.t) : first;
}

// A function of its own: the generic path is large, and kernels call it from several places.
HWY_NOINLINE inline void sample_any_into(const CpuTexture& texture, const float* uvw, float* rgba) {
  const Rgba c = sample_any(texture, load(uvw), load(uvw + kMaxLanes), load(uvw + 2 * kMaxLanes));
  store(c.r, rgba);
  store(c.g, rgba + kMaxLanes);
  store(c.b, rgba + 2 * kMaxLanes);
  store(c.a, rgba + 3 * kMaxLanes);
}

HWY_INLINE Rgba sample_generic(const CpuTexture& texture, Floats u, Floats v, Floats w) {
  alignas(64) float uvw[3 * kMaxLanes], rgba[4 * kMaxLanes];
  store(u, uvw);
  store(v, uvw + kMaxLanes);
  store(w, uvw + 2 * kMaxLanes);
  sample_any_into(texture, uvw, rgba);
  return {load(rgba), load(rgba + kMaxLanes), load(rgba + 2 * kMaxLanes), load(rgba + 3 * kMaxLanes)};
}

HWY_INLINE Rgba sample_2d(const CpuTexture& texture, Floats u, Floats v) {
  return sample_generic(texture, u, v, hn::Zero(FloatTag()));
}
HWY_INLINE Rgba sample_3d(const CpuTexture& texture, Floats u, Floats v, Floats w) {
  return sample_generic(texture, u, v, w);
}

// texture(volume, uvw).r: the fast path where the texture allows it. A kernel that knows the format calls
// sample_volume<format>() (volume-inl.h) and saves the branches.
HWY_INLINE Floats sample_3d_red(const CpuTexture& texture, Floats u, Floats v, Floats w) {
  if (fits_volume_view(texture)) {
    const VolumeView view = volume_view(texture);
    switch (texture.format) {
      case Format::R8:
        return sample_volume<Format::R8>(view, u, v, w);
      case Format::R16:
        return sample_volume<Format::R16>(view, u, v, w);
      default:
        return sample_volume<Format::R32F>(view, u, v, w);
    }
  }
  return sample_generic(texture, u, v, w).r;
}

// ---- Tables of RGBA32F entries (transfer functions) -----------------------------------------------------------------

// Entries `index` of a tight array of RGBA float quadruples: one 128-bit load a lane, then a transpose.
HWY_INLINE Rgba load_entries(const float* entries, Ints index) {
  const IntTag di;
  const FloatTag d;
  const hn::Full128<float> d4;
  alignas(64) int32_t at[kMaxLanes];
  alignas(64) float quad[4 * kMaxLanes];
  hn::Store(index, di, at);
  for (size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    hn::Store(hn::LoadU(d4, entries + 4 * static_cast<ptrdiff_t>(at[lane])), d4, quad + 4 * lane);
  }
  Floats r, g, b, a;
  hn::LoadInterleaved4(d, quad, r, g, b, a);
  return {r, g, b, a};
}

// entries[index] + t (entries[index + 1] - entries[index]): one 256-bit load a lane brings both entries, the
// interpolation is done on whole entries (four of them to a vector, one a 128-bit block) and the transpose comes last.
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
HWY_INLINE __m256 entry_pair(const std::byte* entries, int32_t offset) {
  return _mm256_loadu_ps(reinterpret_cast<const float*>(entries + offset));
}
#if HWY_TARGET <= HWY_AVX3
// Entries of lanes k, 4 + k, 8 + k, 12 + k, interpolated.
template <int k>
HWY_INLINE __m512 lerp_four_entries(const std::byte* entries, const int32_t* offset, __m512 t) {
  const auto two = [&](int a, int b) HWY_ATTR {
    return _mm512_insertf32x8(_mm512_castps256_ps512(entry_pair(entries, offset[a])), entry_pair(entries, offset[b]),
                              1);
  };
  const __m512 low = two(k, 4 + k), high = two(8 + k, 12 + k);
  const __m512 first = _mm512_shuffle_f32x4(low, high, 0x88), second = _mm512_shuffle_f32x4(low, high, 0xDD);
  return _mm512_fmadd_ps(_mm512_shuffle_ps(t, t, k * 0x55), _mm512_sub_ps(second, first), first);
}
#else
template <int k>
HWY_INLINE __m256 lerp_four_entries(const std::byte* entries, const int32_t* offset, __m256 t) {
  const __m256 low = entry_pair(entries, offset[k]), high = entry_pair(entries, offset[4 + k]);
  const __m256 first = _mm256_permute2f128_ps(low, high, 0x20), second = _mm256_permute2f128_ps(low, high, 0x31);
  return _mm256_fmadd_ps(_mm256_shuffle_ps(t, t, k * 0x55), _mm256_sub_ps(second, first), first);
}
#endif
HWY_INLINE Rgba lerp_entries(const float* entries, Ints index, Floats t) {
  const FloatTag d;
  const hn::Repartition<double, FloatTag> d64;
  alignas(64) int32_t at[kMaxLanes];
  hn::Store(hn::ShiftLeft<4>(index), IntTag(), at);
  keep_in_memory(at);
  const auto* bytes = reinterpret_cast<const std::byte*>(entries);
  const Floats e0{lerp_four_entries<0>(bytes, at, t.raw)}, e1{lerp_four_entries<1>(bytes, at, t.raw)};
  const Floats e2{lerp_four_entries<2>(bytes, at, t.raw)}, e3{lerp_four_entries<3>(bytes, at, t.raw)};
  // Transposes every 4 x 4 block.
  const auto rg01 = hn::BitCast(d64, hn::InterleaveLower(d, e0, e1)),
             rg23 = hn::BitCast(d64, hn::InterleaveLower(d, e2, e3));
  const auto ba01 = hn::BitCast(d64, hn::InterleaveUpper(d, e0, e1)),
             ba23 = hn::BitCast(d64, hn::InterleaveUpper(d, e2, e3));
  return {hn::BitCast(d, hn::InterleaveLower(d64, rg01, rg23)), hn::BitCast(d, hn::InterleaveUpper(d64, rg01, rg23)),
          hn::BitCast(d, hn::InterleaveLower(d64, ba01, ba23)), hn::BitCast(d, hn::InterleaveUpper(d64, ba01, ba23))};
}
#else
HWY_INLINE Rgba lerp_entries(const float* entries, Ints index, Floats t) {
  return lerp(load_entries(entries, index), load_entries(entries + 4, index), t);
}
#endif

// texture(sampler1D, u): linear and clamped RGBA32F tables by entry, everything else generic.
HWY_INLINE Rgba sample_1d(const CpuTexture& texture, Floats u) {
  if (texture.format == Format::RGBA32F && texture.sampler == Sampler{Filter::Linear, Wrap::Clamp}) {
    const FloatTag d;
    const auto* entries = reinterpret_cast<const float*>(texture.data);
    const Floats n = hn::Set(d, static_cast<float>(texture.width));
    const Floats at = hn::Min(hn::Max(hn::MulSub(u, n, hn::Set(d, 0.5F)), hn::Zero(d)), hn::Sub(n, splat(1.0F)));
    const Ints i = truncate(at);
    // The entry past the last one is padding that repeats the edge.
    return lerp_entries(entries, i, hn::Sub(at, hn::ConvertTo(d, i)));
  }
  const Floats zero = hn::Zero(FloatTag());
  return sample_generic(texture, u, zero, zero);
}

}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#endif
