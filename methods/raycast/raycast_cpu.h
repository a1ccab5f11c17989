// The CPU twin of raycast.vert and raycast.frag.
#pragma once

#include "backends/cpu/cpu_program.h"

namespace volumark {

extern const CpuProgram raycast_cpu;

}  // namespace volumark
