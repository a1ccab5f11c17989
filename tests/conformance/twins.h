// CPU twins of the conformance programs, by the GLSL they stand for.
#pragma once

#include "backends/cpu/cpu_program.h"

namespace volumark::conformance {

extern const CpuProgram kFlat;       // flat.vert + flat.frag
extern const CpuProgram kWindow;     // flat.vert + window.frag
extern const CpuProgram kInstanced;  // instanced.vert + flat.frag
extern const CpuProgram kSpecial;    // flat.vert + special.frag
extern const CpuProgram kSample[3];  // flat.vert + sample1d/2d/3d.frag
extern const CpuProgram kScale;      // scale.comp
extern const CpuProgram kPaint;      // paint.comp

}  // namespace volumark::conformance
