// The twin of fixed_point.glsl on SIMD lanes, function by function, the same bits. Include inside a foreach_target
// file. No hn::MulAdd here: a fused multiplication has other bits.
#include "backends/cpu/sample-inl.h"
#include "methods/volume/fixed_point.h"

#if defined(VOLUMARK_METHODS_FIXED_POINT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMARK_METHODS_FIXED_POINT_INL_H_
#undef VOLUMARK_METHODS_FIXED_POINT_INL_H_
#else
#define VOLUMARK_METHODS_FIXED_POINT_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {

using IntMask = hn::Mask<IntTag>;
struct Axes {  // a vector of floats
  Floats x, y, z;
};
struct Ints3 {
  Ints x, y, z;
};
struct Ints4 {
  Ints r, g, b, a;
};

HWY_INLINE Ints whole(int32_t value) { return hn::Set(IntTag(), value); }
HWY_INLINE Ints whole(float value) { return hn::Set(IntTag(), static_cast<int32_t>(value)); }

// The bindings 0..2 of fixed_point.glsl.
struct FixedBindings {
  const FixedUniforms& fx;
  const CpuTexture& volume;
  const CpuTexture& palette;
  explicit FixedBindings(const CpuBindings& bindings)
      : fx(*reinterpret_cast<const FixedUniforms*>(bindings.buffers[0].data)),
        volume(bindings.textures[1]),
        palette(bindings.textures[2]) {}
};

// ---- Positions ----
HWY_INLINE Axes at_window(const Float4& p, const Float4& px, const Float4& py, Floats x, Floats y) {
  const auto axis = [&](size_t i) HWY_ATTR {
    return hn::Add(hn::Add(splat(p[i]), hn::Mul(x, splat(px[i]))), hn::Mul(y, splat(py[i])));
  };
  return {axis(0), axis(1), axis(2)};
}
HWY_INLINE Axes window_origin(const FixedUniforms& fx, Floats x, Floats y) {
  return at_window(fx.origin, fx.origin_x, fx.origin_y, x, y);
}
HWY_INLINE Axes window_direction(const FixedUniforms& fx, Floats x, Floats y) {
  return at_window(fx.direction, fx.direction_x, fx.direction_y, x, y);
}
HWY_INLINE Floats depth_of(const FixedUniforms& fx, Floats k, Floats step_z) {
  return hn::Add(splat(fx.depth[0]), hn::Mul(hn::Add(k, splat(.5F)), step_z));
}
HWY_INLINE Ints3 position_of(const Axes& origin, const Axes& direction, Floats z) {
  const auto axis = [&](Floats o, Floats d) HWY_ATTR {
    const Floats p = hn::Add(o, hn::Mul(z, d));
    const Floats kept = hn::Min(hn::Max(p, splat(-16.F)), splat(16384.F));
    return truncate(hn::Floor(hn::Add(hn::Mul(kept, splat(256.F)), splat(.5F))));
  };
  return {axis(origin.x, direction.x), axis(origin.y, direction.y), axis(origin.z, direction.z)};
}

HWY_INLINE IntMask inside(const FixedUniforms& fx, const Ints3& t) {
  const IntTag di;
  const FloatTag d;
  const auto within = [&](Ints v, float limit)
                          HWY_ATTR { return hn::And(hn::Gt(v, whole(-1)), hn::Lt(v, whole(limit + 1))); };
  IntMask kept = hn::And(within(t.x, fx.limit[0]), hn::And(within(t.y, fx.limit[1]), within(t.z, fx.limit[2])));
  const Floats x = hn::ConvertTo(d, t.x), y = hn::ConvertTo(d, t.y), z = hn::ConvertTo(d, t.z);
  for (int i = 0; i < static_cast<int>(fx.counts[1]); ++i) {
    const Float4& plane = fx.clip_planes[i];
    const Floats side =
        hn::Add(hn::Add(hn::Mul(splat(plane[0]), x), hn::Mul(splat(plane[1]), y)), hn::Mul(splat(plane[2]), z));
    kept = hn::And(kept, hn::RebindMask(di, hn::Ge(side, splat(plane[3]))));
  }
  return kept;
}

// ---- Levels ----
HWY_INLINE Ints rounded(Ints p) { return hn::ShiftRight<8>(hn::Add(hn::Add(p, hn::ShiftRight<8>(p)), whole(128))); }
HWY_INLINE Ints product(Ints a, Ints b) { return rounded(hn::Mul(a, b)); }
HWY_INLINE Ints clamped(Ints v) { return hn::Min(v, whole(255)); }
HWY_INLINE Ints dot_product(const Ints3& a, const Float4& b) {
  const Ints sum = hn::Add(hn::Add(hn::Mul(a.x, whole(b[0])), hn::Mul(a.y, whole(b[1]))), hn::Mul(a.z, whole(b[2])));
  const Ints m = clamped(rounded(hn::Abs(sum)));
  return hn::IfThenElse(hn::Lt(sum, hn::Zero(IntTag())), hn::Neg(m), m);
}

// ---- Texture filter ----
HWY_INLINE Ints interpolated(Ints a, Ints b, Ints f) {
  return hn::Add(a, hn::ShiftRight<8>(hn::Add(hn::Mul(hn::Sub(b, a), f), whole(128))));
}

// The cell of t: texel offset of its lower corner, and the weights. One past the last texel repeats it (CpuTexture).
struct FixedCell {
  Ints offset, fx, fy, fz;
};
HWY_INLINE FixedCell cell_of(const FixedBindings& b, const Ints3& t) {
  const auto lower = [&](Ints v, float last)
                         HWY_ATTR { return hn::Min(hn::Max(hn::ShiftRight<8>(v), whole(0)), whole(last)); };
  const Ints x = lower(t.x, b.fx.last[0]), y = lower(t.y, b.fx.last[1]), z = lower(t.z, b.fx.last[2]);
  const Ints rows = hn::Mul(y, whole(static_cast<int32_t>(b.volume.row_stride)));
  const Ints slices = hn::Mul(z, whole(static_cast<int32_t>(b.volume.slice_stride)));
  const Ints mask = whole(255);
  return {hn::Add(x, hn::Add(rows, slices)), hn::And(t.x, mask), hn::And(t.y, mask), hn::And(t.z, mask)};
}

HWY_INLINE Ints filtered_red(const FixedBindings& b, const Ints3& t) {
  const FixedCell cell = cell_of(b, t);
  const Ints mask = whole(255);
  const auto row = [&](ptrdiff_t texels) HWY_ATTR {
    const Ints pair = gather_words(b.volume.data + texels, cell.offset);  // x neighbours in one word
    return interpolated(hn::And(pair, mask), hn::And(hn::ShiftRight<8>(pair), mask), cell.fx);
  };
  const Ints near = interpolated(row(0), row(b.volume.row_stride), cell.fy);
  const Ints far = interpolated(row(b.volume.slice_stride), row(b.volume.slice_stride + b.volume.row_stride), cell.fy);
  return interpolated(near, far, cell.fz);
}

HWY_INLINE Ints4 unpacked(Ints word) {
  const Ints mask = whole(255);
  return {hn::And(word, mask), hn::And(hn::ShiftRight<8>(word), mask), hn::And(hn::ShiftRight<16>(word), mask),
          hn::And(hn::ShiftRight<24>(word), mask)};
}
HWY_INLINE Ints4 interpolated(const Ints4& a, const Ints4& b, Ints f) {
  return {interpolated(a.r, b.r, f), interpolated(a.g, b.g, f), interpolated(a.b, b.b, f), interpolated(a.a, b.a, f)};
}
HWY_INLINE Ints4 filtered_rgba(const FixedBindings& b, const Ints3& t) {
  const FixedCell cell = cell_of(b, t);
  const Ints offset = hn::ShiftLeft<2>(cell.offset);
  const auto row = [&](ptrdiff_t texels) HWY_ATTR {
    const std::byte* data = b.volume.data + 4 * texels;
    return interpolated(unpacked(gather_words(data, offset)), unpacked(gather_words(data + 4, offset)), cell.fx);
  };
  const Ints4 near = interpolated(row(0), row(b.volume.row_stride), cell.fy);
  const Ints4 far = interpolated(row(b.volume.slice_stride), row(b.volume.slice_stride + b.volume.row_stride), cell.fy);
  return interpolated(near, far, cell.fz);
}

HWY_INLINE Ints4 palette_at(const FixedBindings& b, Ints level) {
  return unpacked(gather_words(b.palette.data, hn::ShiftLeft<2>(level)));
}

// ---- Combiners ----
HWY_INLINE Ints3 lit(const FixedUniforms& fx, const Ints4& colour, const Ints4& stored) {
  const Ints zero = whole(0);
  const auto expand = [](Ints c) HWY_ATTR { return hn::Sub(hn::Add(c, c), whole(255)); };
  const Ints3 n{expand(stored.r), expand(stored.g), expand(stored.b)};
  const bool two_sided = fx.counts[3] > 0;
  const int power = static_cast<int>(fx.counts[2]);
  Ints3 diffuse{whole(fx.lighting[0]), whole(fx.lighting[1]), whole(fx.lighting[2])}, specular{zero, zero, zero};
  const auto add = [](Ints3& sum, Ints amount, const Float4& by) HWY_ATTR {
    sum.x = clamped(hn::Add(sum.x, product(amount, whole(by[0]))));
    sum.y = clamped(hn::Add(sum.y, product(amount, whole(by[1]))));
    sum.z = clamped(hn::Add(sum.z, product(amount, whole(by[2]))));
  };
  for (int i = 0; i < static_cast<int>(fx.counts[0]); ++i) {
    const FixedLight& light = fx.lights[i];
    const Ints nl = dot_product(n, light.direction);
    add(diffuse, two_sided ? hn::Abs(nl) : hn::Max(nl, zero), light.diffuse);
    if (power > 0) {
      const Ints signed_nh = dot_product(n, light.half);
      Ints nh = two_sided ? hn::Abs(signed_nh) : hn::IfThenElseZero(hn::Gt(nl, zero), hn::Max(signed_nh, zero));
      for (int k = 1; k < power; ++k) nh = product(nh, nh);
      add(specular, nh, light.specular);
    }
  }
  return {clamped(hn::Add(product(colour.r, diffuse.x), specular.x)),
          clamped(hn::Add(product(colour.g, diffuse.y), specular.y)),
          clamped(hn::Add(product(colour.b, diffuse.z), specular.z))};
}

HWY_INLINE Ints4 kept_where(IntMask kept, const Ints4& v) {
  return {hn::IfThenElseZero(kept, v.r), hn::IfThenElseZero(kept, v.g), hn::IfThenElseZero(kept, v.b),
          hn::IfThenElseZero(kept, v.a)};
}
HWY_INLINE Ints4 nothing() { return {whole(0), whole(0), whole(0), whole(0)}; }

enum class FixedTexel { Value, Lit, Classified };

// Premultiplied colour and opacity of the samples at t, levels; nothing outside of the volume or where not `wanted`.
template <FixedTexel kind>
HWY_INLINE Ints4 fixed_sample(const FixedBindings& b, const Ints3& t, IntMask wanted) {
  const IntTag di;
  const IntMask kept = hn::And(wanted, inside(b.fx, t));
  if (hn::AllFalse(di, kept)) return nothing();
  if constexpr (kind == FixedTexel::Classified) {
    return kept_where(kept, filtered_rgba(b, t));
  } else if constexpr (kind == FixedTexel::Lit) {
    const Ints4 texel = filtered_rgba(b, t), entry = palette_at(b, texel.a);
    const IntMask seen = hn::And(kept, hn::Gt(entry.a, hn::Zero(di)));
    if (hn::AllFalse(di, seen)) return nothing();
    const Ints3 colour = lit(b.fx, entry, texel);
    return kept_where(seen,
                      {product(colour.x, entry.a), product(colour.y, entry.a), product(colour.z, entry.a), entry.a});
  } else {
    const Ints4 entry = palette_at(b, filtered_red(b, t));
    return kept_where(kept, {product(entry.r, entry.a), product(entry.g, entry.a), product(entry.b, entry.a), entry.a});
  }
}

HWY_INLINE void store_levels(FragmentBatch& batch, size_t i, const Ints4& v) {
  const auto unit = [](Ints level) HWY_ATTR { return hn::Div(hn::ConvertTo(FloatTag(), level), splat(255.F)); };
  store_rgba(batch, i, {unit(v.r), unit(v.g), unit(v.b), unit(v.a)});
}

// Which kind of texel the constants of fixed_point.glsl mean.
inline FixedTexel fixed_texel(std::span<const int32_t> constants) {
  return constants[0] != 0 ? FixedTexel::Classified : constants[1] > 0 ? FixedTexel::Lit : FixedTexel::Value;
}

}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#endif
