// Between the targets of a pass and the float planes of a tile, once at the start and once at the end of its work.
#pragma once

#include "backends/cpu/raster_types.h"

namespace volumark {

// Clears or loads. Channels that the format lacks read 0, alpha 1; clear values are rounded to the format.
void load_tile(const PassWork& work, int tile_x, int tile_y, TileScratch& scratch);
void store_tile(const PassWork& work, int tile_x, int tile_y, const TileScratch& scratch);

}  // namespace volumark
