// The twin of isosurface.glsl on SIMD lanes. Include after volume_twin-inl.h and volume_fetch-inl.h inside a
// foreach_target file.
#include "methods/volume/isosurface.h"

#if defined(VOLUMARK_METHODS_VOLUME_ISOSURFACE_TWIN_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMARK_METHODS_VOLUME_ISOSURFACE_TWIN_INL_H_
#undef VOLUMARK_METHODS_VOLUME_ISOSURFACE_TWIN_INL_H_
#else
#define VOLUMARK_METHODS_VOLUME_ISOSURFACE_TWIN_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {

inline constexpr float kSlack = 1e-4F;

HWY_INLINE const SurfaceUniforms& surface_of(const CpuBindings& bindings) {
  return *reinterpret_cast<const SurfaceUniforms*>(bindings.buffers[5].data);
}

HWY_INLINE Floats meet_slice(const SurfaceUniforms& surface, Floats front) {
  return hn::IfThenElse(hn::Ge(front, splat(surface.colour[3])), splat(0.F), splat(2.F));
}
HWY_INLINE Floats meet_line(const SurfaceUniforms& surface, Floats front, Floats back) {
  const Floats value = splat(surface.colour[3]), one = splat(1.F), zero = splat(0.F);
  const auto before = hn::Ge(front, value), after = hn::Ge(back, value);
  const Floats run = hn::IfThenElse(hn::AndNot(before, after), hn::Sub(back, front), one);
  const Floats met = clamp01(hn::Div(hn::Sub(value, front), run));
  return hn::IfThenElse(before, zero, hn::IfThenElse(after, met, splat(2.F)));
}

HWY_INLINE Rgba shade_surface(const VolumeUniforms& vm, const SurfaceUniforms& surface, const Floats3& n,
                              const Floats3& box) {
  const Floats zero = splat(0.F);
  Light3 sum{{zero, zero, zero}, {zero, zero, zero}};
  add_lights(vm, n, box, sum);
  return with_alpha(splat3(surface.ambient) + splat3(surface.colour) * sum.diffuse + sum.specular, splat(1.F));
}

// Fragments that show the surface, side by side: most vectors of a slice have few, and light is what costs.
struct alignas(64) SurfaceHits {
  uint16_t fragment[kMaxBatch];
  size_t count = 0;
  // Those of the batch that are not discarded.
  explicit SurfaceHits(const FragmentBatch& batch) {
    for (size_t i = 0; i < batch.count; ++i) {
      fragment[count] = static_cast<uint16_t>(i);
      count += batch.discard[i] == 0 ? 1 : 0;
    }
  }
  HWY_INLINE void gather(const Positions& from, Positions& to) const {
    gather(from.x, to.x);
    gather(from.y, to.y);
    gather(from.z, to.z);
  }
  HWY_INLINE void gather(const float* from, float* to) const {
    for (size_t k = 0; k < count; ++k) to[k] = from[fragment[k]];
    // Lanes past the last one work too.
    const float last = count > 0 ? to[count - 1] : 0;
    for (size_t k = count; k < (count + kBatchPadding - 1) / kBatchPadding * kBatchPadding; ++k) to[k] = last;
  }
  HWY_INLINE void scatter(const float* from, float* to) const {
    for (size_t k = 0; k < count; ++k) to[fragment[k]] = from[k];
  }
};

// `shade(k)`: Rgba of hits k to k + lanes.
template <class Shade>
HWY_INLINE void shade_hits(const SurfaceHits& hits, FragmentBatch& batch, const Shade& shade) {
  alignas(64) float rgba[4][kMaxBatch + kBatchPadding];
  for_lanes(hits.count, [&](size_t k) HWY_ATTR {
    const Rgba colour = shade(k);
    store(colour.r, rgba[0] + k);
    store(colour.g, rgba[1] + k);
    store(colour.b, rgba[2] + k);
    store(colour.a, rgba[3] + k);
  });
  for (int channel = 0; channel < 4; ++channel) hits.scatter(rgba[channel], batch.rgba[channel]);
}

}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#endif
