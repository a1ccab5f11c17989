// The twin of volume_common.glsl on SIMD lanes, function by function, for CPU twins of volume methods. Include inside a
// foreach_target file after backends/cpu/sample-inl.h. Lanes where a result has no meaning (outside of a batch, empty
// segments) hold finite values.
#include "backends/cpu/sample-inl.h"
#include "backends/defects.h"
#include "methods/volume/volume_uniforms.h"

#if defined(VOLUMARK_METHODS_VOLUME_TWIN_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMARK_METHODS_VOLUME_TWIN_INL_H_
#undef VOLUMARK_METHODS_VOLUME_TWIN_INL_H_
#else
#define VOLUMARK_METHODS_VOLUME_TWIN_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {

struct Floats3 {
  Floats x, y, z;
};
HWY_INLINE Floats3 splat3(const Float4& v) { return {splat(v[0]), splat(v[1]), splat(v[2])}; }
HWY_INLINE Floats3 operator+(const Floats3& a, const Floats3& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Floats3 operator-(const Floats3& a, const Floats3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Floats3 operator*(const Floats3& a, const Floats3& b) {
  return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}
HWY_INLINE Floats3 scaled(const Floats3& a, Floats s) { return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)}; }
// a + s b
HWY_INLINE Floats3 along(const Floats3& a, Floats s, const Floats3& b) {
  return {hn::MulAdd(s, b.x, a.x), hn::MulAdd(s, b.y, a.y), hn::MulAdd(s, b.z, a.z)};
}
HWY_INLINE Floats dot(const Floats3& a, const Floats3& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE Floats3 normalised(const Floats3& a) {
  return scaled(a, hn::Div(splat(1.F), hn::Sqrt(hn::Max(dot(a, a), splat(1e-35F)))));
}
HWY_INLINE Floats clamp01(Floats v) { return hn::Min(hn::Max(v, splat(0.F)), splat(1.F)); }

// The bindings 0..3 of volume_common.glsl.
struct VolumeBindings {
  const VolumeUniforms& vm;
  const CpuTexture& volume;
  const CpuTexture& transfer;
  const CpuTexture& preintegrated;
  explicit VolumeBindings(const CpuBindings& bindings)
      : vm(*reinterpret_cast<const VolumeUniforms*>(bindings.buffers[0].data)),
        volume(bindings.textures[1]),
        transfer(bindings.textures[2]),
        preintegrated(bindings.textures[3]) {}
};

// ---- Rays ----
HWY_INLINE Floats3 ray_origin(const VolumeUniforms& vm, Floats x, Floats y) {
  return along(along(splat3(vm.ray_origin), x, splat3(vm.ray_origin_x)), y, splat3(vm.ray_origin_y));
}
HWY_INLINE Floats3 ray_direction(const VolumeUniforms& vm, Floats x, Floats y) {
  return along(along(splat3(vm.ray_direction), x, splat3(vm.ray_direction_x)), y, splat3(vm.ray_direction_y));
}
HWY_INLINE Floats ray_length(const VolumeUniforms& vm, const Floats3& direction) {
  if (defect(Defect::RayLengthIgnored)) return splat(1.F);
  const Floats3 world = direction * splat3(vm.extent);
  return hn::Sqrt(dot(world, world));
}

// Clips [z0, z1] to where o + z d >= 0.
HWY_INLINE void clip_half_space(Floats o, Floats d, Floats& z0, Floats& z1) {
  const Floats zero = splat(0.F);
  const auto enters = hn::Gt(d, zero);
  const auto leaves = hn::Lt(d, zero);
  const auto parallel = hn::Eq(d, zero);
  const Floats z = hn::Div(hn::Neg(o), hn::IfThenElse(parallel, splat(1.F), d));
  z0 = hn::IfThenElse(enters, hn::Max(z0, z), z0);
  z1 = hn::IfThenElse(leaves, hn::Min(z1, z), z1);
  const auto outside = defect(Defect::FlippedParallel) ? hn::Ge(o, zero) : hn::Lt(o, zero);
  z1 = hn::IfThenElse(hn::And(parallel, outside), z0, z1);
}

template <bool clip_planes>
HWY_INLINE void clip_ray(const VolumeUniforms& vm, const Floats3& origin, const Floats3& direction, Floats& z0,
                         Floats& z1) {
  const auto clip_axis = [&](Floats o, Floats d) HWY_ATTR {
    const Floats tiny = splat(defect(Defect::UnguardedDivision) ? 0.F : 1e-20F), half = splat(.5F);
    const Floats inverse = hn::Div(splat(1.F), hn::IfThenElse(hn::Lt(hn::Abs(d), tiny), tiny, d));
    const Floats middle = hn::Mul(hn::Sub(half, o), inverse), reach = hn::Abs(hn::Mul(half, inverse));
    z0 = hn::Max(z0, hn::Sub(middle, reach));
    z1 = hn::Min(z1, hn::Add(middle, reach));
  };
  clip_axis(origin.x, direction.x);
  clip_axis(origin.y, direction.y);
  clip_axis(origin.z, direction.z);
  if constexpr (clip_planes) {
    for (int i = 0; i < static_cast<int>(vm.counts[1]); ++i) {
      const Floats3 normal = splat3(vm.clip_planes[i]);
      clip_half_space(hn::Sub(dot(normal, origin), splat(vm.clip_planes[i][3])), dot(normal, direction), z0, z1);
    }
  }
}

// ---- Sampling ----
HWY_INLINE Floats3 texture_position(const VolumeUniforms& vm, const Floats3& box) {
  return box * splat3(vm.texture_scale) + splat3(vm.texture_offset);
}
HWY_INLINE Floats normalised_value(const VolumeUniforms& vm, Floats stored) {
  return hn::Mul(hn::Sub(stored, splat(vm.value[0])), splat(vm.value[1]));
}
HWY_INLINE Floats sample_at(const VolumeBindings& b, const Floats3& position) {
  return normalised_value(b.vm, sample_3d_red(b.volume, position.x, position.y, position.z));
}
HWY_INLINE Floats sample_value(const VolumeBindings& b, const Floats3& box) {
  return sample_at(b, texture_position(b.vm, box));
}
HWY_INLINE Rgba sample_classified(const VolumeBindings& b, const Floats3& box) {
  const Floats3 p = texture_position(b.vm, box);
  return sample_3d(b.volume, p.x, p.y, p.z);
}
HWY_INLINE Floats3 sample_gradient(const VolumeBindings& b, const Floats3& box) {
  const Floats3 p = texture_position(b.vm, box);
  const Floats zero = splat(0.F);
  const Floats3 ex{splat(b.vm.texel[0]), zero, zero}, ey{zero, splat(b.vm.texel[1]), zero},
      ez{zero, zero, splat(b.vm.texel[2])};
  const Floats3 after{sample_at(b, p + ex), sample_at(b, p + ey), sample_at(b, p + ez)};
  const Floats3 before{sample_at(b, p - ex), sample_at(b, p - ey), sample_at(b, p - ez)};
  return (after - before) * splat3(b.vm.gradient_scale);
}

// ---- Classification ----
HWY_INLINE Rgba mix(const Rgba& a, const Rgba& b, Floats t) { return lerp(a, b, t); }

HWY_INLINE Rgba transfer(const VolumeBindings& b, Floats s) {
  const IntTag di;
  const FloatTag d;
  const Floats last = splat(b.vm.value[2]);
  const Floats x = hn::Mul(clamp01(s), last);
  const Ints i = hn::Min(truncate(x), hn::Set(di, b.transfer.width - 2));
  const auto* entries = reinterpret_cast<const float*>(b.transfer.data);
  return lerp_entries(entries, i, hn::Sub(x, hn::ConvertTo(d, i)));
}

HWY_INLINE Rgba transfer_segment(const VolumeBindings& b, Floats front, Floats back) {
  const IntTag di;
  const FloatTag d;
  const Floats last = splat(b.vm.value[3]);
  const Ints limit = hn::Set(di, b.preintegrated.width - 2);
  const Floats x = hn::Mul(clamp01(front), last), y = hn::Mul(clamp01(back), last);
  const Ints ix = hn::Min(truncate(x), limit), iy = hn::Min(truncate(y), limit);
  const auto row = static_cast<int32_t>(b.preintegrated.row_stride);
  const Ints i = hn::Add(ix, hn::Mul(iy, hn::Set(di, row)));
  const auto* entries = reinterpret_cast<const float*>(b.preintegrated.data);
  const Floats fx = hn::Sub(x, hn::ConvertTo(d, ix)), fy = hn::Sub(y, hn::ConvertTo(d, iy));
  const float* next_row = entries + 4 * static_cast<ptrdiff_t>(row);
  return lerp(lerp_entries(entries, i, fx), lerp_entries(next_row, i, fx), fy);
}

template <bool linear_opacity>
HWY_INLINE Floats opacity_of(Floats x) {
  if constexpr (linear_opacity) return hn::Min(x, splat(1.F));
  if (defect(Defect::LinearOpacity)) return hn::Min(x, splat(1.F));
  const IntTag di;
  const Floats one = splat(1.F);
  const Floats y = hn::Min(x, splat(80.F));
  const Floats k = hn::Round(hn::Mul(y, splat(1.44269504F)));
  const Floats r = hn::NegMulAdd(k, splat(2.12194440e-4F), hn::MulSub(k, splat(.693359375F), y));
  // The polynomial of the GLSL by Estrin's scheme: half as long a chain of operations that wait for each other.
  const Floats r2 = hn::Mul(r, r);
  const Floats low = hn::MulAdd(hn::MulAdd(splat(1.F / 24), r, splat(1.F / 6)), r2, hn::MulAdd(splat(.5F), r, one));
  const Floats high = hn::MulAdd(splat(1.F / 5040), r2, hn::MulAdd(splat(1.F / 720), r, splat(1.F / 120)));
  const Floats e = hn::Mul(hn::MulAdd(hn::Mul(r2, r2), high, low), r);
  const Floats p = hn::BitCast(FloatTag(), hn::ShiftLeft<23>(hn::Sub(hn::Set(di, 127), truncate(k))));
  if (defect(Defect::NaiveExponential)) return hn::Sub(one, hn::MulAdd(p, e, p));
  return hn::NegMulAdd(p, e, hn::Sub(one, p));
}

// -log(x) for 1e-30 <= x <= 1: exponent and an atanh series of the mantissa.
HWY_INLINE Floats negative_log(Floats x) {
  const FloatTag d;
  const IntTag di;
  // Mantissa in [sqrt(.5), sqrt(2)).
  const Ints bits = hn::Sub(hn::BitCast(di, x), hn::Set(di, 0x3f3504f3));
  const Ints exponent = hn::ShiftRight<23>(bits);
  const Floats m = hn::BitCast(d, hn::Add(hn::And(bits, hn::Set(di, 0x7fffff)), hn::Set(di, 0x3f3504f3)));
  const Floats t = hn::Div(hn::Sub(m, splat(1.F)), hn::Add(m, splat(1.F)));
  const Floats t2 = hn::Mul(t, t);
  Floats s = splat(2.F / 9);
  s = hn::MulAdd(s, t2, splat(2.F / 7));
  s = hn::MulAdd(s, t2, splat(2.F / 5));
  s = hn::MulAdd(s, t2, splat(2.F / 3));
  s = hn::MulAdd(s, t2, splat(2.F));
  return hn::Neg(hn::MulAdd(hn::ConvertTo(d, exponent), splat(.69314718F), hn::Mul(s, t)));
}

template <bool linear_opacity>
HWY_INLINE Floats correct_opacity(Floats a, Floats ratio) {
  Floats series = splat(1.F / 6);
  series = hn::MulAdd(series, a, splat(1.F / 5));
  series = hn::MulAdd(series, a, splat(1.F / 4));
  series = hn::MulAdd(series, a, splat(1.F / 3));
  series = hn::MulAdd(series, a, splat(1.F / 2));
  series = hn::MulAdd(series, a, splat(1.F));
  const Floats depth = hn::IfThenElse(hn::Lt(a, splat(.1F)), hn::Mul(a, series),
                                      negative_log(hn::Max(hn::Sub(splat(1.F), a), splat(1e-30F))));
  return opacity_of<linear_opacity>(hn::Mul(depth, ratio));
}

// ---- Lighting ----
struct Light3 {
  Floats3 diffuse, specular;
};

// x^power for 0 < x <= 1, power >= 0.
HWY_INLINE Floats power_of(Floats x, float power) {
  const Floats depth = hn::Mul(negative_log(hn::Max(x, splat(1e-30F))), splat(power));
  return hn::Sub(splat(1.F), opacity_of<false>(depth));
}

// Adds to `sum` what the lights do at points of normal n.
HWY_INLINE void add_lights(const VolumeUniforms& vm, const Floats3& n, const Floats3& box, Light3& sum) {
  const Floats zero = splat(0.F);
  const Floats3 local = scaled(
      Floats3{hn::Sub(box.x, splat(.5F)), hn::Sub(box.y, splat(.5F)), hn::Sub(box.z, splat(.5F))} * splat3(vm.extent),
      splat(1.F));
  const Floats3 v = vm.eye[3] > 0 ? normalised(splat3(vm.eye) - local) : scaled(splat3(vm.forward), splat(-1.F));
  const bool two_sided = vm.counts[3] > 0;
  for (int i = 0; i < static_cast<int>(vm.counts[0]); ++i) {
    const VolumeLight& light = vm.lights[i];
    const Floats3 colour = splat3(light.colour);
    const Floats3 l = light.vector[3] > 0 ? normalised(splat3(light.vector) - local) : splat3(light.vector);
    const Floats nl = dot(n, l);
    const Floats facing = two_sided ? hn::Abs(nl) : hn::Max(nl, zero);
    sum.diffuse = along(sum.diffuse, hn::Mul(facing, splat(vm.lighting[1])), colour);
    if (vm.counts[2] > 0) {
      const Floats3 h = l + v;
      const Floats h2 = defect(Defect::UnnormalisedHalfway) ? splat(1.F) : dot(h, h);
      Floats nh = hn::IfThenElse(hn::Gt(h2, zero), hn::Div(dot(n, h), hn::Sqrt(hn::Max(h2, splat(1e-35F)))), zero);
      nh = two_sided ? hn::Abs(nh) : hn::IfThenElse(hn::Gt(nl, zero), hn::Max(nh, zero), zero);
      const auto lit = hn::Gt(nh, zero);
      const Floats shine = hn::Mul(power_of(nh, vm.lighting[3]), splat(vm.lighting[2]));
      sum.specular = along(sum.specular, hn::IfThenElse(lit, shine, zero), colour);
    }
  }
}

HWY_INLINE Floats3 normal_of(const VolumeUniforms& vm, const Floats3& g) {
  const float least = defect(Defect::UnboundedNormal) ? 0.F : vm.gradient_scale[3];
  return scaled(g, hn::Div(splat(-1.F), hn::Max(hn::Sqrt(dot(g, g)), splat(least))));
}

HWY_INLINE Light3 light_sample(const VolumeBindings& b, const Floats3& box) {
  const Floats ambient = splat(b.vm.lighting[0]), zero = splat(0.F);
  Light3 sum{{ambient, ambient, ambient}, {zero, zero, zero}};
  add_lights(b.vm, normal_of(b.vm, sample_gradient(b, box)), box, sum);
  return sum;
}

// ---- A segment of a ray: premultiplied colour and opacity ----
HWY_INLINE Floats3 colour_of(const Rgba& c) { return {c.r, c.g, c.b}; }
HWY_INLINE Rgba with_alpha(const Floats3& c, Floats alpha) { return {c.x, c.y, c.z, alpha}; }
HWY_INLINE bool all_zero(Floats alpha) { return hn::AllFalse(FloatTag(), hn::Gt(alpha, splat(0.F))); }

template <bool linear_opacity, bool lit>
HWY_INLINE Rgba shade_segment(const VolumeBindings& b, const Rgba& point, Floats len, const Floats3& box) {
  const Floats alpha = opacity_of<linear_opacity>(hn::Mul(point.a, len));
  Floats3 colour = colour_of(point);
  if constexpr (lit) {
    if (!all_zero(alpha)) {
      const Light3 light = light_sample(b, box);
      colour = colour * light.diffuse + light.specular;
    }
  }
  return with_alpha(scaled(colour, alpha), alpha);
}

template <bool linear_opacity, bool lit>
HWY_INLINE Rgba shade_preintegrated(const VolumeBindings& b, const Rgba& mean, Floats len, const Floats3& box) {
  const Floats x = hn::Mul(mean.a, len);
  const Floats alpha = opacity_of<linear_opacity>(x);
  const auto thick = hn::Gt(x, splat(1e-30F));
  const Floats weight = hn::IfThenElse(thick, hn::Div(alpha, hn::IfThenElse(thick, mean.a, splat(1.F))), len);
  Floats3 colour = scaled(colour_of(mean), weight);
  if constexpr (lit) {
    if (!all_zero(alpha)) {
      const Light3 light = light_sample(b, box);
      colour = colour * light.diffuse + scaled(light.specular, alpha);
    }
  }
  return with_alpha(colour, alpha);
}

template <bool linear_opacity>
HWY_INLINE Rgba shade_classified(const VolumeBindings& b, const Rgba& voxel, Floats len) {
  const Floats zero = splat(0.F);
  const auto seen = hn::Gt(voxel.a, zero);
  const Floats alpha =
      hn::IfThenElseZero(seen, correct_opacity<linear_opacity>(voxel.a, hn::Mul(len, splat(b.vm.size[3]))));
  if (defect(Defect::UnassociatedColours)) return with_alpha(scaled(colour_of(voxel), alpha), alpha);
  const Floats weight = hn::IfThenElseZero(seen, hn::Div(alpha, hn::IfThenElse(seen, voxel.a, splat(1.F))));
  return with_alpha(scaled(colour_of(voxel), weight), alpha);
}

}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#endif
