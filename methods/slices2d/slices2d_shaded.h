// Shaded semi-transparent slices of 2D textures that hold gradients (Rezk-Salama, Engel, Bauer, Greiner and Ertl 2000,
// section 8): the two forms of the paper, and what the same textures can do in a program of today, which tends to the
// reference's picture. Slices are those of slices2d; so is a scene's picture that calls for no lighting.
#pragma once

#include "backends/cpu/cpu_program.h"
#include "methods/method.h"

namespace volumark {

const Method& slices2d_shaded();

// VM_FORM of slices2d_shaded.frag.
enum class ShadedForm : uint8_t { Full, Gradient, Separate };

extern const CpuProgram slices2d_shaded_twin;

}  // namespace volumark
