// Fast path of the volume sampler: the red channel of a 3D texture of R8, R16 or R32F, linear filter, clamp to edge.
// Included by sample-inl.h; not to be included on its own. The two steps (address, fetch) may be called apart: a kernel
// that loops over a whole batch in each step (phases) is 25 to 35 % faster than one that does all for each 16 lanes.
#if defined(VOLUMARK_CPU_VOLUME_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMARK_CPU_VOLUME_INL_H_
#undef VOLUMARK_CPU_VOLUME_INL_H_
#else
#define VOLUMARK_CPU_VOLUME_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {

// What the fast path needs of a texture, resolved once a batch.
struct VolumeView {
  const std::byte* data = nullptr;
  float width = 0, height = 0, depth = 0;
  int32_t row = 0, slice = 0;  // texels
};

// Whether `texture` with its sampler can be read through VolumeView. Byte offsets must fit 31 bits for the gathers.
inline bool fits_volume_view(const CpuTexture& texture) {
  const bool scalar = texture.format == Format::R8 || texture.format == Format::R16 || texture.format == Format::R32F;
  const auto texels = static_cast<int64_t>(texture.slice_stride) * (texture.depth + 1);
  return texture.dimension == 3 && scalar && texture.sampler.filter == Filter::Linear &&
         texture.sampler.wrap == Wrap::Clamp && texels < (int64_t{1} << 30);
}

inline VolumeView volume_view(const CpuTexture& texture) {
  return {texture.data,
          static_cast<float>(texture.width),
          static_cast<float>(texture.height),
          static_cast<float>(texture.depth),
          static_cast<int32_t>(texture.row_stride),
          static_cast<int32_t>(texture.slice_stride)};
}

// Lower corner of the cell a sample falls into (texel index) and the weights inside it.
struct VolumeCell {
  Ints index;
  Floats fx, fy, fz;
};

HWY_INLINE VolumeCell volume_cell(const VolumeView& view, Floats u, Floats v, Floats w) {
  const FloatTag d;
  const IntTag di;
  const Floats half = hn::Set(d, 0.5F);
  const Floats one = hn::Set(d, 1.0F);
  // Texel centres lie at (i + .5) / n. Coordinates are clamped to [0, n - 1]; the padding makes n - 1 + 1 readable. Max
  // with the coordinate first turns NaN into 0.
  const auto along = [&](Floats coordinate, float n) HWY_ATTR {
    const Floats extent = hn::Set(d, n);
    const Floats at = hn::MulSub(coordinate, extent, half);
    return hn::Min(hn::Max(at, hn::Zero(d)), hn::Sub(extent, one));
  };
  const Floats x = along(u, view.width);
  const Floats y = along(v, view.height);
  const Floats z = along(w, view.depth);
  const Ints ix = truncate(x);
  const Ints iy = truncate(y);
  const Ints iz = truncate(z);
  const Ints index = hn::Add(ix, hn::Add(hn::Mul(iy, hn::Set(di, view.row)), hn::Mul(iz, hn::Set(di, view.slice))));
  return {index, hn::Sub(x, hn::ConvertTo(d, ix)), hn::Sub(y, hn::ConvertTo(d, iy)), hn::Sub(z, hn::ConvertTo(d, iz))};
}

HWY_INLINE Floats lerp(Floats a, Floats b, Floats t) { return hn::MulAdd(t, hn::Sub(b, a), a); }

// ---- Float: scalar 64-bit loads bring two x neighbours at once; hardware gathers are half as fast on Zen 4
// -----------

#if HWY_TARGET <= HWY_SSE4 && HWY_ARCH_X86
HWY_INLINE double load_pair(const float* base, int32_t index) {
  double pair;
  std::memcpy(&pair, base + index, sizeof(pair));
  return pair;
}

// Lanes 0, 1 (`first` = 0) or 2, 3 (`first` = 2) of every block of four lanes: x neighbours side by side. The order is
// that of InterleaveLower and InterleaveUpper, so that everything after it stays inside 128-bit blocks.
template <int first>
HWY_INLINE Floats load_pairs(const float* base, const int32_t* index) {
#if HWY_TARGET <= HWY_AVX3
  return Floats{_mm512_castpd_ps(_mm512_set_pd(load_pair(base, index[first + 13]), load_pair(base, index[first + 12]),
                                               load_pair(base, index[first + 9]), load_pair(base, index[first + 8]),
                                               load_pair(base, index[first + 5]), load_pair(base, index[first + 4]),
                                               load_pair(base, index[first + 1]), load_pair(base, index[first])))};
#elif HWY_TARGET <= HWY_AVX2
  return Floats{_mm256_castpd_ps(_mm256_set_pd(load_pair(base, index[first + 5]), load_pair(base, index[first + 4]),
                                               load_pair(base, index[first + 1]), load_pair(base, index[first])))};
#else
  return Floats{_mm_castpd_ps(_mm_set_pd(load_pair(base, index[first + 1]), load_pair(base, index[first])))};
#endif
}

// Elements 0 and 2 (or 1 and 3) of every block of a, then those of b.
template <int select>
HWY_INLINE Floats shuffle_pairs(Floats a, Floats b) {
#if HWY_TARGET <= HWY_AVX3
  return Floats{_mm512_shuffle_ps(a.raw, b.raw, select)};
#elif HWY_TARGET <= HWY_AVX2
  return Floats{_mm256_shuffle_ps(a.raw, b.raw, select)};
#else
  return Floats{_mm_shuffle_ps(a.raw, b.raw, select)};
#endif
}

HWY_INLINE Floats fetch_float(const VolumeView& view, const int32_t* index, Floats fx, Floats fy, Floats fz) {
  const FloatTag d;
  const auto* base = reinterpret_cast<const float*>(view.data);
  const float* base_y = base + view.row;
  const float* base_z = base + view.slice;
  const float* base_yz = base_z + view.row;
  const Floats ya = hn::InterleaveLower(d, fy, fy);
  const Floats za = hn::InterleaveLower(d, fz, fz);
  const Floats a = lerp(lerp(load_pairs<0>(base, index), load_pairs<0>(base_y, index), ya),
                        lerp(load_pairs<0>(base_z, index), load_pairs<0>(base_yz, index), ya), za);
  const Floats yb = hn::InterleaveUpper(d, fy, fy);
  const Floats zb = hn::InterleaveUpper(d, fz, fz);
  const Floats b = lerp(lerp(load_pairs<2>(base, index), load_pairs<2>(base_y, index), yb),
                        lerp(load_pairs<2>(base_z, index), load_pairs<2>(base_yz, index), yb), zb);
  return lerp(shuffle_pairs<0x88>(a, b), shuffle_pairs<0xDD>(a, b), fx);
}
#else
// Portable: the eight corners through a staging array.
HWY_INLINE Floats fetch_float(const VolumeView& view, const int32_t* index, Floats fx, Floats fy, Floats fz) {
  const FloatTag d;
  const auto* base = reinterpret_cast<const float*>(view.data);
  alignas(64) float corner[8][kMaxLanes];
  for (size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    for (int c = 0; c < 8; ++c) {
      corner[c][lane] = base[index[lane] + (c & 1) + ((c & 2) != 0 ? view.row : 0) + ((c & 4) != 0 ? view.slice : 0)];
    }
  }
  const auto at = [&](int c) HWY_ATTR { return hn::Load(d, corner[c]); };
  const Floats near = lerp(lerp(at(0), at(1), fx), lerp(at(2), at(3), fx), fy);
  const Floats far = lerp(lerp(at(4), at(5), fx), lerp(at(6), at(7), fx), fy);
  return lerp(near, far, fz);
}
#endif

// ---- u8 and u16: one 32-bit gather brings both x neighbours (16 readable bytes follow the last texel)
// ----------------

HWY_INLINE Ints gather_words(const std::byte* base, Ints byte_offset) {
  const IntTag di;
#if HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86
  return hn::GatherOffset(di, reinterpret_cast<const int32_t*>(base), byte_offset);
#else
  alignas(64) int32_t offsets[kMaxLanes], words[kMaxLanes];
  hn::Store(byte_offset, di, offsets);
  for (size_t lane = 0; lane < hn::Lanes(di); ++lane) {
    std::memcpy(&words[lane], base + offsets[lane], sizeof(int32_t));
  }
  return hn::Load(di, words);
#endif
}

template <int bits>
HWY_INLINE Floats fetch_unorm(const VolumeView& view, const int32_t* index, Floats fx, Floats fy, Floats fz) {
  const FloatTag d;
  const IntTag di;
  constexpr int kBytes = bits / 8;
  constexpr int32_t kMask = (1 << bits) - 1;
  const Ints offset = kBytes == 1 ? hn::Load(di, index) : hn::ShiftLeft<kBytes - 1>(hn::Load(di, index));
  const Ints mask = hn::Set(di, kMask);
  const auto row_at = [&](ptrdiff_t texels) HWY_ATTR {
    const Ints words = gather_words(view.data + texels * kBytes, offset);
    const Floats x0 = hn::ConvertTo(d, hn::And(words, mask));
    const Floats x1 = hn::ConvertTo(d, hn::And(hn::ShiftRight<bits>(words), mask));
    return lerp(x0, x1, fx);
  };
  const Floats near = lerp(row_at(0), row_at(view.row), fy);
  const Floats far = lerp(row_at(view.slice), row_at(view.slice + view.row), fy);
  return hn::Mul(lerp(near, far, fz), hn::Set(d, 1.0F / static_cast<float>(kMask)));
}

// Trilinear value from the texel indices of the lower corners (64-byte aligned) and the weights.
template <Format format>
HWY_INLINE Floats volume_fetch(const VolumeView& view, const int32_t* index, Floats fx, Floats fy, Floats fz) {
  static_assert(format == Format::R8 || format == Format::R16 || format == Format::R32F);
  if constexpr (format == Format::R8) {
    return fetch_unorm<8>(view, index, fx, fy, fz);
  } else if constexpr (format == Format::R16) {
    return fetch_unorm<16>(view, index, fx, fy, fz);
  } else {
    return fetch_float(view, index, fx, fy, fz);
  }
}

template <Format format>
HWY_INLINE Floats sample_volume(const VolumeView& view, Floats u, Floats v, Floats w) {
  const VolumeCell cell = volume_cell(view, u, v, w);
  alignas(64) int32_t index[kMaxLanes];
  hn::Store(cell.index, IntTag(), index);
  keep_in_memory(index);
  return volume_fetch<format>(view, index, cell.fx, cell.fy, cell.fz);
}

// The cells of a whole batch, for the two steps apart.
struct alignas(64) VolumeCells {
  int32_t index[kMaxBatch + kBatchPadding];
  float fx[kMaxBatch + kBatchPadding], fy[kMaxBatch + kBatchPadding], fz[kMaxBatch + kBatchPadding];

  HWY_INLINE void put(size_t i, const VolumeCell& cell) {
    hn::Store(cell.index, IntTag(), index + i);
    store(cell.fx, fx + i);
    store(cell.fy, fy + i);
    store(cell.fz, fz + i);
  }
  // Asks for the cache lines of some of the cells from i on: most lie in lines of their neighbours.
  template <Format format>
  HWY_INLINE void prefetch(const VolumeView& view, size_t i) const {
    constexpr ptrdiff_t kBytes = format == Format::R8 ? 1 : format == Format::R16 ? 2 : 4;
    for (size_t lane = 0; lane < hn::Lanes(FloatTag()); lane += 8) {
      const std::byte* at = view.data + index[i + lane] * kBytes;
      hwy::Prefetch(at);
      hwy::Prefetch(at + (view.slice + view.row) * kBytes);
    }
  }
  template <Format format>
  HWY_INLINE Floats fetch(const VolumeView& view, size_t i) const {
    return volume_fetch<format>(view, index + i, load(fx + i), load(fy + i), load(fz + i));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#endif
