// The Device's enumerations in GL's words.
#pragma once

#include "backends/gl/gl_functions.h"
#include "backends/types.h"

namespace volumark {

struct GlFormat {
  GLenum internal;      // sized
  GLenum format, type;  // of texels as uploaded and read back
};
GlFormat gl_format(Format format);
GLenum gl_texture_target(int dimension);
GLenum gl_filter(Filter filter);
GLenum gl_wrap(Wrap wrap);
GLenum gl_topology(Topology topology);
GLenum gl_compare(Compare compare);
GLenum gl_stencil_op(StencilOp op);

struct GlBlend {
  bool enabled;
  GLenum source, destination;
};
GlBlend gl_blend(Blend blend);

}  // namespace volumark
