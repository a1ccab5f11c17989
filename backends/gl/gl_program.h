// From a ProgramDesc to a linked GL program.
#pragma once

#include <string>

#include "backends/gl/gl_functions.h"
#include "backends/types.h"

namespace volumark {

// The stage's text with `const int NAME = VALUE;` after its #version line for every constant that the stage declares
// with VM_SPEC. (Not for the others: the name may mean something else there.) Line numbers stay those of the text.
std::string specialise_glsl(const ShaderText& stage, const std::vector<SpecConstant>& constants);

// Throws DeviceError CompileFailed with the driver's log, naming the stage. The context must be current.
GLuint link_program(const GlFunctions& gl, const ProgramDesc& desc);

}  // namespace volumark
