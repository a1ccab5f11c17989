// Maximum intensity projection: the example of CONTRIBUTING.md's checklist "add a method". It shows the largest value
// of the transfer window along each ray as grey, opaque where the ray meets the volume, and takes no other effect than
// clip planes.
#pragma once

#include "backends/cpu/cpu_program.h"
#include "methods/method.h"

namespace volumark {

const Method& toy_mip();

extern const CpuProgram toy_mip_cpu;  // the twin of toy_mip.vert and toy_mip.frag

}  // namespace volumark
