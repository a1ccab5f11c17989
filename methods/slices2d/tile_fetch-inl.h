// Bilinear fetch of one channel from a tile of a page on SIMD lanes, for R8, R16 and R32F: two loads a sample and row
// instead of the general sampler. Include after backends/cpu/sample-inl.h inside a foreach_target file.
#if defined(VOLUMARK_METHODS_SLICES2D_TILE_FETCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMARK_METHODS_SLICES2D_TILE_FETCH_INL_H_
#undef VOLUMARK_METHODS_SLICES2D_TILE_FETCH_INL_H_
#else
#define VOLUMARK_METHODS_SLICES2D_TILE_FETCH_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {

// The lower left texel of the cells of a vector of samples (64-byte aligned) and the weights inside.
struct TileCells {
  const std::byte* data;
  ptrdiff_t row;  // texels
  const int32_t* index;
  Floats fx, fy;
};

template <int bits>
HWY_INLINE Floats fetch_tile_unorm(const TileCells& cells) {
  const FloatTag d;
  const IntTag di;
  constexpr int kBytes = bits / 8;
  constexpr int32_t kMask = (1 << bits) - 1;
  const Ints offset = kBytes == 1 ? hn::Load(di, cells.index) : hn::ShiftLeft<kBytes - 1>(hn::Load(di, cells.index));
  const Ints mask = hn::Set(di, kMask);
  const auto row_at = [&](ptrdiff_t texels) HWY_ATTR {
    const Ints words = gather_words(cells.data + texels * kBytes, offset);
    const Floats x0 = hn::ConvertTo(d, hn::And(words, mask));
    const Floats x1 = hn::ConvertTo(d, hn::And(hn::ShiftRight<bits>(words), mask));
    return lerp(x0, x1, cells.fx);
  };
  return hn::Mul(lerp(row_at(0), row_at(cells.row), cells.fy), splat(1.0F / static_cast<float>(kMask)));
}

HWY_INLINE Floats fetch_tile_float(const TileCells& cells) {
  const FloatTag d;
  const auto* base = reinterpret_cast<const float*>(cells.data);
  const float* next = base + cells.row;
#if HWY_TARGET <= HWY_SSE4 && HWY_ARCH_X86
  const Floats a = lerp(load_pairs<0>(base, cells.index), load_pairs<0>(next, cells.index),
                        hn::InterleaveLower(d, cells.fy, cells.fy));
  const Floats b = lerp(load_pairs<2>(base, cells.index), load_pairs<2>(next, cells.index),
                        hn::InterleaveUpper(d, cells.fy, cells.fy));
  return lerp(shuffle_pairs<0x88>(a, b), shuffle_pairs<0xDD>(a, b), cells.fx);
#else
  alignas(64) float corner[4][kMaxLanes];
  for (size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    const int32_t at = cells.index[lane];
    corner[0][lane] = base[at];
    corner[1][lane] = base[at + 1];
    corner[2][lane] = next[at];
    corner[3][lane] = next[at + 1];
  }
  return lerp(lerp(load(corner[0]), load(corner[1]), cells.fx), lerp(load(corner[2]), load(corner[3]), cells.fx),
              cells.fy);
#endif
}

template <Format format>
HWY_INLINE Floats fetch_tile(const TileCells& cells) {
  static_assert(format == Format::R8 || format == Format::R16 || format == Format::R32F);
  if constexpr (format == Format::R8) {
    return fetch_tile_unorm<8>(cells);
  } else if constexpr (format == Format::R16) {
    return fetch_tile_unorm<16>(cells);
  } else {
    return fetch_tile_float(cells);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#endif
