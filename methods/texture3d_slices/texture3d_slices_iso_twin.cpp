// The CPU twin of texture3d_slices_iso.vert and .frag, in phases over a batch of fragments: the stretches, the values
// at their ends, where the surface is met; then the light, of the fragments that show it alone.
#include "methods/texture3d_slices/texture3d_slices_iso.h"

// After the headers without Highway.
#include "backends/cpu/highway_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "methods/texture3d_slices/texture3d_slices_iso_twin.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "methods/volume/volume_twin-inl.h"

// After the sampler they are made of.
#include "methods/volume/volume_fetch-inl.h"

// After both.
#include "methods/volume/isosurface_twin-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {
namespace {

void vertex(const CpuBindings&, VertexBatch& batch) {
  for (size_t i = 0; i < batch.count; ++i) {
    const float* ndc = attribute_of(batch, 0, i);
    const float position[4] = {ndc[0], ndc[1], *attribute_of(batch, 2, i), 1.F};
    std::copy_n(position, 4, batch.position + 4 * i);
    batch.varyings[batch.varying_stride * i] = *attribute_of(batch, 1, i);
  }
}

template <bool clip_planes, bool refine>
HWY_NOINLINE void locate(const VolumeUniforms& vm, FragmentBatch& batch, Positions& front, Positions& back) {
  const Floats reach = splat(.5F * vm.depth[3]), slack = splat(kSlack * vm.depth[3]);
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const Floats x = load(batch.x + i), y = load(batch.y + i);
    const Floats3 direction = ray_direction(vm, x, y);
    const Floats3 box = along(ray_origin(vm, x, y), load(batch.varyings[0] + i), direction);
    Floats enter = splat(-1e30F), leave = splat(1e30F);
    clip_ray<clip_planes>(vm, box, direction, enter, leave);
    const auto met = hn::Lt(enter, leave);
    // Rays that miss the volume have no stretch: finite values for them too.
    const Floats z0 = hn::Max(hn::Neg(reach), hn::IfThenElseZero(met, enter));
    const Floats z1 = hn::Min(reach, hn::IfThenElseZero(met, leave));
    store_discard(batch, i, hn::Not(hn::And(met, hn::Le(z0, hn::Add(z1, slack)))));
    front.put(i, along(box, z0, direction));
    if constexpr (refine) back.put(i, along(box, z1, direction));
  });
}

enum Gradients { kComputed, kStored, kNormals };  // VM_GRADIENTS

// Discards the fragments that do not meet the surface; moves `front` to where the others do. `vectors`: what is stored
// there.
template <Gradients gradients, bool refine>
HWY_NOINLINE void meet(const VolumeBindings& b, const SurfaceUniforms& surface, Positions& front, const Positions& back,
                       Positions& vectors, FragmentBatch& batch) {
  alignas(64) float values[2][kMaxBatch + kBatchPadding];
  if constexpr (gradients == kComputed) {
    fetch(b, front, batch.count, values[0]);
    if constexpr (refine) fetch(b, back, batch.count, values[1]);
  }
  const Floats scale = splat(surface.vectors[0]), offset = splat(surface.vectors[1]);
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    Rgba texel, behind;
    Floats value, value_behind;
    if constexpr (gradients == kComputed) {
      value = load(values[0] + i);
      if constexpr (refine) value_behind = load(values[1] + i);
    } else {
      texel = sample_classified(b, front.get(i));
      value = normalised_value(b.vm, texel.a);
      if constexpr (refine) {
        behind = sample_classified(b, back.get(i));
        value_behind = normalised_value(b.vm, behind.a);
      }
    }
    Floats met = meet_slice(surface, value);
    if constexpr (refine) {
      met = meet_line(surface, value, value_behind);
      const Floats3 begin = front.get(i);
      front.put(i, along(begin, met, back.get(i) - begin));
      if constexpr (gradients != kComputed) texel = mix(texel, behind, met);
    }
    store_discard(batch, i, hn::Gt(met, splat(1.F)));
    if constexpr (gradients != kComputed) {
      vectors.put(i, {hn::MulAdd(texel.r, scale, offset), hn::MulAdd(texel.g, scale, offset),
                      hn::MulAdd(texel.b, scale, offset)});
    }
  });
}

template <Gradients gradients>
HWY_NOINLINE void light(const VolumeBindings& b, const SurfaceUniforms& surface, const Positions& front,
                        const Positions& vectors, FragmentBatch& batch) {
  const SurfaceHits hits(batch);
  Positions points, normals;
  hits.gather(front, points);
  if constexpr (gradients != kComputed) hits.gather(vectors, normals);
  shade_hits(hits, batch, [&](size_t k) HWY_ATTR {
    const Floats3 hit = points.get(k);
    if constexpr (gradients == kComputed) {
      return shade_surface(b.vm, surface, normal_of(b.vm, sample_gradient(b, hit)), hit);
    } else {
      const Floats3 vector = normals.get(k);
      return shade_surface(b.vm, surface, gradients == kStored ? normal_of(b.vm, vector) : vector, hit);
    }
  });
}

template <bool lit, bool clip_planes, bool refine, Gradients gradients>
void fragment(const CpuBindings& bindings, FragmentBatch& batch) {
  const VolumeBindings b(bindings);
  const SurfaceUniforms& surface = surface_of(bindings);
  Positions front, back, vectors;
  locate<clip_planes, refine>(b.vm, batch, front, back);
  meet<gradients, refine>(b, surface, front, back, vectors, batch);
  if constexpr (lit) {
    light<gradients>(b, surface, front, vectors, batch);
  } else {
    const Rgba colour = with_alpha(splat3(surface.colour), splat(1.F));
    for_lanes(batch.count, [&](size_t i) HWY_ATTR { store_rgba(batch, i, colour); });
  }
}

template <bool clip_planes, bool refine>
CpuFragmentKernel with_light(bool lit, int gradients) {
  if (!lit) return fragment<false, clip_planes, refine, kComputed>;
  switch (gradients) {
    case kComputed:
      return fragment<true, clip_planes, refine, kComputed>;
    case kStored:
      return fragment<true, clip_planes, refine, kStored>;
    default:
      return fragment<true, clip_planes, refine, kNormals>;
  }
}

// Constants in the order of their ids: volume_common.glsl, then VM_REFINE, VM_GRADIENTS.
CpuKernels specialise(std::span<const int32_t> constants) {
  const bool lit = constants[2] > 0, clip_planes = constants[5] > 0, refine = constants[6] != 0;
  CpuKernels kernels;
  kernels.vertex = vertex;
  if (clip_planes) {
    kernels.fragment = refine ? with_light<true, true>(lit, constants[7]) : with_light<true, false>(lit, constants[7]);
  } else {
    kernels.fragment =
        refine ? with_light<false, true>(lit, constants[7]) : with_light<false, false>(lit, constants[7]);
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
const CpuProgram texture3d_slices_iso_twin{"texture3d_slices_iso", [](std::span<const int32_t> constants) {
                                             return HWY_DYNAMIC_DISPATCH(specialise)(constants);
                                           }};
}  // namespace volumark
#endif
