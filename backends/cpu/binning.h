// Sorts the triangles of a pass into tiles (counting sort); within a tile the drawing order is kept.
#pragma once

#include "backends/cpu/raster_types.h"

namespace volumark {

// Runs in the calling task arena.
void bin_triangles(PassWork& work);

}  // namespace volumark
