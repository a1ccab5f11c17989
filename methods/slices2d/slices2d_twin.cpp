// The CPU twin of slices2d.vert and .frag, in phases over a batch of fragments (slice_polygon-inl.h).
#include "methods/slices2d/slices2d.h"

// After the headers without Highway.
#include "backends/cpu/highway_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "methods/slices2d/slices2d_twin.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "methods/slices2d/slice_polygon-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {
namespace {

// ---- One texture of the polygon, shaded and combined ----
// Of the slice on texture `number`: what is left of the rays' stretches where the polygon has so many slices.
HWY_INLINE Floats length_of(const Rays& rays, const Meets& meets, float number, size_t i) {
  return hn::IfThenElseZero(hn::Lt(splat(number), rays.count.get(i)), meets.length.get(i));
}
template <bool interpolate, class Page>
HWY_INLINE Rgba sample_at(const SliceBindings& b, const Page& page, const Rays& rays, const Meets& meets, float number,
                          size_t i) {
  const Floats k = hn::MulAdd(rays.toward.get(i), splat(number), rays.first.get(i));
  return sample_slice<interpolate>(b.vm, page, k, {meets.x.get(i), meets.y.get(i), meets.z.get(i)});
}

// Post-classified scalars in two phases: fetches wait for memory, the transfer function and the exponential for
// arithmetic; apart, each keeps more of them in flight.
template <bool interpolate, class Page>
HWY_NOINLINE void fetch_slice(const SliceBindings& b, const Page& page, const Rays& rays, const Meets& meets,
                              float number, size_t size, Lane& values) {
  for_lanes(size, [&](size_t i) HWY_ATTR {
    if (all_zero(length_of(rays, meets, number, i))) return;
    values.put(i, normalised_value(b.vm, sample_at<interpolate>(b, page, rays, meets, number, i).r));
  });
}
// `first`: nothing is there yet, and every fragment gets a colour.
template <bool linear_opacity, bool first>
HWY_NOINLINE void add_values(const SliceBindings& b, const Rays& rays, const Meets& meets, float number,
                             const Lane& values, FragmentBatch& batch) {
  const Floats zero = splat(0.F), one = splat(1.F);
  const auto add_nothing = [&](size_t i) HWY_ATTR {
    if constexpr (first) store_rgba(batch, i, {zero, zero, zero, zero});
  };
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const Floats length = length_of(rays, meets, number, i);
    if (all_zero(length)) return add_nothing(i);
    const Rgba point = transfer(b, values.get(i));
    if (all_zero(point.a)) return add_nothing(i);
    const Rgba slice = shade_segment<linear_opacity, false>(b, point, length, {one, one, one});
    if constexpr (first) {
      store_rgba(batch, i, slice);
    } else {
      combine(batch, i, slice);
    }
  });
}
template <bool linear_opacity>
HWY_NOINLINE void add_classified(const SliceBindings& b, const AnyPage& page, const Rays& rays, const Meets& meets,
                                 float number, bool interpolate, FragmentBatch& batch) {
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const Floats length = length_of(rays, meets, number, i);
    if (all_zero(length)) return;
    const Rgba texel = interpolate ? sample_at<true>(b, page, rays, meets, number, i)
                                   : sample_at<false>(b, page, rays, meets, number, i);
    combine(batch, i, shade_classified<linear_opacity>(b, texel, length));
  });
}

template <bool interpolate>
HWY_INLINE void fetch_slice_of(const SliceBindings& b, const Rays& rays, const Meets& meets, float number, size_t size,
                               Lane& values) {
  switch (b.page.format) {
    case Format::R8:
      return fetch_slice<interpolate>(b, ScalarPage<Format::R8>{b}, rays, meets, number, size, values);
    case Format::R16:
      return fetch_slice<interpolate>(b, ScalarPage<Format::R16>{b}, rays, meets, number, size, values);
    case Format::R32F:
      return fetch_slice<interpolate>(b, ScalarPage<Format::R32F>{b}, rays, meets, number, size, values);
    default:
      return fetch_slice<interpolate>(b, AnyPage{b}, rays, meets, number, size, values);
  }
}

template <bool pre, bool linear_opacity, bool interpolate, int textures, bool corrected>
void fragment(const CpuBindings& bindings, FragmentBatch& batch) {
  const SliceBindings b(bindings);
  each_texture<textures, corrected, !pre>(b, batch, [&](const Rays& rays, const Meets& meets, float number) HWY_ATTR {
    if constexpr (pre) {
      add_classified<linear_opacity>(b, AnyPage{b}, rays, meets, number, interpolate, batch);
    } else {
      Lane values;
      fetch_slice_of<interpolate>(b, rays, meets, number, batch.count, values);
      if (number == 0) {
        add_values<linear_opacity, true>(b, rays, meets, number, values, batch);
      } else {
        add_values<linear_opacity, false>(b, rays, meets, number, values, batch);
      }
    }
  });
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

// Constants in the order of their ids: volume_common.glsl, slice_polygon.glsl.
CpuKernels specialise(std::span<const int32_t> constants) {
  const bool pre = constants[0] == 1, linear_opacity = constants[1] != 0;
  const int textures = constants[6];
  const bool interpolate = constants[7] != 0, corrected = constants[8] != 0;
  CpuKernels kernels;
  kernels.vertex = polygon_vertex;
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
