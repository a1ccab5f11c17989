#include "backends/gl/gl_state.h"

#include <string_view>

namespace volumark {

namespace {

bool same_face(const StencilFace& a, const StencilFace& b) {
  return a.compare == b.compare && a.fail == b.fail && a.depth_fail == b.depth_fail && a.pass == b.pass;
}

bool sets_point_size(const ProgramDesc& program) {
  for (const ShaderText* stage : program.stages) {
    if (stage->glsl && std::string_view(stage->glsl).find("gl_PointSize") != std::string_view::npos) return true;
  }
  return false;
}

}  // namespace

GlFixedState fixed_state(const PipelineDesc& desc, const ProgramDesc& program) {
  GlFixedState s;
  s.blend = gl_blend(desc.blend);
  s.colour_write = desc.colour_write;
  s.depth_test = desc.depth_test;
  s.depth_write = desc.depth_write;
  s.depth_compare = gl_compare(desc.depth_compare);
  s.stencil_test = desc.stencil_test;
  s.stencil = {desc.stencil_front, desc.stencil_back};
  s.stencil_read_mask = desc.stencil_read_mask;
  s.stencil_write_mask = desc.stencil_write_mask;
  s.stencil_reference = desc.stencil_reference;
  s.cull = desc.cull;
  s.point_size = sets_point_size(program);
  return s;
}

void GlState::initialise() {
  gl_.ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
  gl_.FrontFace(GL_CCW);
  gl_.ProvokingVertex(GL_FIRST_VERTEX_CONVENTION);  // as in Vulkan
  gl_.Disable(GL_DITHER);
  gl_.Disable(GL_MULTISAMPLE);
  gl_.ClampColor(GL_CLAMP_READ_COLOR, GL_FALSE);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  // The cache starts from GL's initial state, which is what GlFixedState's initialisers say, except for these.
  fixed_.blend = gl_blend(Blend::Opaque);
  gl_.StencilMask(0xff);
  for (const GLenum face : {GL_FRONT, GL_BACK}) gl_.StencilFuncSeparate(face, GL_ALWAYS, 0, 0xff);
}

void GlState::use_program(GLuint program) {
  if (program == program_) return;
  gl_.UseProgram(program);
  program_ = program;
}

void GlState::bind_vertex_array(GLuint vertex_array) {
  if (vertex_array == vertex_array_) return;
  gl_.BindVertexArray(vertex_array);
  vertex_array_ = vertex_array;
}

void GlState::bind_framebuffer(GLuint framebuffer, int width, int height) {
  if (framebuffer != framebuffer_) gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  framebuffer_ = framebuffer;
  if (width == width_ && height == height_) return;
  gl_.Viewport(0, 0, width, height);
  width_ = width;
  height_ = height;
}

void GlState::apply(const GlFixedState& w) {
  GlFixedState& c = fixed_;
  if (w.blend.enabled != c.blend.enabled) {
    enable(GL_BLEND, w.blend.enabled);
    c.blend.enabled = w.blend.enabled;
  }
  if (w.blend.source != c.blend.source || w.blend.destination != c.blend.destination) {
    gl_.BlendFunc(w.blend.source, w.blend.destination);
    c.blend = w.blend;
  }
  if (w.colour_write != c.colour_write) {
    const GLboolean on = w.colour_write ? GL_TRUE : GL_FALSE;
    gl_.ColorMask(on, on, on, on);
    c.colour_write = w.colour_write;
  }
  if (w.depth_test != c.depth_test) {
    enable(GL_DEPTH_TEST, w.depth_test);
    c.depth_test = w.depth_test;
  }
  if (w.depth_write != c.depth_write) {
    gl_.DepthMask(w.depth_write ? GL_TRUE : GL_FALSE);
    c.depth_write = w.depth_write;
  }
  if (w.depth_compare != c.depth_compare) {
    gl_.DepthFunc(w.depth_compare);
    c.depth_compare = w.depth_compare;
  }
  if (w.cull != c.cull) {
    enable(GL_CULL_FACE, w.cull != Cull::None);
    if (w.cull != Cull::None) gl_.CullFace(w.cull == Cull::Front ? GL_FRONT : GL_BACK);
    c.cull = w.cull;
  }
  if (w.point_size != c.point_size) {
    enable(GL_PROGRAM_POINT_SIZE, w.point_size);
    c.point_size = w.point_size;
  }
  apply_stencil(w);
}

void GlState::apply_stencil(const GlFixedState& w) {
  GlFixedState& c = fixed_;
  if (w.stencil_test != c.stencil_test) {
    enable(GL_STENCIL_TEST, w.stencil_test);
    c.stencil_test = w.stencil_test;
  }
  if (!w.stencil_test) return;
  const bool same_test = w.stencil_read_mask == c.stencil_read_mask && w.stencil_reference == c.stencil_reference;
  for (size_t i = 0; i < 2; ++i) {
    const StencilFace& face = w.stencil[i];
    const GLenum side = i == 0 ? GL_FRONT : GL_BACK;
    if (same_test && same_face(face, c.stencil[i])) continue;
    gl_.StencilFuncSeparate(side, gl_compare(face.compare), w.stencil_reference, w.stencil_read_mask);
    gl_.StencilOpSeparate(side, gl_stencil_op(face.fail), gl_stencil_op(face.depth_fail), gl_stencil_op(face.pass));
  }
  if (w.stencil_write_mask != c.stencil_write_mask) gl_.StencilMask(w.stencil_write_mask);
  c.stencil = w.stencil;
  c.stencil_read_mask = w.stencil_read_mask;
  c.stencil_reference = w.stencil_reference;
  c.stencil_write_mask = w.stencil_write_mask;
}

void GlState::open_write_masks() {
  if (!fixed_.colour_write) gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  if (!fixed_.depth_write) gl_.DepthMask(GL_TRUE);
  if (fixed_.stencil_write_mask != 0xff) gl_.StencilMask(0xff);
  fixed_.colour_write = true;
  fixed_.depth_write = true;
  fixed_.stencil_write_mask = 0xff;
}

void GlState::range(GLenum target, Range& cached, GLuint slot, const Range& wanted, GLuint name) {
  if (wanted == cached) return;
  gl_.BindBufferRange(target, slot, name, static_cast<GLintptr>(wanted.offset), static_cast<GLsizeiptr>(wanted.size));
  cached = wanted;
}

void GlState::uniform_buffer(GLuint slot, uint64_t serial, GLuint name, size_t offset, size_t size) {
  range(GL_UNIFORM_BUFFER, uniforms_[slot], slot, {serial, offset, size}, name);
}

void GlState::storage_buffer(GLuint slot, uint64_t serial, GLuint name, size_t offset, size_t size) {
  range(GL_SHADER_STORAGE_BUFFER, storages_[slot], slot, {serial, offset, size}, name);
}

void GlState::sampled(GLuint slot, uint64_t serial, GLuint texture, GLuint sampler) {
  if (textures_[slot] != serial) gl_.BindTextureUnit(slot, texture);
  if (samplers_[slot] != sampler) gl_.BindSampler(slot, sampler);
  textures_[slot] = serial;
  samplers_[slot] = sampler;
}

void GlState::image(GLuint slot, uint64_t serial, GLuint texture, bool layered, GLenum internal_format) {
  if (images_[slot] == serial) return;
  gl_.BindImageTexture(slot, texture, 0, layered ? GL_TRUE : GL_FALSE, 0, GL_READ_WRITE, internal_format);
  images_[slot] = serial;
}

}  // namespace volumark
