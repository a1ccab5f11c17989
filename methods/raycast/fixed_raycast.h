// Ray casting under the effect fixed_point: a program of its own, so that raycast without it knows nothing of it. The
// colour target is RGBA8.
#pragma once

#include <memory>

#include "backends/cpu/cpu_program.h"
#include "methods/method.h"
#include "methods/volume/fixed_point.h"

namespace volumark {

extern const CpuProgram raycast_fixed_cpu;

struct FixedRaySettings {
  double early_termination = 0;  // a ray ends where less than this part of what lies behind passes it
  int brick_size = 0;            // texels, rounded down to a power of two; 0: nothing is skipped
};
std::unique_ptr<PreparedMethod> prepare_fixed_raycast(const Scene& scene, const FixedSettings& settings,
                                                      const FixedRaySettings& rays, Device& device);

}  // namespace volumark
