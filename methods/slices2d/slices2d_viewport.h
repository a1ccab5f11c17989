// Slices perpendicular to the view through stacks of 2D textures: each slice is cut into strips between neighbouring
// stored slices, which the program interpolates (rezksalama2000, section 9). The samples are those of texture3d_slices.
#pragma once

#include "backends/cpu/cpu_program.h"
#include "methods/method.h"

namespace volumark {

const Method& slices2d_viewport();

extern const CpuProgram slices2d_viewport_twin;

}  // namespace volumark
