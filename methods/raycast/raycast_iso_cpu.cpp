// Twin of raycast_iso.frag (and raycast.vert): packets of rays march as in raycast_cpu.cpp, and end at the surface.
#include "backends/cpu/highway_targets.h"
#include "methods/raycast/raycast_iso.h"
#include "methods/volume/isosurface.h"
#include "methods/volume/volume_uniforms.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "methods/raycast/raycast_iso_cpu.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "backends/cpu/sample-inl.h"
#include "methods/raycast/march-inl.h"
// After the sampler and the rays that they are made of.
#include "methods/raycast/packets-inl.h"
#include "methods/volume/volume_fetch-inl.h"
// After both.
#include "methods/volume/isosurface_twin-inl.h"
HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {
namespace {

// The segments of a packet that hold the surface: their ends in steps, and the values there.
struct Bracket {
  Floats begin, end, front, back;
  FloatMask found;
};

template <class Volume>
HWY_INLINE Bracket find_segment(const RaycastBindings& b, const SurfaceUniforms& surface, const Volume& volume,
                                const Walk& walk) {
  const FloatTag d;
  const Floats zero = hn::Zero(d), one = splat(1.F), value = splat(surface.colour[3]);
  Bracket out{zero, zero, zero, zero, hn::Lt(one, zero)};
  Floats k = zero, known = splat(-1.F), back = zero;
  Floats inside = b.bricks_per_cell() > 0 ? zero : splat(1e30F);
  const auto sample = [&](Floats at) HWY_ATTR {
    return volume(along(walk.cell_entry, hn::Min(at, walk.steps), walk.cell_stride));
  };
  for (;; k = hn::Add(k, one)) {
    to_next_segment(b, walk, k, inside);
    const auto active = hn::Lt(k, walk.count);
    if (hn::AllFalse(d, active)) return out;
    const auto fresh = hn::And(active, hn::Ne(known, k));
    Floats front = back;
    if (!hn::AllFalse(d, fresh)) front = hn::IfThenElse(fresh, sample(k), front);
    known = hn::Add(k, one);
    back = sample(known);
    const auto holds = hn::And(active, hn::Ge(hn::Max(front, back), value));
    out.begin = hn::IfThenElse(holds, k, out.begin);
    out.end = hn::IfThenElse(holds, hn::Min(known, walk.steps), out.end);
    out.front = hn::IfThenElse(holds, front, out.front);
    out.back = hn::IfThenElse(holds, back, out.back);
    out.found = hn::Or(out.found, holds);
    k = hn::IfThenElse(holds, walk.count, k);
  }
}

// Where the surface is met, in steps.
template <class Volume>
HWY_INLINE Floats refine_hit(const SurfaceUniforms& surface, const Volume& volume, const Walk& walk, Bracket& at,
                             int refine) {
  const Floats value = splat(surface.colour[3]);
  const auto before = hn::Ge(at.front, value);
  if (refine == 0) return hn::IfThenElse(before, at.begin, at.end);
  for (int i = 1; i < refine; ++i) {
    const Floats middle = hn::Mul(splat(.5F), hn::Add(at.begin, at.end));
    const Floats s = volume(along(walk.cell_entry, middle, walk.cell_stride));
    // Where the segment begins in the solid both ends stay, as meet_line() then returns its beginning.
    const auto solid = hn::AndNot(before, hn::Ge(s, value)), empty = hn::AndNot(before, hn::Lt(s, value));
    at.end = hn::IfThenElse(solid, middle, at.end);
    at.back = hn::IfThenElse(solid, s, at.back);
    at.begin = hn::IfThenElse(empty, middle, at.begin);
    at.front = hn::IfThenElse(empty, s, at.front);
  }
  // Lanes that found nothing hold finite values.
  const Floats met = hn::Min(meet_line(surface, at.front, at.back), splat(1.F));
  return hn::MulAdd(met, hn::Sub(at.end, at.begin), at.begin);
}

template <class Volume, bool lit>
void shade_as(const CpuBindings& bindings, FragmentBatch& batch,
              void (*set_up)(const VolumeUniforms&, FragmentBatch&, Rays&), int refine) {
  const RaycastBindings b(bindings);
  const SurfaceUniforms& surface = surface_of(bindings);
  const Volume volume(b);
  Rays rays;
  Queue queue;
  set_up(b.vm, batch, rays);
  queue_rays(batch, rays, queue);
  const size_t lanes = hn::Lanes(FloatTag());
  const Floats zero = splat(0.F);
  for (size_t first = 0; first < queue.count; first += lanes) {
    const Walk walk(b, rays, queue.ray + first);
    Bracket bracket = find_segment(b, surface, volume, walk);
    if (hn::AllFalse(FloatTag(), bracket.found)) continue;  // 0 is there already
    Rgba colour = with_alpha(splat3(surface.colour), splat(1.F));
    if constexpr (lit) {
      const Floats3 hit = along(walk.entry, refine_hit(surface, volume, walk, bracket, refine), walk.stride);
      colour = shade_surface(b.vm, surface, normal_of(b.vm, sample_gradient(b, hit)), hit);
    }
    const auto shown = [&](Floats channel) HWY_ATTR { return hn::IfThenElse(bracket.found, channel, zero); };
    write({shown(colour.r), shown(colour.g), shown(colour.b), shown(colour.a)}, queue.ray + first,
          std::min(lanes, queue.count - first), batch);
  }
}

template <bool lit, bool clip_planes, int refine>
void shade(const CpuBindings& bindings, FragmentBatch& batch) {
  const CpuTexture& texture = bindings.textures[1];
  constexpr auto set_up = set_up_batch<clip_planes>;
  if (!fits_volume_view(texture)) return shade_as<AnyVolume, lit>(bindings, batch, set_up, refine);
  switch (texture.format) {
    case Format::R8:
      return shade_as<FastVolume<Format::R8>, lit>(bindings, batch, set_up, refine);
    case Format::R16:
      return shade_as<FastVolume<Format::R16>, lit>(bindings, batch, set_up, refine);
    default:
      return shade_as<FastVolume<Format::R32F>, lit>(bindings, batch, set_up, refine);
  }
}

// Unlit surfaces look the same wherever they are met.
template <bool clip_planes>
CpuFragmentKernel shade_for(bool lit, int refine) {
  if (!lit) return shade<false, clip_planes, 0>;
  if (refine == 0) return shade<true, clip_planes, 0>;
  return refine == 1 ? shade<true, clip_planes, 1> : shade<true, clip_planes, kBisections + 1>;
}

// Constants in the order of their ids: volume_common.glsl, VM_SKIP_EMPTY, VM_REFINE.
CpuKernels specialise(std::span<const int32_t> constants) {
  const bool lit = constants[2] > 0, clip_planes = constants[5] > 0;
  CpuKernels kernels;
  kernels.vertex = raycast_vertex;
  kernels.fragment = clip_planes ? shade_for<true>(lit, constants[7]) : shade_for<false>(lit, constants[7]);
  kernels.varyings = 2;
  return kernels;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumark {
HWY_EXPORT(specialise);
const CpuProgram raycast_iso_cpu{
    "raycast_iso", [](std::span<const int32_t> constants) { return HWY_DYNAMIC_DISPATCH(specialise)(constants); }};
}  // namespace volumark
#endif
