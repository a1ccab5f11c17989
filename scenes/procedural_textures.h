// Textures of shells given by a formula, seeded: the same specification gives the same texels everywhere. All repeat
// along u and v; w = 0 is the surface of the mesh. The subjects are those of the figures of lensch2002.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "scenes/shell.h"

namespace volumark {

struct TextureSpec {
  const char* kind = "egg_torus";  // one of texture_kinds()
  glm::ivec3 size{128};            // each 1..1024
  uint32_t seed = 1;
  double extinction = 100;  // of an opaque texel, 1 / world unit
};

// The names, and in brackets the thickness, in widths of a repeat, at which round things are round:
//   egg_torus (.7): an opaque ring that carries a semi-transparent egg, Figure 8
//   outdoor (.5): trees, flowers and floor, opaque; ground fog and smoke, semi-transparent, Figure 7
//   chain (.5): two links along u, opaque, Figure 9
//   volcano (.9): floor and mountain, opaque; rings of smoke, semi-transparent, Figure 11
//   car_park (.42): cars, trees and ground, opaque, Figure 12
//   fur (.6): hairs that thin out upwards, over a skin
std::span<const char* const> texture_kinds();

// Throws std::invalid_argument for an unknown kind or a size out of range.
ShellTexture make_texture(const TextureSpec& spec);

}  // namespace volumark
