// The painters behind scenes/procedural_textures.h, one a kind. Internal to scenes/.
#pragma once

#include <cstdint>

#include "scenes/texture_canvas.h"

namespace volumark {

void paint_egg_torus(TextureCanvas& canvas, uint32_t seed);

}  // namespace volumark
