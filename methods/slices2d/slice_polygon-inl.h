// The twin of slice_polygon.glsl on SIMD lanes, in phases over a batch of fragments: the rays once, then for each
// texture of the polygon where the ray meets the slice. Include inside a foreach_target file. Functions are of the file
// that includes it: not all of these are compiled alike (tests/defects).
#include "methods/slices2d/stack_page-inl.h"

#if defined(VOLUMARK_METHODS_SLICES2D_SLICE_POLYGON_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMARK_METHODS_SLICES2D_SLICE_POLYGON_INL_H_
#undef VOLUMARK_METHODS_SLICES2D_SLICE_POLYGON_INL_H_
#else
#define VOLUMARK_METHODS_SLICES2D_SLICE_POLYGON_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {

struct alignas(64) Lane {
  float at[kMaxBatch + kBatchPadding];
  HWY_INLINE Floats get(size_t i) const { return load(at + i); }
  HWY_INLINE void put(size_t i, Floats v) { store(v, at + i); }
};

// PolygonRay
struct Rays {
  Lane origin_x, origin_y, origin_z, direction_x, direction_y, direction_z;
  Lane begin, end, unit, inverse;
  Lane first, toward, count;
};
// Meeting
struct Meets {
  Lane face, x, y, z, length;
};

struct Slab {
  Floats middle, thickness;
};

struct SliceBindings : PageBindings {
  using PageBindings::PageBindings;
  HWY_INLINE Floats slice_position(Floats k) const { return hn::MulAdd(k, splat(vm.own[3][1]), splat(vm.own[3][0])); }
  HWY_INLINE Slab slab_of(Floats k) const {
    const Floats half = splat(.5F);
    const Floats low = hn::Max(slice_position(hn::Sub(k, half)), splat(0.F));
    const Floats high = hn::Min(slice_position(hn::Add(k, half)), splat(1.F));
    return {hn::Mul(half, hn::Add(low, high)), hn::Sub(high, low)};
  }
};

// slices2d.vert
static inline void polygon_vertex(const CpuBindings&, VertexBatch& batch) {
  for (size_t i = 0; i < batch.count; ++i) {
    const float* ndc = attribute_of(batch, 0, i);
    const float* group = attribute_of(batch, 1, i);
    const float position[4] = {ndc[0], ndc[1], .5F, 1.F};
    std::copy_n(position, 4, batch.position + 4 * i);
    std::copy_n(group, 2, batch.varyings + batch.varying_stride * i);
  }
}

// ---- Rays ----
static inline HWY_NOINLINE void locate(const SliceBindings& b, const FragmentBatch& batch, Rays& rays, Meets& meets) {
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
static inline HWY_NOINLINE void meet(const SliceBindings& b, const Rays& rays, float number, size_t size,
                                     Meets& meets) {
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
static inline HWY_NOINLINE void stay(const SliceBindings& b, const Rays& rays, float number, size_t size,
                                     Meets& meets) {
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
// The stored slices that make up a point, and the weight of the upper one.
struct Stored {
  Floats below, above, weight;
};
template <bool interpolate>
HWY_INLINE Stored stored_around(const VolumeUniforms& vm, Floats k, const Floats3& box) {
  const Floats first = splat(vm.own[2][3]), last = splat(vm.own[3][3]), one = splat(1.F);
  if constexpr (!interpolate) {
    const Floats place = hn::MulAdd(k, splat(vm.own[3][2]), splat(vm.own[0][2]));
    const Floats nearest = hn::Min(hn::Max(hn::Round(place), first), last);
    return {nearest, nearest, splat(0.F)};
  } else {
    const Floats place = hn::Mul(box.z, splat(vm.own[0][3]));
    const Floats below = hn::Min(hn::Max(hn::Floor(place), first), hn::Max(hn::Sub(last, one), first));
    return {below, hn::Min(hn::Add(below, one), last), clamp01(hn::Sub(place, below))};
  }
}

// `page`: ScalarPage or AnyPage.
template <bool interpolate, class Page>
HWY_INLINE Rgba sample_slice(const VolumeUniforms& vm, const Page& page, Floats k, const Floats3& box) {
  const Place at = place_in_slice(vm, box);
  const Stored stored = stored_around<interpolate>(vm, k, box);
  if constexpr (!interpolate) {
    return page(stored.below, at);
  } else {
    return mix(page(stored.below, at), page(stored.above, at), stored.weight);
  }
}

// ---- Combination ----
// `slice` over what the fragments have so far (their eq. 3 to 5).
HWY_INLINE void combine(FragmentBatch& batch, size_t i, const Rgba& slice) {
  const Floats through = hn::Sub(splat(1.F), slice.a);
  store_rgba(
      batch, i,
      {hn::MulAdd(through, load(batch.rgba[0] + i), slice.r), hn::MulAdd(through, load(batch.rgba[1] + i), slice.g),
       hn::MulAdd(through, load(batch.rgba[2] + i), slice.b), hn::MulAdd(through, load(batch.rgba[3] + i), slice.a)});
}

// main(): add(rays, meets, number) for each texture of the polygon, the farthest first. `writes_first`: add() stores a
// colour for every fragment where number is 0, instead of combining with nothing.
template <int textures, bool corrected, bool writes_first = false, class Add>
HWY_INLINE void each_texture(const SliceBindings& b, FragmentBatch& batch, const Add& add) {
  Rays rays;
  Meets meets;
  locate(b, batch, rays, meets);
  if constexpr (!writes_first) {
    const Floats zero = splat(0.F);
    for_lanes(batch.count, [&](size_t i) HWY_ATTR { store_rgba(batch, i, {zero, zero, zero, zero}); });
  }
  for (int i = 0; i < textures; ++i) {
    const auto number = static_cast<float>(i);
    if (corrected || i == 0) {
      meet(b, rays, number, batch.count, meets);
    } else {
      stay(b, rays, number, batch.count, meets);
    }
    add(rays, meets, number);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#endif
