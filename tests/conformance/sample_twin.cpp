// The twins of sample1d/2d/3d.frag, over the samplers that every method's twin uses: the fast paths (tables, single
// channel volumes) where they are offered, the generic path otherwise.
#include "backends/cpu/highway_targets.h"
#include "tests/conformance/twins.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/conformance/sample_twin.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "backends/cpu/sample-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumark::conformance {
namespace HWY_NAMESPACE {
using namespace volumark::HWY_NAMESPACE;

template <int kDimension>
void sample_fragment(const CpuBindings& bindings, FragmentBatch& batch) {
  const CpuTexture& source = bindings.textures[1];
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const Floats u = load(batch.varyings[0] + i), v = load(batch.varyings[1] + i), w = load(batch.varyings[2] + i);
    if constexpr (kDimension == 1) {
      store_rgba(batch, i, sample_1d(source, u));
    } else if constexpr (kDimension == 2) {
      store_rgba(batch, i, sample_2d(source, u, v));
    } else if (channel_count(source.format) == 1) {
      const Floats zero = splat(0);
      store_rgba(batch, i, {sample_3d_red(source, u, v, w), zero, zero, splat(1)});
    } else {
      store_rgba(batch, i, sample_3d(source, u, v, w));
    }
  });
}

CpuFragmentKernel kernel_of(int dimension) {
  return dimension == 1 ? sample_fragment<1> : dimension == 2 ? sample_fragment<2> : sample_fragment<3>;
}

}  // namespace HWY_NAMESPACE
}  // namespace volumark::conformance
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumark::conformance {
HWY_EXPORT(kernel_of);

template <int kDimension>
CpuKernels sampling(std::span<const int32_t>) {
  CpuKernels kernels = kFlat.specialise({});
  kernels.fragment = HWY_DYNAMIC_DISPATCH(kernel_of)(kDimension);
  return kernels;
}
const CpuProgram kSample[3] = {{"sample1d", &sampling<1>}, {"sample2d", &sampling<2>}, {"sample3d", &sampling<3>}};
}  // namespace volumark::conformance
#endif
