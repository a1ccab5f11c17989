// Which pixels of a tile a triangle covers: exact, from integer edge functions. Included by tile_raster.cpp.
#if defined(VOLUMARK_CPU_COVERAGE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMARK_CPU_COVERAGE_INL_H_
#undef VOLUMARK_CPU_COVERAGE_INL_H_
#else
#define VOLUMARK_CPU_COVERAGE_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {

struct TileCoverage {
  int first_row = 0, end_row = 0;
  uint32_t rows[kTile];  // bit i: column i; valid in [first_row, end_row)
};

HWY_INLINE uint32_t sign_bits(Ints v) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3
  return _mm512_movepi32_mask(v.raw);
#elif HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
  return static_cast<uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(v.raw)));
#elif HWY_ARCH_X86 && HWY_TARGET <= HWY_SSE4
  return static_cast<uint32_t>(_mm_movemask_ps(_mm_castsi128_ps(v.raw)));
#else
  alignas(64) int32_t lanes[kMaxLanes];
  const IntTag di;
  hn::Store(v, di, lanes);
  uint32_t bits = 0;
  for (size_t i = 0; i < hn::Lanes(di); ++i) {
    bits |= (lanes[i] < 0 ? 1U : 0U) << i;
  }
  return bits;
#endif
}

// Edges that cross the tile, moved to its first pixel. Where an edge crosses, its values in the tile stay below 2^30:
// a and b are below 2^24 each (geometry.cpp's guard band).
struct CrossingEdges {
  int count = 0;
  int32_t value[3], a[3], b[3];
};

template <int edges>
HWY_INLINE uint32_t row_coverage(const CrossingEdges& crossing, int row) {
  const IntTag di;
  uint32_t outside = 0;
  for (size_t k = 0; k < kTile; k += hn::Lanes(di)) {
    const Ints column = hn::Iota(di, static_cast<int32_t>(k));
    Ints any = hn::Zero(di);
    for (int e = 0; e < edges; ++e) {
      const Ints start = hn::Set(di, crossing.value[e] + crossing.b[e] * row);
      any = hn::Or(any, hn::Add(start, hn::Mul(column, hn::Set(di, crossing.a[e]))));
    }
    outside |= sign_bits(any) << k;
  }
  return ~outside;
}

template <int edges>
void cover_rows(const CrossingEdges& crossing, uint32_t columns, TileCoverage& coverage) {
  for (int row = coverage.first_row; row < coverage.end_row; ++row) {
    coverage.rows[row] = columns & row_coverage<edges>(crossing, row);
  }
}

// False if the triangle certainly covers nothing of the tile whose first pixel is (origin_x, origin_y).
inline bool cover_tile(const Triangle& triangle, int origin_x, int origin_y, TileCoverage& coverage) {
  const int x0 = std::max(triangle.x0 - origin_x, 0), x1 = std::min(triangle.x1 - origin_x, kTile);
  coverage.first_row = std::max(triangle.y0 - origin_y, 0);
  coverage.end_row = std::min(triangle.y1 - origin_y, kTile);
  if (x0 >= x1 || coverage.first_row >= coverage.end_row) {
    return false;
  }
  CrossingEdges crossing;
  for (const Edge& edge : triangle.edges) {
    const int64_t value = int64_t{edge.a} * origin_x + int64_t{edge.b} * origin_y + edge.c;
    const int64_t most = value + (int64_t{std::max(edge.a, 0)} + std::max(edge.b, 0)) * (kTile - 1);
    const int64_t least = value + (int64_t{std::min(edge.a, 0)} + std::min(edge.b, 0)) * (kTile - 1);
    if (most < 0) {
      return false;
    }
    if (least < 0) {
      const int i = crossing.count++;
      crossing.value[i] = static_cast<int32_t>(value);
      crossing.a[i] = edge.a;
      crossing.b[i] = edge.b;
    }
  }
  const uint32_t columns = (x1 - x0 == 32 ? ~0U : (1U << (x1 - x0)) - 1) << x0;
  switch (crossing.count) {
    case 0:
      std::fill(coverage.rows + coverage.first_row, coverage.rows + coverage.end_row, columns);
      break;
    case 1:
      cover_rows<1>(crossing, columns, coverage);
      break;
    case 2:
      cover_rows<2>(crossing, columns, coverage);
      break;
    default:
      cover_rows<3>(crossing, columns, coverage);
      break;
  }
  return true;
}

}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#endif
