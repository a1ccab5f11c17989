// Volumetric textures on triangle meshes by slices across the view (lensch2002): the same sections of prisms and
// planes, with the work split between host and programs in three ways. All three draw the same polygons as the same
// triangles.
#pragma once

#include "methods/method.h"

namespace volumark {

const Method& shell_software();  // section 4
const Method& shell_hybrid();    // section 5
const Method& shell_hardware();  // section 6

}  // namespace volumark
