// The context's state as last set, so that a draw only tells the driver what has changed. Objects are told apart by
// serials, not by GL names: a name is given again after its object is deleted.
#pragma once

#include <array>
#include <cstdint>

#include "backends/gl/gl_formats.h"

namespace volumark {

// What a Pipeline sets, apart from its program and vertex array, in GL's words.
struct GlFixedState {
  GlBlend blend{};
  bool colour_write = true;
  bool depth_test = false, depth_write = true;
  GLenum depth_compare = GL_LESS;
  bool stencil_test = false;
  std::array<StencilFace, 2> stencil{};  // front, back
  GLuint stencil_read_mask = 0xff, stencil_write_mask = 0xff;
  GLint stencil_reference = 0;
  Cull cull = Cull::None;
  bool point_size = false;  // the program sets gl_PointSize
};
GlFixedState fixed_state(const PipelineDesc& desc, const ProgramDesc& program);

class GlState {
 public:
  explicit GlState(const GlFunctions& gl) : gl_(gl) {}

  // Everything that no call changes afterwards, and the cached state in its initial form. Once, context current.
  void initialise();

  void use_program(GLuint program);
  void bind_vertex_array(GLuint vertex_array);
  void bind_framebuffer(GLuint framebuffer, int width, int height);
  void apply(const GlFixedState& wanted);
  // Clears ignore none of the write masks.
  void open_write_masks();

  void uniform_buffer(GLuint slot, uint64_t serial, GLuint name, size_t offset, size_t size);
  void storage_buffer(GLuint slot, uint64_t serial, GLuint name, size_t offset, size_t size);
  void sampled(GLuint slot, uint64_t serial, GLuint texture, GLuint sampler);
  void image(GLuint slot, uint64_t serial, GLuint texture, bool layered, GLenum internal_format);

  void forget_framebuffer() { framebuffer_ = 0; }

 private:
  static constexpr size_t kSlots = 16;
  struct Range {
    uint64_t serial = 0;
    size_t offset = 0, size = 0;
    friend bool operator==(const Range&, const Range&) = default;
  };
  void range(GLenum target, Range& cached, GLuint slot, const Range& wanted, GLuint name);
  void enable(GLenum what, bool on) { on ? gl_.Enable(what) : gl_.Disable(what); }
  void apply_stencil(const GlFixedState& wanted);

  const GlFunctions& gl_;
  GlFixedState fixed_;
  GLuint program_ = 0, vertex_array_ = 0, framebuffer_ = 0;
  int width_ = -1, height_ = -1;
  std::array<Range, kSlots> uniforms_{}, storages_{};
  std::array<uint64_t, kSlots> textures_{}, images_{};
  std::array<GLuint, kSlots> samplers_{};
};

}  // namespace volumark
