// The CPU twin of filter_levels.vert and filter_levels.frag.
#pragma once

#include "backends/cpu/cpu_program.h"

namespace volumark {

extern const CpuProgram filter_levels_cpu;

}  // namespace volumark
