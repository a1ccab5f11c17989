// Ray casting under the effect fixed_point: a program of its own, so that raycast without it knows nothing of it. The
// colour target is RGBA8.
#pragma once

#include <memory>

#include "backends/cpu/cpu_program.h"
#include "methods/method.h"
#include "methods/volume/fixed_point.h"

namespace volumark {

extern const CpuProgram raycast_fixed_cpu;

// `early_termination`: a ray ends where less than this part of what lies behind passes it.
std::unique_ptr<PreparedMethod> prepare_fixed_raycast(const Scene& scene, const FixedSettings& settings,
                                                      double early_termination, Device& device);

}  // namespace volumark
