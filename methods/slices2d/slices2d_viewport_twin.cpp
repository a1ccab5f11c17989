// The CPU twin of strips.vert and slices2d_viewport.frag.
#include "methods/slices2d/slices2d_viewport.h"

// After the headers without Highway.
#include "backends/cpu/highway_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "methods/slices2d/slices2d_viewport_twin.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "methods/slices2d/stack_page-inl.h"
#include "methods/slices2d/strips-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {
namespace {

enum Slab { kWhole, kInBox, kInBoxAndPlanes };  // VM_CLIP_SLABS, and VM_CLIP_PLANES where it is on

template <bool pre, bool linear_opacity, Slab slab, bool corner_weights, class Page>
HWY_NOINLINE void shade(const PageBindings& b, const Page& page, FragmentBatch& batch) {
  const VolumeUniforms& vm = b.vm;
  const Floats zero = splat(0.F), half = splat(.5F), one = splat(1.F);
  const Floats intervals = splat(vm.own[0][3]), page_first = splat(vm.own[2][3]), page_last = splat(vm.own[3][3]);
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const Floats x = hn::MulAdd(load(batch.x + i), splat(vm.own[0][0]), splat(-1.F));
    const Floats y = hn::MulAdd(load(batch.y + i), splat(vm.own[0][1]), one);
    const Floats3 direction = ray_direction(vm, x, y);
    Floats3 box = along(ray_origin(vm, x, y), load(batch.varyings[0] + i), direction);
    Floats below = hn::Floor(hn::Add(load(batch.varyings[1] + i), half));
    Floats weight = corner_weights ? load(batch.varyings[2] + i) : hn::MulSub(box.z, intervals, below);
    Floats len = splat(vm.depth[3]);
    if constexpr (slab != kWhole) {
      Floats z0 = hn::Mul(splat(-.5F), len), z1 = hn::Mul(half, len);
      clip_ray<slab == kInBoxAndPlanes>(vm, box, direction, z0, z1);
      const auto hits = hn::Lt(z0, z1);
      z0 = hn::IfThenElseZero(hits, z0);
      z1 = hn::IfThenElseZero(hits, z1);
      len = hn::Sub(z1, z0);
      const Floats moved = hn::Mul(half, hn::Add(z0, z1));
      box = along(box, moved, direction);
      weight = hn::MulAdd(hn::Mul(moved, direction.z), intervals, weight);
      const Floats other = hn::IfThenElse(hn::Eq(moved, zero), below, hn::Add(below, hn::Floor(weight)));
      const Floats there = hn::Min(hn::Max(other, zero), hn::Max(hn::Sub(intervals, one), zero));
      weight = hn::Sub(weight, hn::Sub(there, below));
      below = there;
      const Floats end = splat(vm.own[3][3] - (vm.own[3][3] < vm.own[0][3] ? 1.F : -1.F));
      len = hn::IfThenElseZero(hn::And(hn::Ge(below, page_first), hn::Lt(below, end)), len);
    }
    below = hn::Min(hn::Max(below, page_first), page_last);
    const Place at = place_in_slice(vm, box);
    const Rgba texel = mix(page(below, at), page(hn::Min(hn::Add(below, one), page_last), at), clamp01(weight));
    len = hn::Mul(len, ray_length(vm, direction));
    if constexpr (pre) {
      store_rgba(batch, i, shade_classified<linear_opacity>(b, texel, len));
    } else {
      const Rgba point = transfer(b, normalised_value(vm, texel.r));
      store_rgba(batch, i, shade_segment<linear_opacity, false>(b, point, len, box));
    }
  });
}

template <bool pre, bool linear_opacity, Slab slab, bool corner_weights>
void fragment(const CpuBindings& bindings, FragmentBatch& batch) {
  const PageBindings b(bindings);
  if constexpr (!pre) {
    switch (b.page.format) {
      case Format::R8:
        return shade<pre, linear_opacity, slab, corner_weights>(b, ScalarPage<Format::R8>{b}, batch);
      case Format::R16:
        return shade<pre, linear_opacity, slab, corner_weights>(b, ScalarPage<Format::R16>{b}, batch);
      case Format::R32F:
        return shade<pre, linear_opacity, slab, corner_weights>(b, ScalarPage<Format::R32F>{b}, batch);
      default:
        break;
    }
  }
  shade<pre, linear_opacity, slab, corner_weights>(b, AnyPage{b}, batch);
}

template <bool pre, bool linear_opacity, Slab slab>
CpuFragmentKernel with_weights(bool corners) {
  return corners ? fragment<pre, linear_opacity, slab, true> : fragment<pre, linear_opacity, slab, false>;
}
template <bool pre, bool linear_opacity>
CpuFragmentKernel with_slabs(Slab slab, bool corners) {
  switch (slab) {
    case kWhole:
      return with_weights<pre, linear_opacity, kWhole>(corners);
    case kInBox:
      return with_weights<pre, linear_opacity, kInBox>(corners);
    default:
      return with_weights<pre, linear_opacity, kInBoxAndPlanes>(corners);
  }
}

// Constants in the order of their ids: volume_common.glsl, then VM_CLIP_SLABS, VM_CORNER_WEIGHTS.
CpuKernels specialise(std::span<const int32_t> constants) {
  const bool pre = constants[0] == 1, linear_opacity = constants[1] != 0, corners = constants[7] != 0;
  const Slab slab = constants[6] == 0 ? kWhole : constants[5] > 0 ? kInBoxAndPlanes : kInBox;
  CpuKernels kernels;
  kernels.vertex = strip_vertex;
  if (pre) {
    kernels.fragment = linear_opacity ? with_slabs<true, true>(slab, corners) : with_slabs<true, false>(slab, corners);
  } else {
    kernels.fragment =
        linear_opacity ? with_slabs<false, true>(slab, corners) : with_slabs<false, false>(slab, corners);
  }
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
const CpuProgram slices2d_viewport_twin{"slices2d_viewport", [](std::span<const int32_t> constants) {
                                          return HWY_DYNAMIC_DISPATCH(specialise)(constants);
                                        }};
}  // namespace volumark
#endif
