#include "harness/filter_levels_twin.h"

#include "backends/cpu/highway_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "harness/filter_levels_twin.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "backends/cpu/sample-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {
namespace {

void vertex(const CpuBindings&, VertexBatch& batch) {
  for (size_t i = 0; i < batch.count; ++i) {
    float* position = batch.position + 4 * i;
    position[0] = batch.vertex_index[i] == 1 ? 3.F : -1.F;
    position[1] = batch.vertex_index[i] == 2 ? 3.F : -1.F;
    position[2] = 0;
    position[3] = 1;
  }
}

void fragment(const CpuBindings& bindings, FragmentBatch& batch) {
  const CpuTexture& source = bindings.textures[0];
  const Floats half = splat(0.5F);
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const Floats place = hn::MulAdd(hn::Floor(load(batch.y + i)), splat(64), load(batch.x + i));
    const Floats u = hn::MulAdd(place, splat(0.5F / 4096), splat(0.25F));
    store_rgba(batch, i, {sample_3d_red(source, u, half, half), splat(0), splat(0), splat(1)});
  });
}

CpuKernels specialise(std::span<const int32_t>) {
  CpuKernels kernels;
  kernels.vertex = vertex;
  kernels.fragment = fragment;
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
const CpuProgram filter_levels_cpu{
    "filter_levels", [](std::span<const int32_t> constants) { return HWY_DYNAMIC_DISPATCH(specialise)(constants); }};
}  // namespace volumark
#endif
