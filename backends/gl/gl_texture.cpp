#include "backends/gl/gl_texture.h"

#include <algorithm>
#include <cstring>

namespace volumark {

namespace {

struct Slab {
  int y, z, height, depth;
  size_t offset, bytes;
};

// Cuts along the last axis, at most 256 MiB a piece.
template <class F>
void for_each_slab(const GlTexture& t, F&& function) {
  constexpr size_t kPiece = size_t{256} << 20;
  const size_t row = static_cast<size_t>(t.width) * texel_bytes(t.format);
  const size_t layer = t.dimension == 3 ? row * static_cast<size_t>(t.height) : row;
  const int layers = t.dimension == 3 ? t.depth : t.height;
  const int step = static_cast<int>(std::clamp<size_t>(kPiece / layer, 1, static_cast<size_t>(layers)));
  for (int at = 0; at < layers; at += step) {
    const int count = std::min(step, layers - at);
    const size_t offset = layer * static_cast<size_t>(at), bytes = layer * static_cast<size_t>(count);
    function(t.dimension == 3 ? Slab{0, at, t.height, count, offset, bytes} : Slab{at, 0, count, 1, offset, bytes});
  }
}

// Asks without allocating. The driver answers a width of 0 where it could not hold the texture.
bool driver_would_take(const GlFunctions& gl, const GlTexture& t) {
  const GlFormat f = gl_format(t.format);
  const GLint internal = static_cast<GLint>(f.internal);
  GLint width = 0;
  GLenum proxy = GL_PROXY_TEXTURE_2D;
  if (t.dimension == 1) {
    proxy = GL_PROXY_TEXTURE_1D;
    gl.TexImage1D(proxy, 0, internal, t.width, 0, f.format, f.type, nullptr);
  } else if (t.dimension == 2) {
    gl.TexImage2D(proxy, 0, internal, t.width, t.height, 0, f.format, f.type, nullptr);
  } else {
    proxy = GL_PROXY_TEXTURE_3D;
    gl.TexImage3D(proxy, 0, internal, t.width, t.height, t.depth, 0, f.format, f.type, nullptr);
  }
  gl.GetTexLevelParameteriv(proxy, 0, GL_TEXTURE_WIDTH, &width);
  return width != 0;
}

void allocate(const GlFunctions& gl, const GlTexture& t) {
  const GLenum internal = gl_format(t.format).internal;
  if (t.dimension == 1) {
    gl.TextureStorage1D(t.name, 1, internal, t.width);
  } else if (t.dimension == 2) {
    gl.TextureStorage2D(t.name, 1, internal, t.width, t.height);
  } else {
    gl.TextureStorage3D(t.name, 1, internal, t.width, t.height, t.depth);
  }
}

void upload(const GlFunctions& gl, const GlTexture& t, std::span<const std::byte> data) {
  const GlFormat f = gl_format(t.format);
  for_each_slab(t, [&](const Slab& s) {
    const std::byte* from = data.data() + s.offset;
    if (t.dimension == 1) {
      gl.TextureSubImage1D(t.name, 0, 0, t.width, f.format, f.type, from);
    } else if (t.dimension == 2) {
      gl.TextureSubImage2D(t.name, 0, 0, s.y, t.width, s.height, f.format, f.type, from);
    } else {
      gl.TextureSubImage3D(t.name, 0, 0, 0, s.z, t.width, s.height, s.depth, f.format, f.type, from);
    }
  });
}

std::string extent_text(const GlTexture& t) {
  return std::to_string(t.width) + "x" + std::to_string(t.height) + "x" + std::to_string(t.depth) + " " +
         to_string(t.format);
}

}  // namespace

GlTexture make_texture(const GlFunctions& gl, GlErrors& errors, const TextureDesc& desc) {
  GlTexture t{0, 0, desc.dimension, desc.width, desc.height, desc.depth, desc.format};
  errors.keep_pending();
  if (!driver_would_take(gl, t)) {
    errors.take();
    throw DeviceError(DeviceErrorKind::OutOfMemory, "create_texture", desc.label,
                      "the driver cannot hold a texture of " + extent_text(t));
  }
  gl.CreateTextures(gl_texture_target(t.dimension), 1, &t.name);
  allocate(gl, t);
  const GlFormat f = gl_format(t.format);
  GLenum error = errors.take();
  if (error == GL_NO_ERROR) {
    if (desc.data.empty()) {
      gl.ClearTexImage(t.name, 0, f.format, f.type, nullptr);
    } else {
      upload(gl, t, desc.data);
    }
    error = errors.take();
  }
  if (error != GL_NO_ERROR) {
    gl.DeleteTextures(1, &t.name);
    throw DeviceError(DeviceErrorKind::OutOfMemory, "create_texture", desc.label,
                      std::string(gl_error_name(error)) + " for a texture of " + extent_text(t));
  }
  return t;
}

void read_texels(const GlFunctions& gl, const GlTexture& t, std::span<std::byte> out) {
  const GlFormat f = gl_format(t.format);
  for_each_slab(t, [&](const Slab& s) {
    gl.GetTextureSubImage(t.name, 0, 0, s.y, s.z, t.width, s.height, s.depth, f.format, f.type,
                          static_cast<GLsizei>(s.bytes), out.data() + s.offset);
  });
  if (t.format != Format::D32FS8) return;
  // GL leaves the 24 bits beside the stencil value undefined.
  for (size_t at = 4; at + 4 <= out.size(); at += 8) {
    uint32_t word = 0;
    std::memcpy(&word, out.data() + at, 4);
    word &= 0xffu;
    std::memcpy(out.data() + at, &word, 4);
  }
}

}  // namespace volumark
