// Values of the volume at a batch of points on SIMD lanes, for CPU twins that work in phases: index and prefetch of all
// points first, then their texels, faster than one after the other. Include after volume_twin-inl.h.
#if defined(VOLUMARK_METHODS_VOLUME_FETCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMARK_METHODS_VOLUME_FETCH_INL_H_
#undef VOLUMARK_METHODS_VOLUME_FETCH_INL_H_
#else
#define VOLUMARK_METHODS_VOLUME_FETCH_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {

// Box coordinates of a batch.
struct alignas(64) Positions {
  float x[kMaxBatch + kBatchPadding], y[kMaxBatch + kBatchPadding], z[kMaxBatch + kBatchPadding];
  HWY_INLINE void put(size_t i, const Floats3& p) {
    store(p.x, x + i);
    store(p.y, y + i);
    store(p.z, z + i);
  }
  HWY_INLINE Floats3 get(size_t i) const { return {load(x + i), load(y + i), load(z + i)}; }
};

template <Format format>
static HWY_NOINLINE void fetch_as(const VolumeBindings& b, const Positions& at, size_t count, float* values) {
  const VolumeView view = volume_view(b.volume);
  const Floats3 scale = splat3(b.vm.texture_scale), offset = splat3(b.vm.texture_offset);
  VolumeCells cells;
  for_lanes(count, [&](size_t i) HWY_ATTR {
    const Floats3 p = at.get(i) * scale + offset;  // texture_position
    cells.put(i, volume_cell(view, p.x, p.y, p.z));
    cells.prefetch<format>(view, i);
  });
  const Floats lo = splat(b.vm.value[0]), range = splat(b.vm.value[1]);
  for_lanes(count, [&](size_t i) HWY_ATTR {
    store(hn::Mul(hn::Sub(cells.fetch<format>(view, i), lo), range), values + i);  // normalised_value
  });
}

// sample_value() of each point.
static inline HWY_NOINLINE void fetch(const VolumeBindings& b, const Positions& at, size_t count, float* values) {
  if (fits_volume_view(b.volume)) {
    switch (b.volume.format) {
      case Format::R8:
        return fetch_as<Format::R8>(b, at, count, values);
      case Format::R16:
        return fetch_as<Format::R16>(b, at, count, values);
      default:
        return fetch_as<Format::R32F>(b, at, count, values);
    }
  }
  for_lanes(count, [&](size_t i) HWY_ATTR { store(sample_value(b, at.get(i)), values + i); });
}

}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#endif
