#include "backends/gl/gl_formats.h"

namespace volumark {

GlFormat gl_format(Format format) {
  switch (format) {
    case Format::R8:
      return {GL_R8, GL_RED, GL_UNSIGNED_BYTE};
    case Format::R16:
      return {GL_R16, GL_RED, GL_UNSIGNED_SHORT};
    case Format::R16F:
      return {GL_R16F, GL_RED, GL_HALF_FLOAT};
    case Format::R32F:
      return {GL_R32F, GL_RED, GL_FLOAT};
    case Format::RG8:
      return {GL_RG8, GL_RG, GL_UNSIGNED_BYTE};
    case Format::RGBA8:
      return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};
    case Format::RGBA16F:
      return {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT};
    case Format::RGBA32F:
      return {GL_RGBA32F, GL_RGBA, GL_FLOAT};
    case Format::D32FS8:
      return {GL_DEPTH32F_STENCIL8, GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV};
  }
  return {GL_NONE, GL_NONE, GL_NONE};
}

GLenum gl_texture_target(int dimension) {
  return dimension == 1 ? GL_TEXTURE_1D : dimension == 2 ? GL_TEXTURE_2D : GL_TEXTURE_3D;
}

GLenum gl_filter(Filter filter) { return filter == Filter::Nearest ? GL_NEAREST : GL_LINEAR; }

GLenum gl_wrap(Wrap wrap) {
  switch (wrap) {
    case Wrap::Clamp:
      return GL_CLAMP_TO_EDGE;
    case Wrap::Border:
      return GL_CLAMP_TO_BORDER;
    case Wrap::Repeat:
      return GL_REPEAT;
  }
  return GL_NONE;
}

GLenum gl_topology(Topology topology) {
  switch (topology) {
    case Topology::Points:
      return GL_POINTS;
    case Topology::Lines:
      return GL_LINES;
    case Topology::Triangles:
      return GL_TRIANGLES;
    case Topology::TriangleStrip:
      return GL_TRIANGLE_STRIP;
  }
  return GL_NONE;
}

GLenum gl_compare(Compare compare) {
  switch (compare) {
    case Compare::Never:
      return GL_NEVER;
    case Compare::Less:
      return GL_LESS;
    case Compare::Equal:
      return GL_EQUAL;
    case Compare::LessEqual:
      return GL_LEQUAL;
    case Compare::Greater:
      return GL_GREATER;
    case Compare::NotEqual:
      return GL_NOTEQUAL;
    case Compare::GreaterEqual:
      return GL_GEQUAL;
    case Compare::Always:
      return GL_ALWAYS;
  }
  return GL_NONE;
}

GLenum gl_stencil_op(StencilOp op) {
  switch (op) {
    case StencilOp::Keep:
      return GL_KEEP;
    case StencilOp::Zero:
      return GL_ZERO;
    case StencilOp::Replace:
      return GL_REPLACE;
    case StencilOp::IncrementClamp:
      return GL_INCR;
    case StencilOp::DecrementClamp:
      return GL_DECR;
    case StencilOp::Invert:
      return GL_INVERT;
    case StencilOp::IncrementWrap:
      return GL_INCR_WRAP;
    case StencilOp::DecrementWrap:
      return GL_DECR_WRAP;
  }
  return GL_NONE;
}

GlBlend gl_blend(Blend blend) {
  switch (blend) {
    case Blend::Opaque:
      return {false, GL_ONE, GL_ZERO};
    case Blend::Over:
      return {true, GL_ONE, GL_ONE_MINUS_SRC_ALPHA};
    case Blend::Under:
      return {true, GL_ONE_MINUS_DST_ALPHA, GL_ONE};
    case Blend::Add:
      return {true, GL_ONE, GL_ONE};
  }
  return {false, GL_ONE, GL_ZERO};
}

}  // namespace volumark
