// The parameters of methods that cast rays, and what they all have to say about them.
#pragma once

#include <optional>
#include <string>

#include "methods/method.h"
#include "methods/parameters.h"

namespace volumark {

namespace ray_parameters {

inline const Number kStep{
    {"step",
     "voxels",
     "length of a segment, in smallest spacings; the last segment of a ray ends where the ray leaves",
     0.5,
     1.0 / 64,
     64,
     {4, 2, 1, 0.5, 0.25, 0.125},
     Ideal<double>{0.125, "step"}}};
inline const Choice kSkipEmpty{
    "skip_empty",
    "bricks: jump over bricks of voxels whose range of values is transparent; the picture is the "
    "same",
    {"none", "bricks"},
    "bricks"};
inline const Integer kBrickSize{{"brick_size", "cells", "edge of a brick", 4, 2, 64}};

inline bool skips(const Values& values) { return kSkipEmpty(values) == "bricks"; }

}  // namespace ray_parameters

// Half the spacing of the values that the volume texture can hold, where that is coarser than the data; data units.
double texture_rounding(const Volume& volume, const std::string& format);

// Why `backend` cannot cast rays of so many segments; nothing where it can.
std::optional<std::string> too_many_segments(const Scene& scene, const Values& values, const BackendInfo& backend);

}  // namespace volumark
