// Parameters of the methods that draw object-aligned slices as polygons (slice_drawing.h).
#pragma once

#include "methods/slices2d/slice_drawing.h"
#include "methods/slices2d/stack_parameters.h"

namespace volumark::stack_parameters {

inline const Integer kSlices{{"slices",
                              "percent",
                              "slices to draw for each 100 stored ones; those between are interpolated",
                              100,
                              1,
                              12800,
                              {100, 200, 400, 800},
                              Ideal<int64_t>{800, "step"}}};

inline const Choice kTexturesPerPolygon{
    "textures_per_polygon", "slices on one polygon, combined in the program before one blend", {"1", "2", "4"}, "1"};

inline const Choice kTextureCoordinates{
    "texture_coordinates",
    "with several slices on a polygon; corrected: each is seen where it lies; uncorrected: all where the first one "
    "lies",
    {"corrected", "uncorrected"},
    "corrected",
    Ideal<const char*>{"corrected", "texture coordinates"}};

inline const Flag kSlantCorrection{
    "slant_correction",
    "on: the opacity of a slice is that of each ray's path through its slab; off: of the slab's thickness, as where "
    "opacities are fixed for a stack and rays that meet it aslant find it too thin",
    true, Ideal<bool>{true, "slant of the rays"}};

inline const Flag kInterpolation{
    "interpolation", "on: slices between two stored ones are blended from them; off: the nearest stored one", true,
    Ideal<bool>{true, "interpolation of slices"}};

}  // namespace volumark::stack_parameters
