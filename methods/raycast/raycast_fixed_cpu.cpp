// Twin of raycast_fixed.frag (and raycast.vert): every lane marches along its own ray.
#include "methods/raycast/fixed_raycast.h"
#include "methods/volume/fixed_point.h"

// After the headers without Highway.
#include "backends/cpu/highway_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "methods/raycast/raycast_fixed_cpu.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "methods/volume/fixed_point-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {
namespace {

void vertex(const CpuBindings&, VertexBatch& batch) {
  for (size_t i = 0; i < batch.count; ++i) {
    const uint32_t index = batch.vertex_index[i];
    const float position[4] = {index == 1 ? 3.F : -1.F, index == 2 ? 3.F : -1.F, 0, 1};
    std::copy_n(position, 4, batch.position + 4 * i);
  }
}

HWY_INLINE Floats inverse_length(const Axes& v) {
  const FloatTag d;
  const IntTag di;
  const Floats q = hn::Add(hn::Add(hn::Mul(v.x, v.x), hn::Mul(v.y, v.y)), hn::Mul(v.z, v.z));
  const Floats half_q = hn::Mul(splat(.5F), q);
  Floats r = hn::BitCast(d, hn::Sub(whole(0x5f375a86), hn::ShiftRight<1>(hn::BitCast(di, q))));
  for (int i = 0; i < 4; ++i) r = hn::Mul(r, hn::Sub(splat(1.5F), hn::Mul(hn::Mul(half_q, r), r)));
  return r;
}

// The bindings of raycast_fixed.frag.
struct RayBindings : FixedBindings {
  explicit RayBindings(const CpuBindings& bindings) : FixedBindings(bindings), distances(bindings.textures[3]) {}
  const CpuTexture& distances;
};

// The samples of a ray that may lie inside: [first, end).
struct Reach {
  Ints first, end;
};
HWY_INLINE Reach reach_of(const FixedUniforms& fx, const Axes& origin, const Axes& direction, Floats step_z) {
  Floats z0 = splat(-1e30F), z1 = splat(1e30F);
  const auto axis = [&](Floats o, Floats v, float limit) HWY_ATTR {
    const Floats tiny = splat(1e-20F), half = splat(limit / 512);
    const Floats d = hn::IfThenElse(hn::Lt(hn::Abs(v), tiny), tiny, v);
    const Floats middle = hn::Div(hn::Sub(half, o), d), reach = hn::Abs(hn::Div(hn::Add(half, splat(.05F)), d));
    z0 = hn::Max(z0, hn::Sub(middle, reach));
    z1 = hn::Min(z1, hn::Add(middle, reach));
  };
  axis(origin.x, direction.x, fx.limit[0]);
  axis(origin.y, direction.y, fx.limit[1]);
  axis(origin.z, direction.z, fx.limit[2]);
  const auto sample = [&](Floats z, float more) HWY_ATTR {
    const Floats k = hn::Add(hn::Div(hn::Sub(z, splat(fx.depth[0])), step_z), splat(more));
    return truncate(hn::Min(hn::Max(k, splat(0.F)), splat(fx.limit[3])));
  };
  return {sample(z0, -2), sample(z1, 2)};
}

HWY_INLINE void blend_under(const Ints4& s, Ints4& sum) {
  const Ints rest = hn::Sub(whole(255), sum.a);
  sum.r = clamped(hn::Add(sum.r, product(s.r, rest)));
  sum.g = clamped(hn::Add(sum.g, product(s.g, rest)));
  sum.b = clamped(hn::Add(sum.b, product(s.b, rest)));
  sum.a = clamped(hn::Add(sum.a, product(s.a, rest)));
}

// How many samples from the one at t on are certainly transparent; 0 in an occupied brick.
HWY_INLINE Ints empty_samples(const RayBindings& b, const Ints3& t, Floats z, const Axes& origin, const Axes& direction,
                              Floats step_z) {
  const FloatTag d;
  const int shift = static_cast<int>(b.fx.bricks[3]);
  const auto brick_of = [&](Ints v, float last) HWY_ATTR {
    return hn::Min(hn::Max(hn::ShiftRightSame(v, 8 + shift), whole(0)), whole(last));
  };
  const Ints3 brick{brick_of(t.x, b.fx.bricks[0]), brick_of(t.y, b.fx.bricks[1]), brick_of(t.z, b.fx.bricks[2])};
  const Ints rows = hn::Mul(brick.y, whole(static_cast<int32_t>(b.distances.row_stride)));
  const Ints slices = hn::Mul(brick.z, whole(static_cast<int32_t>(b.distances.slice_stride)));
  const Ints offset = hn::Add(brick.x, hn::Add(rows, slices));
  const Ints reach = hn::And(gather_words(b.distances.data, offset), whole(255));
  const auto until = [&](Ints at, Floats o, Floats v) HWY_ATTR {
    const Floats tiny = splat(1e-20F), margin = splat(.02F);
    const Floats along = hn::IfThenElse(hn::Lt(hn::Abs(v), tiny), tiny, v);
    const FloatMask forward = hn::Ge(along, splat(0.F));
    const Ints far = hn::ShiftLeftSame(hn::Add(at, reach), shift);
    const Ints near = hn::ShiftLeftSame(hn::Sub(hn::Add(at, whole(1)), reach), shift);
    const Floats face =
        hn::IfThenElse(forward, hn::Sub(hn::ConvertTo(d, far), margin), hn::Add(hn::ConvertTo(d, near), margin));
    return hn::Div(hn::Sub(face, o), along);
  };
  const Floats leaves = hn::Min(until(brick.x, origin.x, direction.x),
                                hn::Min(until(brick.y, origin.y, direction.y), until(brick.z, origin.z, direction.z)));
  const Floats steps = hn::Min(hn::Max(hn::Div(hn::Sub(leaves, z), step_z), splat(1.F)), splat(65536.F));
  return hn::IfThenElseZero(hn::Gt(reach, whole(0)), truncate(steps));
}

template <FixedTexel kind, bool skips>
HWY_INLINE Ints4 march(const RayBindings& b, Floats x, Floats y) {
  const FloatTag d;
  const IntTag di;
  const FixedUniforms& fx = b.fx;
  const Axes origin = window_origin(fx, x, y), direction = window_direction(fx, x, y);
  const Axes world{hn::Mul(direction.x, splat(fx.metric[0])), hn::Mul(direction.y, splat(fx.metric[1])),
                   hn::Mul(direction.z, splat(fx.metric[2]))};
  const Floats step_z = fx.depth[2] > 0 ? hn::Mul(splat(fx.depth[1]), inverse_length(world)) : splat(fx.depth[1]);
  const Reach reach = reach_of(fx, origin, direction, step_z);
  Ints4 sum = nothing();
  Ints k = reach.first, end = reach.end;
  for (;;) {
    const IntMask active = hn::Lt(k, end);
    if (hn::AllFalse(di, active)) return sum;
    const Floats z = depth_of(fx, hn::ConvertTo(d, k), step_z);
    const Ints3 t = position_of(origin, direction, z);
    if constexpr (skips) {
      const Ints skipped = empty_samples(b, t, z, origin, direction, step_z);
      const IntMask wanted = hn::And(active, hn::Eq(skipped, whole(0)));
      k = hn::Add(k, hn::Max(skipped, whole(1)));
      if (hn::AllFalse(di, wanted)) continue;
      blend_under(fixed_sample<kind>(b, t, wanted), sum);
    } else {
      k = hn::Add(k, whole(1));
      blend_under(fixed_sample<kind>(b, t, active), sum);
    }
    const Floats rest = hn::ConvertTo(d, hn::Sub(whole(255), sum.a));
    end = hn::IfThenElse(hn::RebindMask(di, hn::Lt(rest, splat(fx.lighting[3]))), whole(0), end);
  }
}

template <FixedTexel kind, bool skips>
void fragment(const CpuBindings& bindings, FragmentBatch& batch) {
  const RayBindings b(bindings);
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    store_levels(batch, i, march<kind, skips>(b, load(batch.x + i), load(batch.y + i)));
  });
}

template <bool skips>
CpuFragmentKernel fragment_of(FixedTexel kind) {
  switch (kind) {
    case FixedTexel::Value:
      return fragment<FixedTexel::Value, skips>;
    case FixedTexel::Lit:
      return fragment<FixedTexel::Lit, skips>;
    case FixedTexel::Classified:
      break;
  }
  return fragment<FixedTexel::Classified, false>;  // no values that bricks could be made of
}

// Constants in the order of their ids: fixed_point.glsl, then VM_SKIP_EMPTY.
CpuKernels specialise(std::span<const int32_t> constants) {
  const FixedTexel kind = fixed_texel(constants);
  CpuKernels kernels;
  kernels.vertex = vertex;
  kernels.fragment = constants[5] != 0 ? fragment_of<true>(kind) : fragment_of<false>(kind);
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
const CpuProgram raycast_fixed_cpu{
    "raycast_fixed", [](std::span<const int32_t> constants) { return HWY_DYNAMIC_DISPATCH(specialise)(constants); }};
}  // namespace volumark
#endif
