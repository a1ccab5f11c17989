// Twin of raycast.vert and raycast.frag. Rays march in packets of one SIMD vector, taken from neighbouring pixels;
// every lane does what the GLSL does for its ray, in its own time.
#include "methods/raycast/raycast_cpu.h"

#include "backends/cpu/highway_targets.h"
#include "methods/volume/volume_uniforms.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "methods/raycast/raycast_cpu.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "backends/cpu/sample-inl.h"
#include "methods/raycast/march-inl.h"
#include "methods/raycast/packets-inl.h"
HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {
namespace {

template <class Volume, bool preintegrated, bool lit>
void shade_as(const CpuBindings& bindings, FragmentBatch& batch, SetUp set_up) {
  const RaycastBindings b(bindings);
  const Volume volume(b);
  Rays rays;
  Queue queue;
  set_up(b.vm, batch, rays);
  queue_rays(batch, rays, queue);
  const size_t lanes = hn::Lanes(FloatTag());
  for (size_t first = 0; first < queue.count; first += lanes) {
    const Walk walk(b, rays, queue.ray + first);
    const Rgba colour = preintegrated ? march_segments<lit>(b, volume, walk) : march_samples<lit>(b, volume, walk);
    write(colour, queue.ray + first, std::min(lanes, queue.count - first), batch);
  }
}

template <bool preintegrated, bool lit, bool clip_planes>
void shade(const CpuBindings& bindings, FragmentBatch& batch) {
  const CpuTexture& texture = bindings.textures[1];
  constexpr SetUp set_up = set_up_batch<clip_planes>;
  if (!fits_volume_view(texture)) return shade_as<AnyVolume, preintegrated, lit>(bindings, batch, set_up);
  switch (texture.format) {
    case Format::R8:
      return shade_as<FastVolume<Format::R8>, preintegrated, lit>(bindings, batch, set_up);
    case Format::R16:
      return shade_as<FastVolume<Format::R16>, preintegrated, lit>(bindings, batch, set_up);
    default:
      return shade_as<FastVolume<Format::R32F>, preintegrated, lit>(bindings, batch, set_up);
  }
}

template <bool clip_planes>
CpuFragmentKernel shade_for(bool preintegrated, bool lit) {
  if (preintegrated) return lit ? shade<true, true, clip_planes> : shade<true, false, clip_planes>;
  return lit ? shade<false, true, clip_planes> : shade<false, false, clip_planes>;
}

CpuKernels specialise(std::span<const int32_t> constants) {
  const bool preintegrated = constants[0] == 2;
  const bool lit = constants[2] > 0, clip_planes = constants[5] > 0;
  CpuKernels kernels;
  kernels.vertex = raycast_vertex;
  kernels.fragment = clip_planes ? shade_for<true>(preintegrated, lit) : shade_for<false>(preintegrated, lit);
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
const CpuProgram raycast_cpu{
    "raycast", [](std::span<const int32_t> constants) { return HWY_DYNAMIC_DISPATCH(specialise)(constants); }};
}  // namespace volumark
#endif
