// Twin of slices2d.vert and slices2d_fixed.frag, the same bits.
#include "methods/slices2d/fixed_slices2d.h"

// After the headers without Highway.
#include "backends/cpu/highway_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "methods/slices2d/slices2d_fixed_twin.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "methods/volume/fixed_point-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {
namespace {

// FixedBindings with the page in place of the volume.
struct FixedSliceBindings : FixedBindings {
  const FixedSliceUniforms& slice;
  explicit FixedSliceBindings(const CpuBindings& bindings)
      : FixedBindings(bindings), slice(*reinterpret_cast<const FixedSliceUniforms*>(bindings.buffers[3].data)) {}
};

void vertex(const CpuBindings&, VertexBatch& batch) {
  for (size_t i = 0; i < batch.count; ++i) {
    const float* ndc = attribute_of(batch, 0, i);
    const float* group = attribute_of(batch, 1, i);
    const float position[4] = {ndc[0], ndc[1], .5F, 1.F};
    std::copy_n(position, 4, batch.position + 4 * i);
    std::copy_n(group, 2, batch.varyings + batch.varying_stride * i);
  }
}

// ---- Texels ----
// Offset of texel (x, y) of stored slice z; one past the last texel of a row or column is the tile's gutter, which
// repeats it.
HWY_INLINE Ints texel_place(const FixedSliceBindings& b, Ints x, Ints y, Ints z) {
  const Float4& tiles = b.slice.tiles;
  const Floats place = hn::Sub(hn::ConvertTo(FloatTag(), z), splat(tiles[1])), columns = splat(tiles[0]);
  const Floats row = hn::Floor(hn::Div(hn::Add(place, splat(.5F)), columns));
  const Ints column = truncate(hn::Sub(place, hn::Mul(row, columns)));
  const Ints left = hn::Add(hn::Mul(column, whole(tiles[2])), hn::Add(x, whole(1)));
  const Ints top = hn::Add(hn::Mul(truncate(row), whole(tiles[3])), hn::Add(y, whole(1)));
  return hn::Add(left, hn::Mul(top, whole(static_cast<int32_t>(b.volume.row_stride))));
}

// The cell of t: offsets of its lower corner in both slices, and the weights.
struct SliceCell {
  Ints below, above, fx, fy, fz;
};
HWY_INLINE SliceCell slice_cell(const FixedSliceBindings& b, const Ints3& t) {
  const auto lower = [&](Ints v, float last)
                         HWY_ATTR { return hn::Min(hn::Max(hn::ShiftRight<8>(v), whole(0)), whole(last)); };
  const Ints x = lower(t.x, b.fx.last[0]), y = lower(t.y, b.fx.last[1]), z = lower(t.z, b.fx.last[2]);
  const Ints next = hn::Min(hn::Add(z, whole(1)), whole(b.fx.last[2])), mask = whole(255);
  const Ints fz = hn::And(t.z, mask);
  // A slice that has no weight need not be on the page.
  const Ints above = hn::IfThenElse(hn::Eq(fz, whole(0)), z, next);
  return {texel_place(b, x, y, z), texel_place(b, x, y, above), hn::And(t.x, mask), hn::And(t.y, mask), fz};
}

HWY_INLINE Ints filtered_red(const FixedSliceBindings& b, const Ints3& t) {
  const SliceCell cell = slice_cell(b, t);
  const Ints mask = whole(255);
  const auto row = [&](Ints offset, ptrdiff_t texels) HWY_ATTR {
    const Ints pair = gather_words(b.volume.data + texels, offset);  // x neighbours in one word
    return interpolated(hn::And(pair, mask), hn::And(hn::ShiftRight<8>(pair), mask), cell.fx);
  };
  const Ints near = interpolated(row(cell.below, 0), row(cell.below, b.volume.row_stride), cell.fy);
  const Ints far = interpolated(row(cell.above, 0), row(cell.above, b.volume.row_stride), cell.fy);
  return interpolated(near, far, cell.fz);
}

HWY_INLINE Ints4 filtered_rgba(const FixedSliceBindings& b, const Ints3& t) {
  const SliceCell cell = slice_cell(b, t);
  const auto row = [&](Ints offset, ptrdiff_t texels) HWY_ATTR {
    const std::byte* data = b.volume.data + 4 * texels;
    const Ints at = hn::ShiftLeft<2>(offset);
    return interpolated(unpacked(gather_words(data, at)), unpacked(gather_words(data + 4, at)), cell.fx);
  };
  const Ints4 near = interpolated(row(cell.below, 0), row(cell.below, b.volume.row_stride), cell.fy);
  const Ints4 far = interpolated(row(cell.above, 0), row(cell.above, b.volume.row_stride), cell.fy);
  return interpolated(near, far, cell.fz);
}

// sample_at
template <bool classified>
HWY_INLINE Ints4 slice_sample(const FixedSliceBindings& b, const Ints3& t, IntMask wanted) {
  const IntMask kept = hn::And(wanted, inside(b.fx, t));
  if (hn::AllFalse(IntTag(), kept)) return nothing();
  if constexpr (classified) {
    return kept_where(kept, filtered_rgba(b, t));
  } else {
    const Ints4 entry = palette_at(b, filtered_red(b, t));
    return kept_where(kept, {product(entry.r, entry.a), product(entry.g, entry.a), product(entry.b, entry.a), entry.a});
  }
}

// ---- Slices ----
HWY_INLINE Floats reciprocal(Floats x) {
  const FloatTag d;
  const IntTag di;
  const Floats magnitude = hn::Max(hn::Abs(x), splat(1e-12F));
  Floats r = hn::BitCast(d, hn::Sub(hn::Set(di, 0x7ef311c7), hn::BitCast(di, magnitude)));
  for (int i = 0; i < 4; ++i) r = hn::Mul(r, hn::Sub(splat(2.F), hn::Mul(magnitude, r)));
  return hn::IfThenElse(hn::Lt(x, splat(0.F)), hn::Neg(r), r);
}

template <bool classified, bool interpolate, bool corrected>
void fragment(const CpuBindings& bindings, FragmentBatch& batch) {
  const FixedSliceBindings b(bindings);
  const IntTag di;
  const Float4& slices = b.slice.slices;
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const Floats half = splat(.5F), one = splat(1.F);
    const Axes origin = window_origin(b.fx, load(batch.x + i), load(batch.y + i));
    const Axes direction = window_direction(b.fx, load(batch.x + i), load(batch.y + i));
    const Floats inverse = reciprocal(direction.z);
    const Floats first = hn::Floor(hn::Add(load(batch.varyings[0] + i), half)), run = load(batch.varyings[1] + i);
    const Floats toward = hn::CopySign(one, run), count = hn::Floor(hn::Add(hn::Abs(run), half));
    Ints4 sum = nothing();
    Ints3 t{};
    IntMask seen = hn::FirstN(di, 0);
    for (Floats number = splat(0.F);; number = hn::Add(number, one)) {
      const IntMask drawn = hn::RebindMask(di, hn::Lt(number, count));
      if (hn::AllFalse(di, drawn)) break;
      const Floats k = hn::Add(first, hn::Mul(toward, number));
      const Floats stored = hn::Add(splat(slices[0]), hn::Mul(k, splat(slices[1])));
      if (corrected || hn::AllTrue(FloatTag(), hn::Eq(number, splat(0.F)))) {
        const Floats z = hn::Mul(hn::Sub(stored, origin.z), inverse);
        t = position_of(origin, direction, z);
        seen = hn::RebindMask(di, hn::Ge(z, splat(slices[2])));
      }
      t.z = interpolate ? truncate(hn::Floor(hn::Add(hn::Mul(stored, splat(256.F)), half)))
                        : hn::ShiftLeft<8>(truncate(hn::Round(stored)));
      const Ints4 sampled = slice_sample<classified>(b, t, hn::And(drawn, seen));
      const Ints through = hn::Sub(whole(255), sampled.a);
      sum = {clamped(hn::Add(sampled.r, product(sum.r, through))), clamped(hn::Add(sampled.g, product(sum.g, through))),
             clamped(hn::Add(sampled.b, product(sum.b, through))),
             clamped(hn::Add(sampled.a, product(sum.a, through)))};
    }
    store_levels(batch, i, sum);
  });
}

template <bool classified>
CpuFragmentKernel of_texels(bool interpolate, bool corrected) {
  if (interpolate) return corrected ? fragment<classified, true, true> : fragment<classified, true, false>;
  return corrected ? fragment<classified, false, true> : fragment<classified, false, false>;
}

// Constants in the order of their ids: fixed_point.glsl, slices2d_fixed.frag.
CpuKernels specialise(std::span<const int32_t> constants) {
  const bool interpolate = constants[6] != 0, corrected = constants[7] != 0;
  CpuKernels kernels;
  kernels.vertex = vertex;
  kernels.fragment = fixed_texel(constants) == FixedTexel::Classified ? of_texels<true>(interpolate, corrected)
                                                                      : of_texels<false>(interpolate, corrected);
  kernels.varyings = 2;
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
const CpuProgram slices2d_fixed_twin{
    "slices2d_fixed", [](std::span<const int32_t> constants) { return HWY_DYNAMIC_DISPATCH(specialise)(constants); }};
}  // namespace volumark
#endif
