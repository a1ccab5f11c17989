// Parameters of the methods whose textures hold gradients (gradient_texels.h).
#pragma once

#include "methods/parameters.h"

namespace volumark::gradient_parameters {

inline const Choice kNormals{
    "normals",
    "normalised: of the interpolated gradient, at the pixel; interpolated: those of the voxels, "
    "as the boards of 2000 had it, which are shorter between voxels that differ",
    {"normalised", "interpolated"},
    "normalised",
    Ideal<const char*>{"normalised", "normals"}};

}  // namespace volumark::gradient_parameters
