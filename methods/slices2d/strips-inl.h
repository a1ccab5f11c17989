// The twin of strips.vert. Include inside a foreach_target file.
#include "backends/cpu/sample-inl.h"

#if defined(VOLUMARK_METHODS_SLICES2D_STRIPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMARK_METHODS_SLICES2D_STRIPS_INL_H_
#undef VOLUMARK_METHODS_SLICES2D_STRIPS_INL_H_
#else
#define VOLUMARK_METHODS_SLICES2D_STRIPS_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {

static inline void strip_vertex(const CpuBindings&, VertexBatch& batch) {
  for (size_t i = 0; i < batch.count; ++i) {
    const float* place = attribute_of(batch, 0, i);
    const float* strip = attribute_of(batch, 1, i);
    const float position[4] = {place[0], place[1], .5F * place[2], place[2]};
    std::copy_n(position, 4, batch.position + 4 * i);
    std::copy_n(strip, 3, batch.varyings + batch.varying_stride * i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#endif
