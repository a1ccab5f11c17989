// Isosurfaces by object-aligned slices of 2D textures and the alpha test, lit in the program: rezksalama2000 section 7.
// Gradient and value share a texel. Opaque: no blending. Of order 1 in the distance of slices where the surface is met
// at a slice.
#pragma once

#include "backends/cpu/cpu_program.h"
#include "methods/method.h"

namespace volumark {

const Method& slices2d_iso();

extern const CpuProgram slices2d_iso_twin;

}  // namespace volumark
