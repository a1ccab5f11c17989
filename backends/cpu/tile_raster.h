// Draws one tile of a pass from beginning to end: load, all its triangles in drawing order, store. Tiles are
// independent of each other, so any number of threads gives the same bits.
#pragma once

#include "backends/cpu/raster_types.h"

namespace volumark {

void raster_tile(const PassWork& work, int tile_x, int tile_y, TileScratch& scratch);

// Whether the processor has one of the instruction sets the backend is built for.
bool simd_supported();

// Vector width of the instruction set that was chosen, and its name.
int chosen_simd_bits();
const char* chosen_simd_name();

}  // namespace volumark
