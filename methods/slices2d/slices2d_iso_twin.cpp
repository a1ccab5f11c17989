// The CPU twin of slices2d_iso.vert and .frag, in phases over a batch of fragments: the stretches, the texels at their
// ends and where the surface is met; then the light, of the fragments that show it alone.
#include "methods/slices2d/slices2d_iso.h"

// After the headers without Highway.
#include "backends/cpu/highway_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "methods/slices2d/slices2d_iso_twin.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "methods/slices2d/stack_page-inl.h"

// After the sampler it is made of.
#include "methods/volume/volume_fetch-inl.h"

// After both.
#include "methods/volume/isosurface_twin-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {
namespace {

// The two ends of each stretch, and their z of the stack.
struct alignas(64) Stretches {
  Positions begin, end;
  float near[kMaxBatch + kBatchPadding], far[kMaxBatch + kBatchPadding];
};

void vertex(const CpuBindings&, VertexBatch& batch) {
  for (size_t i = 0; i < batch.count; ++i) {
    const float* ndc = attribute_of(batch, 0, i);
    const float position[4] = {ndc[0], ndc[1], *attribute_of(batch, 2, i), 1.F};
    std::copy_n(position, 4, batch.position + 4 * i);
    batch.varyings[batch.varying_stride * i] = *attribute_of(batch, 1, i);
  }
}

// ---- Stretches ----
template <bool clip_planes, bool refine>
HWY_NOINLINE void locate(const VolumeUniforms& vm, FragmentBatch& batch, Stretches& out) {
  const Floats half = splat(.5F), one = splat(1.F), zero = splat(0.F), tiny = splat(1e-20F);
  const auto slice_position = [&](Floats k)
                                  HWY_ATTR { return clamp01(hn::MulAdd(k, splat(vm.own[3][1]), splat(vm.own[3][0]))); };
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const Floats x = hn::MulAdd(load(batch.x + i), splat(vm.own[0][0]), splat(-1.F));
    const Floats y = hn::MulAdd(load(batch.y + i), splat(vm.own[0][1]), one);
    const Floats3 origin = ray_origin(vm, x, y), direction = ray_direction(vm, x, y);
    Floats enter = splat(vm.depth[0]), leave = splat(1e30F);
    clip_ray<clip_planes>(vm, origin, direction, enter, leave);
    const Floats inverse = hn::Div(one, hn::IfThenElse(hn::Lt(hn::Abs(direction.z), tiny), tiny, direction.z));
    const Floats k = hn::Floor(hn::Add(load(batch.varyings[0] + i), half));
    const Floats low = slice_position(hn::Sub(k, half)), high = slice_position(hn::Add(k, half));
    const auto upwards = hn::Gt(inverse, zero);
    const Floats near = hn::IfThenElse(upwards, low, high), far = hn::IfThenElse(upwards, high, low);
    const Floats z_near = hn::Mul(hn::Sub(near, origin.z), inverse);
    const Floats z_far = hn::Mul(hn::Sub(far, origin.z), inverse);
    const Floats z0 = hn::Max(enter, z_near), z1 = hn::Min(leave, z_far);
    const Floats slack =
        hn::Mul(splat(kSlack), hn::Min(hn::Mul(splat(vm.own[3][1]), hn::Abs(inverse)), hn::Sub(leave, enter)));
    const auto met = hn::And(hn::Lt(enter, leave), hn::Le(z0, hn::Add(z1, slack)));
    store_discard(batch, i, hn::Not(met));
    // Rays that miss the slab have no stretch: finite values for them too.
    const Floats3 begin = along(origin, hn::IfThenElseZero(met, z0), direction);
    out.begin.put(i, begin);
    store(hn::IfThenElse(hn::Ge(z_near, enter), near, begin.z), out.near + i);
    if constexpr (refine) {
      const Floats3 end = along(origin, hn::IfThenElseZero(met, z1), direction);
      out.end.put(i, end);
      store(hn::IfThenElse(hn::Le(z_far, leave), far, end.z), out.far + i);
    }
  });
}

// ---- Sampling ----
// `page`: ScalarPage or AnyPage.
template <bool interpolate, class Page>
HWY_INLINE Rgba texel_at(const VolumeUniforms& vm, const Page& page, const Floats3& box, Floats z) {
  const Place at = place_in_slice(vm, box);
  const Floats first = splat(vm.own[2][3]), last = splat(vm.own[3][3]), one = splat(1.F);
  const Floats place = hn::Mul(z, splat(vm.own[0][3]));
  if constexpr (!interpolate) {
    return page(hn::Min(hn::Max(hn::Round(place), first), last), at);
  } else {
    const Floats below = hn::Min(hn::Max(hn::Floor(place), first), hn::Max(hn::Sub(last, one), first));
    const Floats above = hn::Min(hn::Add(below, one), last);
    return mix(page(below, at), page(above, at), clamp01(hn::Sub(place, below)));
  }
}

// The values alone, of texels that hold them in alpha: most fragments need no more of a texel. Bilinear as the general
// sampler.
template <Format format>
HWY_INLINE Floats alpha_of(const PageBindings& b, Ints texel) {
  const FloatTag d;
  const IntTag di;
  if constexpr (format == Format::RGBA8) {
    const Ints words = gather_words(b.page.data, hn::ShiftLeft<2>(texel));
    const Ints alpha = hn::And(hn::ShiftRight<24>(words), hn::Set(di, 255));
    return hn::Mul(hn::ConvertTo(d, alpha), splat(1.F / 255));
  } else if constexpr (format == Format::RGBA16F) {
    // The upper half of the second word of a texel.
    const hn::Rebind<uint16_t, FloatTag> d16;
    const Ints words = gather_words(b.page.data + 4, hn::ShiftLeft<3>(texel));
    const auto upper = hn::ShiftRight<16>(hn::BitCast(hn::RebindToUnsigned<IntTag>(), words));
    return hn::PromoteTo(d, hn::BitCast(hn::Rebind<hwy::float16_t, FloatTag>(), hn::TruncateTo(d16, upper)));
  } else {
    return hn::BitCast(d, gather_words(b.page.data + 12, hn::ShiftLeft<4>(texel)));
  }
}
template <Format format>
struct AlphaPage {
  const PageBindings& b;
  HWY_INLINE Rgba operator()(Floats stored, const Place& at) const {
    const PageCell cell = page_cell(b, stored, at);
    const IntTag di;
    const auto row_at = [&](ptrdiff_t texels) HWY_ATTR {
      const Ints first = hn::Add(cell.offset, hn::Set(di, static_cast<int32_t>(texels)));
      return lerp(alpha_of<format>(b, first), alpha_of<format>(b, hn::Add(first, hn::Set(di, 1))), cell.fx);
    };
    const Floats value = lerp(row_at(0), row_at(b.page.row_stride), cell.fy);
    return {value, value, value, value};
  }
};

enum Gradients { kValues, kStored, kNormals };  // VM_GRADIENTS

// Discards the fragments that do not meet the surface; moves `begin` and `near` to where the others do. `page` returns
// values in all channels.
template <bool refine, bool interpolate, class Page>
HWY_NOINLINE void meet(const PageBindings& b, const Page& page, const SurfaceUniforms& surface, Stretches& at,
                       FragmentBatch& batch) {
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const Floats3 begin = at.begin.get(i);
    const Floats value = normalised_value(b.vm, texel_at<interpolate>(b.vm, page, begin, load(at.near + i)).r);
    Floats met;
    if constexpr (refine) {
      const Floats3 end = at.end.get(i);
      const Floats behind = normalised_value(b.vm, texel_at<interpolate>(b.vm, page, end, load(at.far + i)).r);
      met = meet_line(surface, value, behind);
      const Floats3 hit = along(begin, met, end - begin);
      at.begin.put(i, hit);
      store(hit.z, at.near + i);
    } else {
      met = meet_slice(surface, value);
    }
    store_discard(batch, i, hn::Gt(met, splat(1.F)));
  });
}

template <bool refine, bool interpolate>
HWY_NOINLINE void meet_any(const PageBindings& b, const SurfaceUniforms& surface, Stretches& at, FragmentBatch& batch) {
  switch (b.page.format) {
    case Format::R8:
      return meet<refine, interpolate>(b, ScalarPage<Format::R8>{b}, surface, at, batch);
    case Format::R16:
      return meet<refine, interpolate>(b, ScalarPage<Format::R16>{b}, surface, at, batch);
    case Format::R32F:
      return meet<refine, interpolate>(b, ScalarPage<Format::R32F>{b}, surface, at, batch);
    case Format::RGBA8:
      return meet<refine, interpolate>(b, AlphaPage<Format::RGBA8>{b}, surface, at, batch);
    case Format::RGBA16F:
      return meet<refine, interpolate>(b, AlphaPage<Format::RGBA16F>{b}, surface, at, batch);
    case Format::RGBA32F:
      return meet<refine, interpolate>(b, AlphaPage<Format::RGBA32F>{b}, surface, at, batch);
    default:
      return meet<refine, interpolate>(b, AnyPage{b}, surface, at, batch);
  }
}

// ---- Light ----
template <Gradients gradients, bool interpolate>
HWY_NOINLINE void light(const PageBindings& b, const SurfaceUniforms& surface, const Stretches& at,
                        FragmentBatch& batch) {
  const SurfaceHits hits(batch);
  Positions points;
  alignas(64) float places[kMaxBatch + kBatchPadding];
  hits.gather(at.begin, points);
  hits.gather(at.near, places);
  const Floats scale = splat(surface.vectors[0]), offset = splat(surface.vectors[1]);
  shade_hits(hits, batch, [&](size_t k) HWY_ATTR {
    const Floats3 hit = points.get(k);
    const Rgba texel = texel_at<interpolate>(b.vm, AnyPage{b}, hit, load(places + k));
    const Floats3 vector{hn::MulAdd(texel.r, scale, offset), hn::MulAdd(texel.g, scale, offset),
                         hn::MulAdd(texel.b, scale, offset)};
    return shade_surface(b.vm, surface, gradients == kStored ? normal_of(b.vm, vector) : vector, hit);
  });
}

template <Gradients gradients, bool clip_planes, bool refine, bool interpolate>
void fragment(const CpuBindings& bindings, FragmentBatch& batch) {
  const PageBindings b(bindings);
  const SurfaceUniforms& surface = surface_of(bindings);
  Stretches at;
  locate<clip_planes, refine>(b.vm, batch, at);
  meet_any<refine, interpolate>(b, surface, at, batch);
  if constexpr (gradients == kValues) {
    const Rgba colour = with_alpha(splat3(surface.colour), splat(1.F));
    for_lanes(batch.count, [&](size_t i) HWY_ATTR { store_rgba(batch, i, colour); });
  } else {
    light<gradients, interpolate>(b, surface, at, batch);
  }
}

template <Gradients gradients, bool clip_planes>
CpuFragmentKernel with_samples(bool refine, bool interpolate) {
  if (refine) {
    return interpolate ? fragment<gradients, clip_planes, true, true> : fragment<gradients, clip_planes, true, false>;
  }
  return interpolate ? fragment<gradients, clip_planes, false, true> : fragment<gradients, clip_planes, false, false>;
}
template <Gradients gradients>
CpuFragmentKernel with_clip_planes(bool clip_planes, bool refine, bool interpolate) {
  return clip_planes ? with_samples<gradients, true>(refine, interpolate)
                     : with_samples<gradients, false>(refine, interpolate);
}

// Constants in the order of their ids: volume_common.glsl, then VM_REFINE, VM_GRADIENTS, VM_INTERPOLATE.
CpuKernels specialise(std::span<const int32_t> constants) {
  const bool clip_planes = constants[5] > 0, refine = constants[6] != 0, interpolate = constants[8] != 0;
  CpuKernels kernels;
  kernels.vertex = vertex;
  switch (constants[7]) {
    case kValues:
      kernels.fragment = with_clip_planes<kValues>(clip_planes, refine, interpolate);
      break;
    case kStored:
      kernels.fragment = with_clip_planes<kStored>(clip_planes, refine, interpolate);
      break;
    default:
      kernels.fragment = with_clip_planes<kNormals>(clip_planes, refine, interpolate);
      break;
  }
  kernels.varyings = 1;
  kernels.discards = true;
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
const CpuProgram slices2d_iso_twin{
    "slices2d_iso", [](std::span<const int32_t> constants) { return HWY_DYNAMIC_DISPATCH(specialise)(constants); }};
}  // namespace volumark
#endif
