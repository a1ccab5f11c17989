// Slices of a 3D texture, perpendicular to the view, blended in order: Cabral, Cam and Foran 1994, as in westermann1998
// section 2. Order 2 in the step when each slab is clipped to the volume, order 1 with the papers' plain slices.
#pragma once

#include "backends/cpu/cpu_program.h"
#include "methods/method.h"

namespace volumark {

const Method& texture3d_slices();

extern const CpuProgram texture3d_slices_twin;

}  // namespace volumark
