// Slices under the effect fixed_point: programs and geometry of their own, so that slices without it know nothing of
// it. The colour target is RGBA8.
#pragma once

#include <memory>

#include "backends/cpu/cpu_program.h"
#include "methods/method.h"
#include "methods/volume/fixed_point.h"

namespace volumark {

extern const CpuProgram texture3d_slices_fixed_cpu;

std::unique_ptr<PreparedMethod> prepare_fixed_slices(const Scene& scene, const FixedSettings& settings,
                                                     bool front_to_back, Device& device);

}  // namespace volumark
