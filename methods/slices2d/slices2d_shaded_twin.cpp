// The CPU twin of slices2d.vert and slices2d_shaded.frag.
#include "methods/slices2d/slices2d_shaded.h"

// After the headers without Highway.
#include "backends/cpu/highway_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "methods/slices2d/slices2d_shaded_twin.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "methods/slices2d/slice_polygon-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {
namespace {

struct ShadedBindings : SliceBindings {
  PageBindings gradients;
  explicit ShadedBindings(const CpuBindings& bindings) : SliceBindings(bindings), gradients(bindings, 5) {}
};

// VM_NORMALS by the uniform that says the same: it decides too little to be worth twice the kernels.
HWY_INLINE Floats3 stored_normal(const VolumeUniforms& vm, const Rgba& texel) {
  const Floats scale = splat(vm.texel[0]), offset = splat(vm.texel[1]);
  const Floats3 vector{hn::MulAdd(texel.r, scale, offset), hn::MulAdd(texel.g, scale, offset),
                       hn::MulAdd(texel.b, scale, offset)};
  return vm.texel[2] > 0 ? vector : normal_of(vm, vector);
}

HWY_INLINE Light3 lit_from(const VolumeUniforms& vm, float ambient, const Rgba& texel, const Floats3& box) {
  const Floats start = splat(ambient), zero = splat(0.F);
  Light3 sum{{start, start, start}, {zero, zero, zero}};
  add_lights(vm, stored_normal(vm, texel), box, sum);
  return sum;
}

template <bool linear_opacity>
HWY_INLINE Rgba shade_full(const SliceBindings& b, const Rgba& texel, const Floats3& box, Floats length) {
  const Rgba point = transfer(b, normalised_value(b.vm, texel.a));
  const Floats alpha = opacity_of<linear_opacity>(hn::Mul(point.a, length)), zero = splat(0.F);
  if (all_zero(alpha)) return {zero, zero, zero, zero};
  const Light3 light = lit_from(b.vm, b.vm.lighting[0], texel, box);
  return with_alpha(scaled(colour_of(point) * light.diffuse + light.specular, alpha), alpha);
}

template <bool linear_opacity>
HWY_INLINE Rgba shade_gradient(const SliceBindings& b, const Rgba& texel, const Floats3& box, Floats length) {
  const Floats zero = splat(0.F);
  const auto seen = hn::Gt(texel.a, zero);
  if (hn::AllFalse(FloatTag(), seen)) return {zero, zero, zero, zero};
  const Floats alpha =
      hn::IfThenElseZero(seen, correct_opacity<linear_opacity>(texel.a, hn::Mul(length, splat(b.vm.size[3]))));
  return with_alpha(scaled(lit_from(b.vm, b.vm.lighting[0], texel, box).diffuse, alpha), alpha);
}

template <bool linear_opacity>
HWY_INLINE Rgba shade_separate(const SliceBindings& b, const Rgba& voxel, const Rgba& gradient, const Floats3& box,
                               Floats length) {
  const Rgba slice = shade_classified<linear_opacity>(b, voxel, length);
  if (all_zero(slice.a)) return slice;
  const Floats3 light = scaled(lit_from(b.vm, 0, gradient, box).diffuse, slice.a);
  return with_alpha(along(light, splat(b.vm.lighting[0]), colour_of(slice)), slice.a);
}

// `page`: of the first texture; `gradients`: of the second, form separate.
template <ShadedForm form, bool linear_opacity, bool interpolate, class Page, class Gradients>
HWY_NOINLINE void add_slice(const SliceBindings& b, const Page& page, const Gradients& gradients, const Rays& rays,
                            const Meets& meets, FragmentBatch& batch) {
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const Floats length = meets.length.get(i);
    if (all_zero(length)) return;
    const Floats k = rays.first.get(i);
    const Floats3 box{meets.x.get(i), meets.y.get(i), meets.z.get(i)};
    const Rgba texel = sample_slice<interpolate>(b.vm, page, k, box);
    if constexpr (form == ShadedForm::Separate) {
      const Rgba gradient = sample_slice<interpolate>(b.vm, gradients, k, box);
      store_rgba(batch, i, shade_separate<linear_opacity>(b, texel, gradient, box, length));
    } else if constexpr (form == ShadedForm::Gradient) {
      store_rgba(batch, i, shade_gradient<linear_opacity>(b, texel, box, length));
    } else {
      store_rgba(batch, i, shade_full<linear_opacity>(b, texel, box, length));
    }
  });
}

template <ShadedForm form, bool linear_opacity, bool interpolate>
void fragment(const CpuBindings& bindings, FragmentBatch& batch) {
  const ShadedBindings b(bindings);
  const bool vectors = b.gradients.page.format == Format::RGBA32F;
  each_texture<1, true>(b, batch, [&](const Rays& rays, const Meets& meets, float) HWY_ATTR {
    const auto add = [&](const auto& page, const auto& gradients) HWY_ATTR {
      add_slice<form, linear_opacity, interpolate>(b, page, gradients, rays, meets, batch);
    };
    if constexpr (form == ShadedForm::Separate) {
      vectors ? add(AnyPage{b}, VectorPage{b.gradients}) : add(AnyPage{b}, AnyPage{b.gradients});
    } else {
      vectors ? add(VectorPage{b}, nullptr) : add(AnyPage{b}, nullptr);
    }
  });
}

template <ShadedForm form>
CpuFragmentKernel of_form(bool linear_opacity, bool interpolate) {
  if (linear_opacity) return interpolate ? fragment<form, true, true> : fragment<form, true, false>;
  return interpolate ? fragment<form, false, true> : fragment<form, false, false>;
}

// Constants in the order of their ids: volume_common.glsl, slice_polygon.glsl, slices2d_shaded.frag.
CpuKernels specialise(std::span<const int32_t> constants) {
  const bool linear_opacity = constants[1] != 0, interpolate = constants[7] != 0;
  CpuKernels kernels;
  kernels.vertex = polygon_vertex;
  switch (static_cast<ShadedForm>(constants[9])) {
    case ShadedForm::Full:
      kernels.fragment = of_form<ShadedForm::Full>(linear_opacity, interpolate);
      break;
    case ShadedForm::Gradient:
      kernels.fragment = of_form<ShadedForm::Gradient>(linear_opacity, interpolate);
      break;
    case ShadedForm::Separate:
      kernels.fragment = of_form<ShadedForm::Separate>(linear_opacity, interpolate);
      break;
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
const CpuProgram slices2d_shaded_twin{
    "slices2d_shaded", [](std::span<const int32_t> constants) { return HWY_DYNAMIC_DISPATCH(specialise)(constants); }};
}  // namespace volumark
#endif
