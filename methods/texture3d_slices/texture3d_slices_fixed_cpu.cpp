// Twin of texture3d_slices_fixed.vert and .frag.
#include "methods/texture3d_slices/fixed_slices.h"
#include "methods/volume/fixed_point.h"

// After the headers without Highway.
#include "backends/cpu/highway_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "methods/texture3d_slices/texture3d_slices_fixed_cpu.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "methods/volume/fixed_point-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {
namespace {

void vertex(const CpuBindings&, VertexBatch& batch) {
  for (size_t i = 0; i < batch.count; ++i) {
    const float* ndc = attribute_of(batch, 0, i);
    const float position[4] = {ndc[0], ndc[1], .5F, 1.F};
    std::copy_n(position, 4, batch.position + 4 * i);
    batch.varyings[batch.varying_stride * i] = *attribute_of(batch, 1, i);
  }
}

template <FixedTexel kind>
void fragment(const CpuBindings& bindings, FragmentBatch& batch) {
  const FixedBindings b(bindings);
  const IntMask all = hn::FirstN(IntTag(), hn::Lanes(IntTag()));
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const Floats x = load(batch.x + i), y = load(batch.y + i);
    // Interpolated here: rounding takes back what interpolation of a constant may add.
    const Floats slice = hn::Floor(hn::Add(load(batch.varyings[0] + i), splat(.5F)));
    const Floats z = depth_of(b.fx, slice, splat(b.fx.depth[1]));
    store_levels(batch, i,
                 fixed_sample<kind>(b, position_of(window_origin(b.fx, x, y), window_direction(b.fx, x, y), z), all));
  });
}

CpuKernels specialise(std::span<const int32_t> constants) {
  CpuKernels kernels;
  kernels.vertex = vertex;
  switch (fixed_texel(constants)) {
    case FixedTexel::Value:
      kernels.fragment = fragment<FixedTexel::Value>;
      break;
    case FixedTexel::Lit:
      kernels.fragment = fragment<FixedTexel::Lit>;
      break;
    case FixedTexel::Classified:
      kernels.fragment = fragment<FixedTexel::Classified>;
      break;
  }
  kernels.varyings = 1;
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
const CpuProgram texture3d_slices_fixed_cpu{"texture3d_slices_fixed", [](std::span<const int32_t> constants) {
                                              return HWY_DYNAMIC_DISPATCH(specialise)(constants);
                                            }};
}  // namespace volumark
#endif
