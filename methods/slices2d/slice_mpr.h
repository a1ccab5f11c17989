// Multi-planar reformatting from 2D textures: the scene's slice plane, cut into strips between neighbouring stored
// slices, which the program interpolates (rezksalama2000, section 9). One opaque polygon; the camera is any.
#pragma once

#include "backends/cpu/cpu_program.h"
#include "methods/method.h"

namespace volumark {

const Method& slice_mpr();

extern const CpuProgram slice_mpr_twin;

}  // namespace volumark
