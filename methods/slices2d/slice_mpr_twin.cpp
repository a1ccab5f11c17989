// The CPU twin of strips.vert and slice_mpr.frag.
#include "methods/slices2d/slice_mpr.h"

// After the headers without Highway.
#include "backends/cpu/highway_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "methods/slices2d/slice_mpr_twin.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "methods/slices2d/stack_page-inl.h"
#include "methods/slices2d/strips-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {
namespace {

enum Stored { kNearest, kOfPlace, kOfCorners };  // VM_INTERPOLATE, VM_CORNER_WEIGHTS

template <bool pre, Stored stored, bool clip_planes, class Page>
HWY_NOINLINE void shade(const PageBindings& b, const Page& page, FragmentBatch& batch) {
  const VolumeUniforms& vm = b.vm;
  const Floats one = splat(1.F), zero = splat(0.F);
  const Floats page_first = splat(vm.own[2][3]), page_last = splat(vm.own[3][3]);
  const Floats3 normal = splat3(vm.own[3]);
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const Floats x = hn::MulAdd(load(batch.x + i), splat(vm.own[0][0]), splat(-1.F));
    const Floats y = hn::MulAdd(load(batch.y + i), splat(vm.own[0][1]), one);
    const Floats3 direction = ray_direction(vm, x, y), origin = ray_origin(vm, x, y);
    const Floats slope = dot(normal, direction), tiny = splat(1e-20F);
    const Floats z = hn::Div(hn::Sub(splat(vm.own[0][2]), dot(normal, origin)),
                             hn::IfThenElse(hn::Lt(hn::Abs(slope), tiny), tiny, slope));
    const Floats3 box = along(origin, z, direction);
    const Floats first = hn::Floor(hn::Add(load(batch.varyings[1] + i), splat(.5F)));
    const Floats below = hn::Min(hn::Max(first, page_first), page_last);
    const Place at = place_in_slice(vm, box);
    Rgba texel = page(below, at);
    if constexpr (stored != kNearest) {
      const Floats weight =
          stored == kOfCorners ? load(batch.varyings[2] + i) : hn::MulSub(box.z, splat(vm.own[0][3]), below);
      texel = mix(texel, page(hn::Min(hn::Add(below, one), page_last), at), clamp01(weight));
    }
    Rgba colour = pre ? texel : transfer(b, normalised_value(vm, texel.r));
    colour.a = one;
    if constexpr (clip_planes) {
      for (int k = 0; k < static_cast<int>(vm.counts[1]); ++k) {
        const auto cut = hn::Lt(dot(splat3(vm.clip_planes[k]), box), splat(vm.clip_planes[k][3]));
        colour = {hn::IfThenElse(cut, zero, colour.r), hn::IfThenElse(cut, zero, colour.g),
                  hn::IfThenElse(cut, zero, colour.b), hn::IfThenElse(cut, zero, colour.a)};
      }
    }
    store_rgba(batch, i, colour);
  });
}

template <bool pre, Stored stored, bool clip_planes>
void fragment(const CpuBindings& bindings, FragmentBatch& batch) {
  const PageBindings b(bindings);
  if constexpr (!pre) {
    switch (b.page.format) {
      case Format::R8:
        return shade<pre, stored, clip_planes>(b, ScalarPage<Format::R8>{b}, batch);
      case Format::R16:
        return shade<pre, stored, clip_planes>(b, ScalarPage<Format::R16>{b}, batch);
      case Format::R32F:
        return shade<pre, stored, clip_planes>(b, ScalarPage<Format::R32F>{b}, batch);
      default:
        break;
    }
  }
  shade<pre, stored, clip_planes>(b, AnyPage{b}, batch);
}

template <bool pre, Stored stored>
CpuFragmentKernel with_planes(bool clip_planes) {
  return clip_planes ? fragment<pre, stored, true> : fragment<pre, stored, false>;
}
template <bool pre>
CpuFragmentKernel with_stored(Stored stored, bool clip_planes) {
  switch (stored) {
    case kNearest:
      return with_planes<pre, kNearest>(clip_planes);
    case kOfPlace:
      return with_planes<pre, kOfPlace>(clip_planes);
    default:
      return with_planes<pre, kOfCorners>(clip_planes);
  }
}

// Constants in the order of their ids: volume_common.glsl, then VM_INTERPOLATE, VM_CORNER_WEIGHTS.
CpuKernels specialise(std::span<const int32_t> constants) {
  const Stored stored = constants[6] == 0 ? kNearest : constants[7] == 0 ? kOfPlace : kOfCorners;
  const bool clip_planes = constants[5] > 0;
  CpuKernels kernels;
  kernels.vertex = strip_vertex;
  kernels.fragment =
      constants[0] == 1 ? with_stored<true>(stored, clip_planes) : with_stored<false>(stored, clip_planes);
  kernels.varyings = 3;
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
const CpuProgram slice_mpr_twin{
    "slice_mpr", [](std::span<const int32_t> constants) { return HWY_DYNAMIC_DISPATCH(specialise)(constants); }};
}  // namespace volumark
#endif
