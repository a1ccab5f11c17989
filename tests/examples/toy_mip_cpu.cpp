// Twin of toy_mip.vert and toy_mip.frag, line by line on SIMD lanes: every lane is one pixel's ray.
#include "tests/examples/toy_mip.h"

// After the headers without Highway.
#include "backends/cpu/highway_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/examples/toy_mip_cpu.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "methods/volume/volume_twin-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {
namespace {

void vertex(const CpuBindings&, VertexBatch& batch) {
  for (size_t i = 0; i < batch.count; ++i) {
    const float x = batch.vertex_index[i] == 1 ? 3.F : -1.F;
    const float y = batch.vertex_index[i] == 2 ? 3.F : -1.F;
    const float position[4] = {x, y, 0.F, 1.F};
    std::copy_n(position, 4, batch.position + 4 * i);
    std::copy_n(position, 2, batch.varyings + batch.varying_stride * i);
  }
}

void fragment(const CpuBindings& bindings, FragmentBatch& batch) {
  const VolumeBindings b(bindings);
  const Floats zero = splat(0.F), one = splat(1.F);
  const float samples = b.vm.own[0][0];
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const Floats x = load(batch.varyings[0] + i), y = load(batch.varyings[1] + i);
    const Floats3 origin = ray_origin(b.vm, x, y), direction = ray_direction(b.vm, x, y);
    Floats z0 = splat(b.vm.depth[0]), z1 = splat(1e30F);
    clip_ray<true>(b.vm, origin, direction, z0, z1);
    const FloatMask hits = hn::Lt(z0, z1);
    z0 = hn::IfThenElseZero(hits, z0);  // lanes without a ray sample somewhere, and are dropped at the end
    z1 = hn::IfThenElseZero(hits, z1);
    const Floats dz = hn::Div(hn::Sub(z1, z0), splat(samples));
    Floats largest = zero;
    for (float k = .5F; k < samples; ++k) {
      const Floats z = hn::MulAdd(splat(k), dz, z0);
      largest = hn::Max(largest, sample_value(b, along(origin, z, direction)));
    }
    const Floats grey = hn::IfThenElseZero(hits, hn::Min(largest, one));
    store_rgba(batch, i, {grey, grey, grey, hn::IfThenElseZero(hits, one)});
  });
}

CpuKernels specialise(std::span<const int32_t>) {
  CpuKernels kernels;
  kernels.vertex = vertex;
  kernels.fragment = fragment;
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
const CpuProgram toy_mip_cpu{
    "toy_mip", [](std::span<const int32_t> constants) { return HWY_DYNAMIC_DISPATCH(specialise)(constants); }};
}  // namespace volumark
#endif
