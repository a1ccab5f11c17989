// The volume drawn by object-aligned slices of 2D textures (Rezk-Salama, Engel, Bauer, Greiner and Ertl 2000, sections
// 4 to 6): the stack that suits the view, intermediate slices by blending two stored ones, one to four slices a
// polygon. Each slice stands for the stretch of every pixel's ray between its slab's planes, clipped to the box: order
// 2 in the distance of the slices.
#pragma once

#include "backends/cpu/cpu_program.h"
#include "methods/method.h"
#include "methods/volume/volume_parameters.h"

namespace volumark {

const Method& slices2d();

// What SliceDrawing needs to draw scalars (Post) or associated colours (Pre) without lighting.
ProgramDesc slices2d_program(const Scene& scene, Classification classification, bool linear_opacity);

extern const CpuProgram slices2d_twin;

}  // namespace volumark
