// slices2d under the effect fixed_point: 8-bit stacks and palettes, programs and uniforms of their own, so that slices
// without it know nothing of it. The colour target is RGBA8.
#pragma once

#include <memory>

#include "backends/cpu/cpu_program.h"
#include "methods/method.h"
#include "methods/slices2d/slice_drawing.h"
#include "methods/volume/fixed_point.h"

namespace volumark {

// The block of slices2d_fixed.frag (std140, binding 3), where the fields are explained.
struct FixedSliceUniforms {
  Float4 slices{}, tiles{};
};

// Into the frame of the stack of `axis`.
FixedUniforms turned(const FixedUniforms& uniforms, int axis);

// Thickness of a slab, world units: what the opacities of a stack's palette are those of.
double slab_thickness(const Volume& volume, int axis, int64_t percent);

extern const CpuProgram slices2d_fixed_twin;

// classification Post or Pre.
std::unique_ptr<PreparedMethod> prepare_fixed_slices2d(const Scene& scene, const SliceSettings& settings,
                                                       Classification classification, bool linear_opacity,
                                                       Device& device);

}  // namespace volumark
