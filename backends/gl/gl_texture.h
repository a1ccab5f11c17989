// Textures: storage, upload and read-back, in slabs so that no call goes past GL's 2 GiB sizes.
#pragma once

#include <cstdint>

#include "backends/gl/gl_error.h"
#include "backends/gl/gl_formats.h"

namespace volumark {

struct GlTexture {
  GLuint name = 0;
  uint64_t serial = 0;  // never used twice, unlike a name
  int dimension = 2, width = 1, height = 1, depth = 1;
  Format format = Format::RGBA32F;
};

// Throws DeviceError OutOfMemory where the driver refuses; leaves nothing behind then. `serial` is left 0.
GlTexture make_texture(const GlFunctions& gl, GlErrors& errors, const TextureDesc& desc);

// `out` holds the whole texture, tight.
void read_texels(const GlFunctions& gl, const GlTexture& texture, std::span<std::byte> out);

}  // namespace volumark
