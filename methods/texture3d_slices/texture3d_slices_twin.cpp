// The CPU twin of texture3d_slices.vert and .frag, in three phases over a batch of fragments (coordinates, fetch,
// transfer function): one after the other over the whole batch they run faster than fused.
#include "methods/texture3d_slices/texture3d_slices.h"

// After the headers without Highway.
#include "backends/cpu/highway_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "methods/texture3d_slices/texture3d_slices_twin.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "methods/volume/volume_twin-inl.h"

// After the sampler it is made of.
#include "methods/volume/volume_fetch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {
namespace {

// What main() of the fragment program computes of the geometry.
struct alignas(64) Segments {
  Positions middle, front, back;  // box coordinates; front and back for pre-integration only
  float length[kMaxBatch + kBatchPadding];
};

void vertex(const CpuBindings&, VertexBatch& batch) {
  for (size_t i = 0; i < batch.count; ++i) {
    const float* ndc = attribute_of(batch, 0, i);
    const float position[4] = {ndc[0], ndc[1], .5F, 1.F};
    std::copy_n(position, 4, batch.position + 4 * i);
    batch.varyings[batch.varying_stride * i] = *attribute_of(batch, 1, i);
  }
}

// ---- Phase 1: coordinates ----
// What a slab's segments are cut to: VM_CLIP_SLABS, and VM_CLIP_PLANES where it is on.
enum Slab { kWhole, kInBox, kInBoxAndPlanes };

// Whether the rays are inside of the volume over the whole slab: then there is nothing to clip, which is the rule.
template <Slab slab>
HWY_INLINE FloatMask inside(const VolumeUniforms& vm, const Floats3& box, const Floats3& direction, Floats reach) {
  const Floats half = splat(.5F);
  const auto within = [&](Floats p, Floats d)
                          HWY_ATTR { return hn::Le(hn::MulAdd(hn::Abs(d), reach, hn::Abs(hn::Sub(p, half))), half); };
  FloatMask in = hn::And(within(box.x, direction.x), within(box.y, direction.y));
  if (!defect(Defect::MissingFace)) in = hn::And(in, within(box.z, direction.z));
  if constexpr (slab == kInBoxAndPlanes) {
    for (int i = 0; i < static_cast<int>(vm.counts[1]); ++i) {
      const Floats3 normal = splat3(vm.clip_planes[i]);
      const Floats nearest = hn::NegMulAdd(hn::Abs(dot(normal, direction)), reach, dot(normal, box));
      in = hn::And(in, hn::Ge(nearest, splat(vm.clip_planes[i][3])));
    }
  }
  return in;
}

template <Slab slab, bool both_ends>
HWY_NOINLINE void locate(const VolumeUniforms& vm, const FragmentBatch& batch, Segments& out) {
  const Floats reach = splat(.5F * vm.depth[3]);
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const Floats x = load(batch.x + i), y = load(batch.y + i);
    const Floats3 direction = ray_direction(vm, x, y);
    const Floats3 box = along(ray_origin(vm, x, y), load(batch.varyings[0] + i), direction);
    Floats z0 = hn::Neg(reach), z1 = reach;
    if (slab != kWhole && !hn::AllTrue(FloatTag(), inside<slab>(vm, box, direction, reach))) {
      clip_ray<slab == kInBoxAndPlanes>(vm, box, direction, z0, z1);
      const auto hits = hn::Lt(z0, z1);
      z0 = hn::IfThenElseZero(hits, z0);
      z1 = hn::IfThenElseZero(hits, z1);
    }
    out.middle.put(i, along(box, hn::Mul(splat(.5F), hn::Add(z0, z1)), direction));
    if constexpr (both_ends) {
      out.front.put(i, along(box, z0, direction));
      out.back.put(i, along(box, z1, direction));
    }
    store(hn::Mul(hn::Sub(z1, z0), ray_length(vm, direction)), out.length + i);
  });
}

// ---- Phase 2: fetch, of volume_fetch-inl.h ----
// ---- Phase 3: transfer function ----
template <bool linear_opacity, bool lit>
HWY_NOINLINE void shade_post(const VolumeBindings& b, const Segments& s, const float* values, FragmentBatch& batch) {
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const Rgba point = transfer(b, load(values + i));
    store_rgba(batch, i, shade_segment<linear_opacity, lit>(b, point, load(s.length + i), s.middle.get(i)));
  });
}

template <bool linear_opacity>
HWY_NOINLINE void shade_pre(const VolumeBindings& b, const Segments& s, FragmentBatch& batch) {
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const Rgba voxel = sample_classified(b, s.middle.get(i));
    store_rgba(batch, i, shade_classified<linear_opacity>(b, voxel, load(s.length + i)));
  });
}

template <bool linear_opacity, bool lit>
HWY_NOINLINE void shade_segments(const VolumeBindings& b, const Segments& s, const float* front, const float* back,
                                 FragmentBatch& batch) {
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    const Rgba mean = transfer_segment(b, load(front + i), load(back + i));
    store_rgba(batch, i, shade_preintegrated<linear_opacity, lit>(b, mean, load(s.length + i), s.middle.get(i)));
  });
}

enum Classify { kPost, kPre, kPreintegrated };  // VM_CLASSIFICATION

template <Classify classification, bool linear_opacity, bool lit, Slab slab>
void fragment(const CpuBindings& bindings, FragmentBatch& batch) {
  const VolumeBindings b(bindings);
  Segments segments;
  locate<slab, classification == kPreintegrated>(b.vm, batch, segments);
  alignas(64) float values[2][kMaxBatch + kBatchPadding];
  if constexpr (classification == kPost) {
    fetch(b, segments.middle, batch.count, values[0]);
    shade_post<linear_opacity, lit>(b, segments, values[0], batch);
  } else if constexpr (classification == kPre) {
    shade_pre<linear_opacity>(b, segments, batch);
  } else {
    fetch(b, segments.front, batch.count, values[0]);
    fetch(b, segments.back, batch.count, values[1]);
    shade_segments<linear_opacity, lit>(b, segments, values[0], values[1], batch);
  }
}

template <Classify classification, bool linear_opacity, bool lit>
CpuFragmentKernel with_slabs(Slab slab) {
  switch (slab) {
    case kWhole:
      return fragment<classification, linear_opacity, lit, kWhole>;
    case kInBox:
      return fragment<classification, linear_opacity, lit, kInBox>;
    default:
      return fragment<classification, linear_opacity, lit, kInBoxAndPlanes>;
  }
}
template <bool linear_opacity>
CpuFragmentKernel with_classification(int classification, bool lit, Slab slab) {
  switch (classification) {
    case kPost:
      return lit ? with_slabs<kPost, linear_opacity, true>(slab) : with_slabs<kPost, linear_opacity, false>(slab);
    case kPre:
      return with_slabs<kPre, linear_opacity, false>(slab);
    default:
      return lit ? with_slabs<kPreintegrated, linear_opacity, true>(slab)
                 : with_slabs<kPreintegrated, linear_opacity, false>(slab);
  }
}

// Constants in the order of their ids: volume_common.glsl, then VM_CLIP_SLABS.
CpuKernels specialise(std::span<const int32_t> constants) {
  const int classification = constants[0];
  const bool linear_opacity = constants[1] != 0, lit = constants[2] > 0;
  const Slab slab = constants[6] == 0 ? kWhole : constants[5] > 0 ? kInBoxAndPlanes : kInBox;
  CpuKernels kernels;
  kernels.vertex = vertex;
  kernels.fragment = linear_opacity ? with_classification<true>(classification, lit, slab)
                                    : with_classification<false>(classification, lit, slab);
  kernels.varyings = 1;
  return kernels;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumark {
HWY_EXPORT(specialise);
const CpuProgram texture3d_slices_twin{
    "texture3d_slices", [](std::span<const int32_t> constants) { return HWY_DYNAMIC_DISPATCH(specialise)(constants); }};
}  // namespace volumark
#endif
