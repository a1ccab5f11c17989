// Rays on SIMD lanes, as in raycast.frag: set-up, empty-space skipping and the two marching loops. Lengths along a ray
// are in steps; positions are also kept in cells (box coordinates times the number of cells), as the sampler wants
// them.
#include "methods/volume/volume_twin-inl.h"

#if defined(VOLUMARK_RAYCAST_MARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMARK_RAYCAST_MARCH_INL_H_
#undef VOLUMARK_RAYCAST_MARCH_INL_H_
#else
#define VOLUMARK_RAYCAST_MARCH_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {

// The bindings of raycast.frag, and own[] of its uniform block by name.
struct RaycastBindings : VolumeBindings {
  explicit RaycastBindings(const CpuBindings& bindings) : VolumeBindings(bindings), distances(bindings.textures[4]) {}
  const CpuTexture& distances;
  float brick_count(size_t axis) const { return vm.own[0][axis]; }
  float early_termination() const { return vm.own[0][3]; }
  float bricks_per_cell() const { return vm.own[1][3]; }
  float opaque_lo() const { return vm.own[2][0]; }
  float opaque_hi() const { return vm.own[2][1]; }
};

// ---- Rays -----------------------------------------------------------------------------------------------------------

// The rays of a batch, by fragment: box coordinates where they enter and per step, and their length in steps (0: the
// ray misses the volume).
struct Rays {
  static constexpr size_t kCapacity = kMaxBatch + kBatchPadding;
  alignas(64) float entry[3][kCapacity];
  alignas(64) float stride[3][kCapacity];
  alignas(64) float steps[kCapacity];
};

template <bool clip_planes>
HWY_INLINE void set_up_rays(const VolumeUniforms& vm, Floats ndc_x, Floats ndc_y, size_t i, Rays& rays) {
  const Floats3 origin = ray_origin(vm, ndc_x, ndc_y), direction = ray_direction(vm, ndc_x, ndc_y);
  Floats z0 = splat(vm.depth[0]), z1 = splat(1e30F);
  clip_ray<clip_planes>(vm, origin, direction, z0, z1);
  const Floats step_z = hn::Div(splat(vm.depth[3]), ray_length(vm, direction));
  const auto meets = hn::Lt(z0, z1);
  const Floats begin = hn::IfThenElseZero(meets, z0);
  const Floats3 entry = along(origin, begin, direction), stride = scaled(direction, step_z);
  store(hn::IfThenElseZero(meets, hn::Div(hn::Sub(z1, z0), step_z)), rays.steps + i);
  store(entry.x, rays.entry[0] + i);
  store(entry.y, rays.entry[1] + i);
  store(entry.z, rays.entry[2] + i);
  store(stride.x, rays.stride[0] + i);
  store(stride.y, rays.stride[1] + i);
  store(stride.z, rays.stride[2] + i);
}

// A packet of rays: Walk of the GLSL.
struct Walk {
  Walk(const RaycastBindings& b, const Rays& rays, const int32_t* queue) {
    const Ints index = hn::Load(IntTag(), queue);
    const auto take = [&](const float* values) HWY_ATTR { return hn::GatherIndex(FloatTag(), values, index); };
    const Floats one = splat(1.F);
    entry = {take(rays.entry[0]), take(rays.entry[1]), take(rays.entry[2])};
    stride = {take(rays.stride[0]), take(rays.stride[1]), take(rays.stride[2])};
    steps = take(rays.steps);
    count = hn::Ceil(steps);
    const Floats extra = splat(defect(Defect::MiscountedCells) ? 2.F : 1.F);
    const Floats3 cells = splat3(b.vm.size) - Floats3{extra, extra, extra};
    cell_entry = entry * cells;
    cell_stride = stride * cells;
    brick_entry = scaled(cell_entry, splat(b.bricks_per_cell()));
    brick_stride = scaled(cell_stride, splat(b.bricks_per_cell()));
    // Along an axis that the ray does not move on, no face is ever reached.
    const auto inverse = [&](Floats v) HWY_ATTR {
      return hn::IfThenElse(hn::Lt(hn::Abs(v), splat(1e-18F)), splat(1e18F), hn::Div(one, v));
    };
    brick_inverse = {inverse(brick_stride.x), inverse(brick_stride.y), inverse(brick_stride.z)};
  }
  Floats3 entry, stride;
  Floats steps, count;
  Floats3 cell_entry, cell_stride;
  Floats3 brick_entry, brick_stride, brick_inverse;
};

// ---- Sampling -------------------------------------------------------------------------------------------------------

// Normalised values at positions in cells, inside the volume up to rounding.
template <Format format>
struct FastVolume {
  explicit FastVolume(const RaycastBindings& bindings) : vm(bindings.vm), view(volume_view(bindings.volume)) {}
  HWY_INLINE Floats operator()(const Floats3& cell) const {
    const FloatTag d;
    const IntTag di;
    const Ints x = hn::ConvertTo(di, cell.x), y = hn::ConvertTo(di, cell.y), z = hn::ConvertTo(di, cell.z);
    alignas(64) int32_t index[kMaxLanes];
    hn::Store(hn::Add(x, hn::Add(hn::Mul(y, hn::Set(di, view.row)), hn::Mul(z, hn::Set(di, view.slice)))), di, index);
    return normalised_value(
        vm, volume_fetch<format>(view, index, hn::Sub(cell.x, hn::ConvertTo(d, x)),
                                 hn::Sub(cell.y, hn::ConvertTo(d, y)), hn::Sub(cell.z, hn::ConvertTo(d, z))));
  }
  const VolumeUniforms& vm;
  VolumeView view;
};

struct AnyVolume {
  explicit AnyVolume(const RaycastBindings& bindings) : b(bindings) {}
  HWY_INLINE Floats operator()(const Floats3& cell) const {
    const auto coordinate = [](Floats c, int size) HWY_ATTR {
      return hn::Mul(hn::Add(c, splat(.5F)), splat(1.F / static_cast<float>(size)));
    };
    return sample_at(b, {coordinate(cell.x, b.volume.width), coordinate(cell.y, b.volume.height),
                         coordinate(cell.z, b.volume.depth)});
  }
  const RaycastBindings& b;
};

// ---- Empty space ----------------------------------------------------------------------------------------------------

// Around a position k steps along the ray: the cube of bricks that are all transparent, or the one occupied brick.
struct Cube {
  FloatMask empty;
  Floats until;  // where the ray leaves it, in steps
};

HWY_INLINE Cube cube_at(const RaycastBindings& b, const Walk& walk, Floats k) {
  const FloatTag d;
  const IntTag di;
  const Floats zero = hn::Zero(d), one = splat(1.F);
  const Floats3 at = along(walk.brick_entry, k, walk.brick_stride);
  const auto brick_of = [&](Floats position, size_t axis) HWY_ATTR {
    return hn::ConvertTo(di, hn::Min(hn::Max(position, zero), splat(b.brick_count(axis) - 1.F)));
  };
  const Ints x = brick_of(at.x, 0), y = brick_of(at.y, 1), z = brick_of(at.z, 2);
  const Ints offset = hn::Add(x, hn::Add(hn::Mul(y, hn::Set(di, static_cast<int32_t>(b.distances.row_stride))),
                                         hn::Mul(z, hn::Set(di, static_cast<int32_t>(b.distances.slice_stride)))));
  const Ints distance = hn::And(gather_words(b.distances.data, offset), hn::Set(di, 255));
  const Floats reach = hn::Max(hn::ConvertTo(d, distance), one);
  const auto leaves = [&](Ints brick, Floats entry, Floats stride, Floats inverse) HWY_ATTR {
    const Floats lower = hn::ConvertTo(d, brick);
    const Floats face =
        hn::IfThenElse(hn::Ge(stride, zero), hn::Add(lower, reach), hn::Sub(hn::Add(lower, one), reach));
    return hn::Mul(hn::Sub(face, entry), inverse);
  };
  const Floats until = hn::Min(leaves(x, walk.brick_entry.x, walk.brick_stride.x, walk.brick_inverse.x),
                               hn::Min(leaves(y, walk.brick_entry.y, walk.brick_stride.y, walk.brick_inverse.y),
                                       leaves(z, walk.brick_entry.z, walk.brick_stride.z, walk.brick_inverse.z)));
  return {hn::RebindMask(d, hn::Gt(distance, hn::Zero(di))), until};
}

// The middle of segment k; the end of the ray for lanes that are done.
HWY_INLINE Floats middle_of(const Walk& walk, Floats k) {
  const Floats half = splat(.5F);
  return hn::Min(hn::Min(hn::Add(k, half), hn::Mul(half, hn::Add(k, walk.steps))), walk.steps);
}

// Lanes come to the end of what they know at different times. A look-up serves all of them, so it waits until more than
// three quarters of the rays that still march want it; the others' samples carry those that wait along: what they take
// in transparent bricks adds nothing. (512 x 512 of two 128^3 peaks: a quarter to a third less time than looking up at
// once. Waiting for all is better still there, but worse where neighbouring rays see different bricks.)
HWY_INLINE bool look_up_waits(const Walk& walk, Floats k, FloatMask unknown) {
  const FloatTag d;
  return 4 * hn::CountTrue(d, unknown) <= 3 * hn::CountTrue(d, hn::Lt(k, walk.count));
}

// k becomes the first segment from k on whose middle does not lie in transparent bricks. Up to `inside` the ray is
// known to be in an occupied one.
HWY_INLINE void to_next_sample(const RaycastBindings& b, const Walk& walk, Floats& k, Floats& inside) {
  for (;;) {
    const Floats middle = middle_of(walk, k);
    const auto unknown = hn::And(hn::Lt(k, walk.count), hn::Ge(middle, inside));
    if (look_up_waits(walk, k, unknown)) return;
    const Cube cube = cube_at(b, walk, middle);
    const Floats next = hn::Max(hn::Add(k, splat(1.F)), hn::Ceil(hn::Sub(cube.until, splat(.5F))));
    k = hn::IfThenElse(hn::And(unknown, cube.empty), next, k);
    // Rounding may put the face before the sample: then the next one is looked up again.
    inside = hn::IfThenElse(hn::AndNot(cube.empty, unknown), hn::Max(cube.until, hn::Add(middle, splat(.25F))), inside);
  }
}

// Moves k on to the first segment that does not lie in transparent bricks as a whole. Segments that begin before
// `inside` are known not to.
HWY_INLINE void to_next_segment(const RaycastBindings& b, const Walk& walk, Floats& k, Floats& inside) {
  for (;;) {
    const auto unknown = hn::And(hn::Lt(k, walk.count), hn::Ge(k, inside));
    if (look_up_waits(walk, k, unknown)) return;
    const Cube cube = cube_at(b, walk, hn::Min(k, walk.steps));
    const Floats next = hn::IfThenElse(hn::Ge(cube.until, walk.steps), walk.count, hn::Floor(cube.until));
    const auto jumps = hn::And(cube.empty, hn::Gt(next, k));
    k = hn::IfThenElse(hn::And(unknown, jumps), next, k);
    // A segment that leaves the transparent bricks is taken, and the next one looked up again.
    const Floats until = hn::Max(hn::IfThenElse(cube.empty, k, cube.until), hn::Add(k, splat(.25F)));
    inside = hn::IfThenElse(hn::AndNot(jumps, unknown), until, inside);
  }
}

// ---- Marching -------------------------------------------------------------------------------------------------------

// Blends `segment` under what is there, in lanes where `seen` holds; lanes that became opaque enough end.
HWY_INLINE void blend_under(const RaycastBindings& b, const Walk& walk, const Rgba& segment, FloatMask seen, Rgba& sum,
                            Floats& k) {
  const Floats one = splat(1.F);
  const Floats rest = hn::IfThenElseZero(seen, hn::Sub(one, sum.a));
  sum.r = hn::MulAdd(rest, segment.r, sum.r);
  sum.g = hn::MulAdd(rest, segment.g, sum.g);
  sum.b = hn::MulAdd(rest, segment.b, sum.b);
  sum.a = hn::MulAdd(rest, segment.a, sum.a);
  const Floats left = defect(Defect::TerminatesOnOpacity) ? sum.a : hn::Sub(one, sum.a);
  k = hn::IfThenElse(hn::Lt(left, splat(b.early_termination())), walk.count, k);
}

template <bool lit, class Volume>
HWY_INLINE Rgba march_samples(const RaycastBindings& b, const Volume& volume, const Walk& walk) {
  const FloatTag d;
  const Floats zero = hn::Zero(d), one = splat(1.F);
  const Floats lo = splat(b.opaque_lo()), hi = splat(b.opaque_hi());
  Rgba sum{zero, zero, zero, zero};
  Floats k = zero;
  Floats inside = b.bricks_per_cell() > 0 ? zero : splat(1e30F);
  for (;; k = hn::Add(k, one)) {
    to_next_sample(b, walk, k, inside);
    const auto active = hn::Lt(k, walk.count);
    if (hn::AllFalse(d, active)) return sum;
    const Floats middle = middle_of(walk, k);
    const Floats s = volume(along(walk.cell_entry, middle, walk.cell_stride));
    const auto seen = hn::And(active, hn::And(hn::Gt(s, lo), hn::Lt(s, hi)));
    if (hn::AllFalse(d, seen)) continue;
    const Floats part =
        defect(Defect::UnclippedLastSegment) ? one : hn::Max(hn::Min(hn::Sub(walk.steps, k), one), zero);
    const Rgba segment = shade_segment<false, lit>(b, transfer(b, s), hn::Mul(part, splat(b.vm.depth[3])),
                                                   along(walk.entry, middle, walk.stride));
    blend_under(b, walk, segment, seen, sum, k);
  }
}

template <bool lit, class Volume>
HWY_INLINE Rgba march_segments(const RaycastBindings& b, const Volume& volume, const Walk& walk) {
  const FloatTag d;
  const Floats zero = hn::Zero(d), one = splat(1.F);
  const Floats lo = splat(b.opaque_lo()), hi = splat(b.opaque_hi());
  Rgba sum{zero, zero, zero, zero};
  Floats k = zero, known = splat(-1.F), back = zero;
  Floats inside = b.bricks_per_cell() > 0 ? zero : splat(1e30F);
  for (;; k = hn::Add(k, one)) {
    to_next_segment(b, walk, k, inside);
    const auto active = hn::Lt(k, walk.count);
    if (hn::AllFalse(d, active)) return sum;
    const auto sample = [&](Floats at) HWY_ATTR {
      return volume(along(walk.cell_entry, hn::Min(at, walk.steps), walk.cell_stride));
    };
    const auto fresh = hn::And(active, hn::Ne(known, k));
    Floats front = back;
    if (!hn::AllFalse(d, fresh)) front = hn::IfThenElse(fresh, sample(k), front);
    known = hn::Add(k, one);
    back = sample(known);
    const auto seen = hn::And(active, hn::And(hn::Gt(hn::Max(front, back), lo), hn::Lt(hn::Min(front, back), hi)));
    if (hn::AllFalse(d, seen)) continue;
    const Floats part = hn::Max(hn::Min(hn::Sub(walk.steps, k), one), zero);
    const Rgba segment =
        shade_preintegrated<false, lit>(b, transfer_segment(b, front, back), hn::Mul(part, splat(b.vm.depth[3])),
                                        along(walk.entry, middle_of(walk, k), walk.stride));
    blend_under(b, walk, segment, seen, sum, k);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#endif
