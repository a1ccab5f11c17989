// The CPU twin of slices2d.vert and .frag, in phases over a batch of fragments: the rays once, then for each texture of
// the polygon where the ray meets the slice, the fetch, the transfer function and the combination.
#include "methods/slices2d/slices2d.h"

// After the headers without Highway.
#include "backends/cpu/highway_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "methods/slices2d/slices2d_twin.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "methods/volume/volume_twin-inl.h"

// After the sampler it is made of.
#include "methods/slices2d/tile_fetch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {
namespace {

struct alignas(64) Lane {
  float at[kMaxBatch + kBatchPadding];
  HWY_INLINE Floats get(size_t i) const { return load(at + i); }
  HWY_INLINE void put(size_t i, Floats v) { store(v, at + i); }
};

// What main() of the fragment program keeps of the ray and the polygon.
struct Rays {
  Lane origin_x, origin_y, origin_z, direction_x, direction_y, direction_z;
  Lane begin, end, unit, inverse;
  Lane first, toward, count;
};
// Of one slice.
struct Meets {
  Lane face, x, y, z, length;
};

struct Slab {
  Floats middle, thickness;
};

struct SliceBindings : VolumeBindings {
  const CpuTexture& page;
  explicit SliceBindings(const CpuBindings& bindings) : VolumeBindings(bindings), page(bindings.textures[4]) {}
  HWY_INLINE Floats slice_position(Floats k) const { return hn::MulAdd(k, splat(vm.own[3][1]), splat(vm.own[3][0])); }
  HWY_INLINE Slab slab_of(Floats k) const {
    const Floats half = splat(.5F);
    const Floats low = hn::Max(slice_position(hn::Sub(k, half)), splat(0.F));
    const Floats high = hn::Min(slice_position(hn::Add(k, half)), splat(1.F));
    return {hn::Mul(half, hn::Add(low, high)), hn::Sub(high, low)};
  }
};

void vertex(const CpuBindings&, VertexBatch& batch) {
  for (size_t i = 0; i < batch.count; ++i) {
    const float* ndc = attribute_of(batch, 0, i);
    const float* group = attribute_of(batch, 1, i);
    const float position[4] = {ndc[0], ndc[1], .5F, 1.F};
    std::copy_n(position, 4, batch.position + 4 * i);
    std::copy_n(group, 2, batch.varyings + batch.varying_stride * i);
  }
}

// ---- Rays ----
HWY_NOINLINE void locate(const SliceBindings& b, const FragmentBatch& batch, Rays& rays, Meets& meets) {
  const VolumeUniforms& vm = b.vm;
  const Floats half = splat(.5F), one = splat(1.F);
  const bool clips = vm.counts[1] > 0;
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const Floats x = hn::MulAdd(load(batch.x + i), splat(vm.own[0][0]), splat(-1.F));
    const Floats y = hn::MulAdd(load(batch.y + i), splat(vm.own[0][1]), one);
    const Floats3 origin = ray_origin(vm, x, y), direction = ray_direction(vm, x, y);
    Floats z0 = splat(vm.depth[0]), z1 = splat(1e30F);
    if (clips) {
      clip_ray<true>(vm, origin, direction, z0, z1);
    } else {
      clip_ray<false>(vm, origin, direction, z0, z1);
    }
    const Floats tiny = splat(1e-20F);
    const Floats inverse = hn::Div(one, hn::IfThenElse(hn::Lt(hn::Abs(direction.z), tiny), tiny, direction.z));
    const Floats first = hn::Floor(hn::Add(load(batch.varyings[0] + i), half));
    const Floats count = load(batch.varyings[1] + i);
    const Floats toward = hn::CopySign(one, count);
    rays.origin_x.put(i, origin.x);
    rays.origin_y.put(i, origin.y);
    rays.origin_z.put(i, origin.z);
    rays.direction_x.put(i, direction.x);
    rays.direction_y.put(i, direction.y);
    rays.direction_z.put(i, direction.z);
    rays.begin.put(i, z0);
    rays.end.put(i, z1);
    rays.unit.put(i, ray_length(vm, direction));
    rays.inverse.put(i, inverse);
    rays.first.put(i, first);
    rays.toward.put(i, toward);
    rays.count.put(i, hn::Floor(hn::Add(hn::Abs(count), half)));
    const Floats face = b.slice_position(hn::NegMulAdd(half, toward, first));
    meets.face.put(i, hn::Mul(hn::Sub(face, origin.z), inverse));
  });
}

// The stretch of the rays in the slab of their slice number `number`, and where they meet the slice.
HWY_NOINLINE void meet(const SliceBindings& b, const Rays& rays, float number, size_t size, Meets& meets) {
  const Floats half = splat(.5F);
  for_lanes(size, [&](size_t i) HWY_ATTR {
    const Floats toward = rays.toward.get(i), inverse = rays.inverse.get(i), origin_z = rays.origin_z.get(i);
    const Floats k = hn::MulAdd(toward, splat(number), rays.first.get(i));
    const Floats face = meets.face.get(i);
    const Floats next = hn::Mul(hn::Sub(b.slice_position(hn::MulAdd(half, toward, k)), origin_z), inverse);
    const Floats begin = hn::Max(rays.begin.get(i), hn::Min(face, next));
    const Floats end = hn::Min(rays.end.get(i), hn::Max(face, next));
    meets.face.put(i, next);
    const Floats middle = hn::Mul(half, hn::Add(begin, end));
    meets.x.put(i, hn::MulAdd(middle, rays.direction_x.get(i), rays.origin_x.get(i)));
    meets.y.put(i, hn::MulAdd(middle, rays.direction_y.get(i), rays.origin_y.get(i)));
    meets.z.put(i, hn::MulAdd(middle, rays.direction_z.get(i), origin_z));
    const Floats length = hn::Mul(hn::Sub(end, begin), rays.unit.get(i));
    meets.length.put(i, hn::IfThenElseZero(hn::Lt(begin, end), length));
  });
}

// The same slices on the next texture, drawn where the one before is: of their own thickness.
HWY_NOINLINE void stay(const SliceBindings& b, const Rays& rays, float number, size_t size, Meets& meets) {
  for_lanes(size, [&](size_t i) HWY_ATTR {
    const Floats toward = rays.toward.get(i);
    const Floats k = hn::MulAdd(toward, splat(number), rays.first.get(i));
    const Slab slab = b.slab_of(k);
    const Floats ratio = hn::Div(slab.thickness, b.slab_of(hn::Sub(k, toward)).thickness);
    meets.length.put(i, hn::Mul(meets.length.get(i), ratio));
    meets.z.put(i, slab.middle);
  });
}

// ---- Sampling ----
// A tile of the page, in texels.
struct Tile {
  Floats x, y;
};
HWY_INLINE Tile tile_of(const VolumeUniforms& vm, float width, float height, Floats stored) {
  const Floats place = hn::Sub(stored, splat(vm.own[2][3])), columns = splat(vm.own[2][2]);
  const Floats row = hn::Floor(hn::Div(hn::Add(place, splat(.5F)), columns));
  return {hn::Mul(hn::NegMulAdd(row, columns, place), splat(width)), hn::Mul(row, splat(height))};
}

// Scalars of R8, R16 and R32F by the fast path; everything else by the general sampler.
template <Format format>
struct ScalarPage {
  const SliceBindings& b;
  // Texel coordinates (centre of texel i at i) in the tile of a point of the slice.
  HWY_INLINE Rgba operator()(Floats stored, Floats x, Floats y) const {
    const VolumeUniforms& vm = b.vm;
    const IntTag di;
    const FloatTag d;
    const Tile tile = tile_of(vm, vm.size[0] + 2, vm.size[1] + 2, stored);
    const Floats tx = hn::MulAdd(x, splat(vm.size[0]), splat(.5F)), ty = hn::MulAdd(y, splat(vm.size[1]), splat(.5F));
    const Ints ix = truncate(tx), iy = truncate(ty);
    const Ints row = hn::Add(iy, truncate(tile.y));
    const Ints at =
        hn::Add(hn::Add(ix, truncate(tile.x)), hn::Mul(row, hn::Set(di, static_cast<int32_t>(b.page.row_stride))));
    alignas(64) int32_t index[kMaxLanes];
    hn::Store(at, di, index);
    keep_in_memory(index);
    const TileCells cells{b.page.data, b.page.row_stride, index, hn::Sub(tx, hn::ConvertTo(d, ix)),
                          hn::Sub(ty, hn::ConvertTo(d, iy))};
    const Floats value = fetch_tile<format>(cells);
    return {value, value, value, value};
  }
};

struct AnyPage {
  const SliceBindings& b;
  HWY_INLINE Rgba operator()(Floats stored, Floats x, Floats y) const {
    const VolumeUniforms& vm = b.vm;
    const Tile tile = tile_of(vm, vm.own[1][0], vm.own[1][1], stored);
    return sample_2d(b.page, hn::MulAdd(x, splat(vm.own[1][2]), hn::Add(tile.x, splat(vm.own[2][0]))),
                     hn::MulAdd(y, splat(vm.own[1][3]), hn::Add(tile.y, splat(vm.own[2][1]))));
  }
};

template <bool interpolate, class Page>
HWY_INLINE Rgba sample_slice(const VolumeUniforms& vm, const Page& page, Floats k, const Floats3& box) {
  const Floats first = splat(vm.own[2][3]), last = splat(vm.own[3][3]), one = splat(1.F);
  const Floats ax = hn::MulAdd(clamp01(box.x), splat(vm.texture_scale[0]), splat(vm.texture_offset[0]));
  const Floats ay = hn::MulAdd(clamp01(box.y), splat(vm.texture_scale[1]), splat(vm.texture_offset[1]));
  if constexpr (!interpolate) {
    const Floats stored = hn::MulAdd(k, splat(vm.own[3][2]), splat(vm.own[0][2]));
    return page(hn::Min(hn::Max(hn::Round(stored), first), last), ax, ay);
  } else {
    const Floats stored = hn::Mul(box.z, splat(vm.own[0][3]));
    const Floats below = hn::Min(hn::Max(hn::Floor(stored), first), hn::Max(hn::Sub(last, one), first));
    const Floats above = hn::Min(hn::Add(below, one), last);
    return mix(page(below, ax, ay), page(above, ax, ay), clamp01(hn::Sub(stored, below)));
  }
}

// ---- One texture of the polygon, shaded and combined ----
template <bool pre, bool linear_opacity, bool interpolate, class Page>
HWY_NOINLINE void add_slice(const SliceBindings& b, const Page& page, const Rays& rays, const Meets& meets,
                            float number, FragmentBatch& batch) {
  const Floats one = splat(1.F);
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const auto drawn = hn::Lt(splat(number), rays.count.get(i));
    const Floats length = hn::IfThenElseZero(drawn, meets.length.get(i));
    if (all_zero(length)) return;
    const Floats k = hn::MulAdd(rays.toward.get(i), splat(number), rays.first.get(i));
    const Rgba texel = sample_slice<interpolate>(b.vm, page, k, {meets.x.get(i), meets.y.get(i), meets.z.get(i)});
    Rgba slice;
    if constexpr (pre) {
      slice = shade_classified<linear_opacity>(b, texel, length);
    } else {
      const Rgba point = transfer(b, normalised_value(b.vm, texel.r));
      slice = shade_segment<linear_opacity, false>(b, point, length, {one, one, one});
    }
    const Floats through = hn::Sub(one, slice.a);
    store_rgba(
        batch, i,
        {hn::MulAdd(through, load(batch.rgba[0] + i), slice.r), hn::MulAdd(through, load(batch.rgba[1] + i), slice.g),
         hn::MulAdd(through, load(batch.rgba[2] + i), slice.b), hn::MulAdd(through, load(batch.rgba[3] + i), slice.a)});
  });
}

template <bool pre, bool linear_opacity, bool interpolate>
HWY_INLINE void add_slice_of(const SliceBindings& b, const Rays& rays, const Meets& meets, float number,
                             FragmentBatch& batch) {
  if constexpr (!pre) {
    switch (b.page.format) {
      case Format::R8:
        return add_slice<pre, linear_opacity, interpolate>(b, ScalarPage<Format::R8>{b}, rays, meets, number, batch);
      case Format::R16:
        return add_slice<pre, linear_opacity, interpolate>(b, ScalarPage<Format::R16>{b}, rays, meets, number, batch);
      case Format::R32F:
        return add_slice<pre, linear_opacity, interpolate>(b, ScalarPage<Format::R32F>{b}, rays, meets, number, batch);
      default:
        break;
    }
  }
  add_slice<pre, linear_opacity, interpolate>(b, AnyPage{b}, rays, meets, number, batch);
}

template <bool pre, bool linear_opacity, bool interpolate, int textures, bool corrected>
void fragment(const CpuBindings& bindings, FragmentBatch& batch) {
  const SliceBindings b(bindings);
  Rays rays;
  Meets meets;
  locate(b, batch, rays, meets);
  const Floats zero = splat(0.F);
  for_lanes(batch.count, [&](size_t i) HWY_ATTR { store_rgba(batch, i, {zero, zero, zero, zero}); });
  for (int i = 0; i < textures; ++i) {
    const auto number = static_cast<float>(i);
    if (corrected || i == 0) {
      meet(b, rays, number, batch.count, meets);
    } else {
      stay(b, rays, number, batch.count, meets);
    }
    add_slice_of<pre, linear_opacity, interpolate>(b, rays, meets, number, batch);
  }
}

template <bool pre, bool linear_opacity, bool interpolate>
CpuFragmentKernel with_textures(int textures, bool corrected) {
  switch (textures) {
    case 1:
      return fragment<pre, linear_opacity, interpolate, 1, true>;
    case 2:
      return corrected ? fragment<pre, linear_opacity, interpolate, 2, true>
                       : fragment<pre, linear_opacity, interpolate, 2, false>;
    default:
      return corrected ? fragment<pre, linear_opacity, interpolate, 4, true>
                       : fragment<pre, linear_opacity, interpolate, 4, false>;
  }
}
template <bool pre, bool linear_opacity>
CpuFragmentKernel with_interpolation(bool interpolate, int textures, bool corrected) {
  return interpolate ? with_textures<pre, linear_opacity, true>(textures, corrected)
                     : with_textures<pre, linear_opacity, false>(textures, corrected);
}

// Constants in the order of their ids: volume_common.glsl, then VM_TEXTURES, VM_INTERPOLATE, VM_CORRECTED.
CpuKernels specialise(std::span<const int32_t> constants) {
  const bool pre = constants[0] == 1, linear_opacity = constants[1] != 0;
  const int textures = constants[6];
  const bool interpolate = constants[7] != 0, corrected = constants[8] != 0;
  CpuKernels kernels;
  kernels.vertex = vertex;
  if (pre) {
    kernels.fragment = linear_opacity ? with_interpolation<true, true>(interpolate, textures, corrected)
                                      : with_interpolation<true, false>(interpolate, textures, corrected);
  } else {
    kernels.fragment = linear_opacity ? with_interpolation<false, true>(interpolate, textures, corrected)
                                      : with_interpolation<false, false>(interpolate, textures, corrected);
  }
  kernels.varyings = 2;
  kernels.reads_front_facing = false;
  return kernels;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumark {
HWY_EXPORT(specialise);
const CpuProgram slices2d_twin{
    "slices2d", [](std::span<const int32_t> constants) { return HWY_DYNAMIC_DISPATCH(specialise)(constants); }};
}  // namespace volumark
#endif
