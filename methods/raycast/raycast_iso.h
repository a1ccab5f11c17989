// The isosurface by one ray a pixel, as a user would draw it today: what isosurfaces by slices are compared with. On
// the cpu backend the twin marches rays on SIMD lanes.
#pragma once

#include "backends/cpu/cpu_program.h"
#include "methods/method.h"

namespace volumark {

inline constexpr int kBisections = 6;  // of refine=bisection

const Method& raycast_iso();

extern const CpuProgram raycast_iso_cpu;  // the twin of raycast.vert and raycast_iso.frag

}  // namespace volumark
