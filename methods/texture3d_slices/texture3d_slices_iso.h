// Isosurfaces by slices of a 3D texture and the alpha test: Westermann and Ertl 1998, as rezksalama2000 section 7
// compares with. Opaque: no blending. Of order 1 in the step where the surface is met at a slice.
#pragma once

#include "backends/cpu/cpu_program.h"
#include "methods/method.h"

namespace volumark {

const Method& texture3d_slices_iso();

extern const CpuProgram texture3d_slices_iso_twin;

}  // namespace volumark
