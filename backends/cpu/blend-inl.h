// Blends shaded fragments into the float planes of a tile, rounding to what the target format can hold after every
// fragment: the error of 8 and 16 bit targets is part of what is shown. 8-bit targets are blended in integers, bit for
// bit as Mesa's llvmpipe and lavapipe do (tests/conformance/blend8_test.cpp); other GPUs may round otherwise, which the
// specifications of OpenGL and Vulkan leave open. Included by tile_raster.cpp.
#if defined(VOLUMARK_CPU_BLEND_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMARK_CPU_BLEND_INL_H_
#undef VOLUMARK_CPU_BLEND_INL_H_
#else
#define VOLUMARK_CPU_BLEND_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {

enum class Precision { Float, Half, Unorm8, Unorm16 };

constexpr Precision precision_of(Format format) {
  switch (format) {
    case Format::R8:
    case Format::RG8:
    case Format::RGBA8:
      return Precision::Unorm8;
    case Format::R16:
      return Precision::Unorm16;
    case Format::R16F:
    case Format::RGBA16F:
      return Precision::Half;
    default:
      return Precision::Float;
  }
}

HWY_INLINE Floats clamp_unit(Floats v) {
  const FloatTag d;
  return hn::Min(hn::Max(v, hn::Zero(d)), hn::Set(d, 1.0F));  // NaN becomes 0
}

HWY_INLINE Floats round_to_half(Floats v) {
  const FloatTag d;
#if HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86
  const hn::Rebind<hwy::float16_t, FloatTag> d16;
  return hn::PromoteTo(d, hn::DemoteTo(d16, v));  // the hardware rounds to nearest even
#else
  alignas(64) float lanes[kMaxLanes];
  hn::Store(v, d, lanes);
  for (size_t i = 0; i < hn::Lanes(d); ++i) {
    lanes[i] = float_from_half(half_from_float(lanes[i]));
  }
  return hn::Load(d, lanes);
#endif
}

// The nearest value that the format holds, as the tile's planes hold it: 8 bits as levels, 0 to 255.
template <Precision precision>
HWY_INLINE Floats quantise(Floats v) {
  const FloatTag d;
  if constexpr (precision == Precision::Float) {
    return v;
  } else if constexpr (precision == Precision::Half) {
    return round_to_half(v);
  } else if constexpr (precision == Precision::Unorm16) {
    return hn::Div(hn::Round(hn::Mul(clamp_unit(v), hn::Set(d, 65535.0F))), hn::Set(d, 65535.0F));
  } else {
    return hn::Round(hn::Mul(clamp_unit(v), hn::Set(d, 255.0F)));
  }
}

// The product of two 8-bit levels in Mesa's integers (lp_build_mul_norm): p = a b, then (p + (p >> 8) + 128) >> 8,
// which is a b / 255 to nearest but for a few products just above a half. Every step is exact in float.
HWY_INLINE Floats multiply_levels(Floats a, Floats b) {
  const FloatTag d;
  const Floats p = hn::Mul(a, b), per_256 = hn::Set(d, 1.0F / 256);
  return hn::Floor(hn::Mul(hn::Add(hn::Add(p, hn::Floor(hn::Mul(p, per_256))), hn::Set(d, 128.0F)), per_256));
}

// Of levels: the source was rounded to 8 bits, and each product is before the sum, which saturates.
template <Blend blend>
HWY_INLINE Rgba blend_levels(const Rgba& s, const Rgba& t) {
  const Floats most = hn::Set(FloatTag(), 255.0F);
  const auto sum = [&](Floats a, Floats b) HWY_ATTR { return hn::Min(hn::Add(a, b), most); };
  if constexpr (blend == Blend::Opaque) {
    return s;
  } else if constexpr (blend == Blend::Add) {
    return {sum(t.r, s.r), sum(t.g, s.g), sum(t.b, s.b), sum(t.a, s.a)};
  } else if constexpr (blend == Blend::Over) {
    const Floats k = hn::Sub(most, s.a);
    return {sum(s.r, multiply_levels(k, t.r)), sum(s.g, multiply_levels(k, t.g)), sum(s.b, multiply_levels(k, t.b)),
            sum(s.a, multiply_levels(k, t.a))};
  } else {
    const Floats k = hn::Sub(most, t.a);
    return {sum(t.r, multiply_levels(k, s.r)), sum(t.g, multiply_levels(k, s.g)), sum(t.b, multiply_levels(k, s.b)),
            sum(t.a, multiply_levels(k, s.a))};
  }
}

template <Precision precision, Blend blend>
HWY_INLINE Rgba blend_colours(const Rgba& s, const Rgba& t) {
  const Floats one = hn::Set(FloatTag(), 1.0F);
  if constexpr (precision == Precision::Unorm8) {
    return blend_levels<blend>(s, t);
  } else if constexpr (blend == Blend::Opaque) {
    return s;
  } else if constexpr (blend == Blend::Add) {
    return {hn::Add(t.r, s.r), hn::Add(t.g, s.g), hn::Add(t.b, s.b), hn::Add(t.a, s.a)};
  } else if constexpr (blend == Blend::Over) {
    const Floats k = hn::Sub(one, s.a);
    return {hn::MulAdd(k, t.r, s.r), hn::MulAdd(k, t.g, s.g), hn::MulAdd(k, t.b, s.b), hn::MulAdd(k, t.a, s.a)};
  } else {
    const Floats k = hn::Sub(one, t.a);
    return {hn::MulAdd(k, s.r, t.r), hn::MulAdd(k, s.g, t.g), hn::MulAdd(k, s.b, t.b), hn::MulAdd(k, s.a, t.a)};
  }
}

// Lanes [0, count) that are not discarded (`discard` may be null: none is).
HWY_INLINE FloatMask lanes_to_write(size_t count, const uint8_t* discard) {
  const FloatTag d;
  FloatMask mask = hn::FirstN(d, count);
  if (discard != nullptr) {
    const hn::Rebind<uint8_t, IntTag> d8;
    const Ints flags = hn::PromoteTo(IntTag(), hn::LoadU(d8, discard));
    mask = hn::And(mask, hn::RebindMask(d, hn::Eq(flags, hn::Zero(IntTag()))));
  }
  return mask;
}

template <Precision precision, bool alpha, Blend blend>
void blend_queue(FragmentQueue& queue, TileScratch& tile, const uint8_t* discard) {
  const FloatTag d;
  const size_t lanes = hn::Lanes(d);
  const auto in = [&](const float* from) HWY_ATTR {
    const Floats v = hn::LoadU(d, from);
    if constexpr (precision == Precision::Unorm8) return quantise<precision>(v);
    return precision == Precision::Unorm16 ? clamp_unit(v) : v;
  };
  const auto out_of = [](Floats v) HWY_ATTR {
    if constexpr (precision == Precision::Unorm8) return v;  // whole levels already
    return quantise<precision>(v);
  };
  for (size_t r = 0; r < queue.run_count; ++r) {
    const FragmentQueue::Run run = queue.runs[r];
    for (size_t k = 0; k < run.count; k += lanes) {
      const size_t from = run.first + k;
      float* to[4] = {tile.colour[0] + run.pixel + k, tile.colour[1] + run.pixel + k, tile.colour[2] + run.pixel + k,
                      tile.colour[3] + run.pixel + k};
      const Rgba source{in(queue.rgba[0] + from), in(queue.rgba[1] + from), in(queue.rgba[2] + from),
                        in(queue.rgba[3] + from)};
      const Rgba target{hn::LoadU(d, to[0]), hn::LoadU(d, to[1]), hn::LoadU(d, to[2]), hn::LoadU(d, to[3])};
      const Rgba result = blend_colours<precision, blend>(source, target);
      const Floats out[4] = {out_of(result.r), out_of(result.g), out_of(result.b), alpha ? out_of(result.a) : target.a};
      if (discard == nullptr && k + lanes <= run.count) {
        for (int c = 0; c < 4; ++c) hn::StoreU(out[c], d, to[c]);
      } else {
        const FloatMask mask = lanes_to_write(run.count - k, discard == nullptr ? nullptr : discard + from);
        for (int c = 0; c < 4; ++c) hn::BlendedStore(out[c], mask, d, to[c]);
      }
    }
  }
}

using BlendFunction = void (*)(FragmentQueue&, TileScratch&, const uint8_t*);

template <Precision precision, bool alpha>
BlendFunction blend_function_of(Blend blend) {
  switch (blend) {
    case Blend::Opaque:
      return blend_queue<precision, alpha, Blend::Opaque>;
    case Blend::Over:
      return blend_queue<precision, alpha, Blend::Over>;
    case Blend::Under:
      return blend_queue<precision, alpha, Blend::Under>;
    case Blend::Add:
      break;
  }
  return blend_queue<precision, alpha, Blend::Add>;
}

inline BlendFunction blend_function(Format format, Blend blend) {
  const bool alpha = cpu::has_alpha(format);
  switch (precision_of(format)) {
    case Precision::Unorm8:
      return alpha ? blend_function_of<Precision::Unorm8, true>(blend)
                   : blend_function_of<Precision::Unorm8, false>(blend);
    case Precision::Unorm16:
      return blend_function_of<Precision::Unorm16, false>(blend);
    case Precision::Half:
      return alpha ? blend_function_of<Precision::Half, true>(blend) : blend_function_of<Precision::Half, false>(blend);
    case Precision::Float:
      break;
  }
  return alpha ? blend_function_of<Precision::Float, true>(blend) : blend_function_of<Precision::Float, false>(blend);
}

}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#endif
