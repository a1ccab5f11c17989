// The CPU twins of the programs that draw sections of prisms. Constants as in shell_planes.glsl and
// shell_hardware.vert.
#pragma once

#include "backends/cpu/cpu_program.h"

namespace volumark {

extern const CpuProgram shell_software_twin;
extern const CpuProgram shell_hybrid_twin;
extern const CpuProgram shell_hardware_twin;

}  // namespace volumark
