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

// egg_torus: an opaque ring that carries a semi-transparent egg (Figure 8).
std::span<const char* const> texture_kinds();

// Throws std::invalid_argument for an unknown kind or a size out of range.
ShellTexture make_texture(const TextureSpec& spec);

}  // namespace volumark
