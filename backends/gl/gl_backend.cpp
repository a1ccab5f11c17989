// The gl backend: OpenGL 4.5 core, drawing to textures. Deferred by the driver only: every call goes straight to GL,
// with redundant state left out (gl_state.h).
#include "backends/backend.h"
#include "backends/gl/gl_caches.h"
#include "backends/gl/gl_context.h"
#include "backends/gl/gl_error.h"
#include "backends/gl/gl_formats.h"
#include "backends/gl/gl_info.h"
#include "backends/gl/gl_program.h"
#include "backends/gl/gl_state.h"
#include "backends/gl/gl_texture.h"
#include "backends/gl/gl_zones.h"

namespace volumark {

namespace {

struct GlBuffer {
  GLuint name = 0;
  uint64_t serial = 0;  // never used twice, unlike a name
};

struct GlProgram {
  GlProgram(const GlFunctions& functions, GLuint program) : gl(functions), name(program) {}
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;
  ~GlProgram() { gl.DeleteProgram(name); }
  const GlFunctions& gl;
  GLuint name;
  bool writes_memory = false;  // has storage buffers or images
};

struct GlPipeline {
  std::shared_ptr<GlProgram> program;  // outlives its handle where a pipeline uses it
  GLuint vertex_array = 0;
  GLenum topology = GL_TRIANGLES;
  GlFixedState fixed;
  std::vector<GLsizei> strides;
  std::vector<uint64_t> bound_vertex_buffers;  // serials; the vertex array remembers its bindings
  uint64_t bound_index_buffer = 0;
};

// Objects by the small integers that Device gives.
template <class T>
T& slot(std::vector<T>& objects, uint32_t id) {
  if (id >= objects.size()) objects.resize(id + 1);
  return objects[id];
}

class GlBackend final : public Backend {
 public:
  explicit GlBackend(std::unique_ptr<GlContext> context);
  ~GlBackend() override;

  const BackendInfo& info() const override { return info_; }
  void create_buffer(uint32_t id, const BufferDesc& desc) override;
  void create_texture(uint32_t id, const TextureDesc& desc) override;
  void create_program(uint32_t id, const ProgramDesc& desc) override;
  void create_pipeline(uint32_t id, uint32_t program, const PipelineDesc& desc,
                       const ProgramDesc& program_desc) override;
  void destroy_buffer(uint32_t id) override;
  void destroy_texture(uint32_t id) override;
  void destroy_program(uint32_t id) override;
  void destroy_pipeline(uint32_t id) override;
  void update_buffer(uint32_t id, size_t offset, std::span<const std::byte> data) override;
  void begin_pass(const ResolvedPass& pass) override;
  void draw(const ResolvedDraw& draw) override;
  void end_pass() override;
  void dispatch(uint32_t program, std::span<const BoundResource> bindings, std::array<uint32_t, 3> groups) override;
  void begin_zone(const std::string& name) override;
  void end_zone() override;
  std::vector<ZoneTime> submit_and_wait() override;
  void read_texture(uint32_t id, std::span<std::byte> out) override;
  void read_buffer(uint32_t id, size_t offset, std::span<std::byte> out) override;

 private:
  void bind(std::span<const BoundResource> bindings);
  void bind_geometry(GlPipeline& pipeline, const ResolvedDraw& draw);

  std::unique_ptr<GlContext> context_;
  const GlFunctions gl_;
  BackendInfo info_;
  GlErrors errors_;
  GlState state_;
  GlCaches caches_;
  GlZones zones_;
  uint64_t last_serial_ = 0;
  std::vector<GlBuffer> buffers_;
  std::vector<GlTexture> textures_;
  std::vector<std::shared_ptr<GlProgram>> programs_;
  std::vector<GlPipeline> pipelines_;
  std::array<GLuint, 3> max_groups_{};
  bool pass_writes_memory_ = false;
};

GlFunctions load_current(GlContext& context) {
  context.make_current();
  return load_gl_functions(context);
}

GlBackend::GlBackend(std::unique_ptr<GlContext> context)
    : context_(std::move(context)),
      gl_(load_current(*context_)),
      info_(query_gl_info(gl_, *context_)),
      errors_(gl_),
      state_(gl_),
      caches_(gl_),
      zones_(gl_, !info_.software) {
  state_.initialise();
  for (GLuint axis = 0; axis < 3; ++axis) {
    GLint most = 0;
    gl_.GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, axis, &most);
    max_groups_[axis] = static_cast<GLuint>(most);
  }
  errors_.throw_pending("make_device", "gl");
}

GlBackend::~GlBackend() {
  // The context takes all objects with it; only programs would call GL in their own destructors, after it.
  try {
    context_->make_current();
    gl_.Finish();
  } catch (const DeviceError&) {
    // Current in another thread: no context is current here now, so the deletes below do nothing.
  }
  pipelines_.clear();
  programs_.clear();
}

// ---- Objects --------------------------------------------------------------------------------------------------------

void GlBackend::create_buffer(uint32_t id, const BufferDesc& desc) {
  context_->make_current();
  if (info_.software) require_host_memory(desc.size, "create_buffer", desc.label);
  errors_.keep_pending();
  GLuint name = 0;
  gl_.CreateBuffers(1, &name);
  const void* data = desc.data.empty() ? nullptr : desc.data.data();
  gl_.NamedBufferStorage(name, static_cast<GLsizeiptr>(desc.size), data, GL_DYNAMIC_STORAGE_BIT);
  GLenum error = errors_.take();
  if (error == GL_NO_ERROR && !data) {
    gl_.ClearNamedBufferData(name, GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, nullptr);
    error = errors_.take();
  }
  if (error != GL_NO_ERROR) {
    gl_.DeleteBuffers(1, &name);
    throw DeviceError(DeviceErrorKind::OutOfMemory, "create_buffer", desc.label,
                      std::string(gl_error_name(error)) + " for " + std::to_string(desc.size) + " bytes");
  }
  slot(buffers_, id) = {name, ++last_serial_};
  zones_.note_work();
}

void GlBackend::create_texture(uint32_t id, const TextureDesc& desc) {
  context_->make_current();
  const size_t texels =
      static_cast<size_t>(desc.width) * static_cast<size_t>(desc.height) * static_cast<size_t>(desc.depth);
  if (info_.software) require_host_memory(texels * texel_bytes(desc.format), "create_texture", desc.label);
  GlTexture texture = make_texture(gl_, errors_, desc);
  texture.serial = ++last_serial_;
  slot(textures_, id) = texture;
  zones_.note_work();
}

void GlBackend::create_program(uint32_t id, const ProgramDesc& desc) {
  context_->make_current();
  auto program = std::make_shared<GlProgram>(gl_, link_program(gl_, desc));
  for (const BindingDecl& binding : desc.bindings) {
    if (binding.kind == BindingKind::Storage || binding.kind == BindingKind::Image) program->writes_memory = true;
  }
  slot(programs_, id) = std::move(program);
}

void GlBackend::create_pipeline(uint32_t id, uint32_t program, const PipelineDesc& desc,
                                const ProgramDesc& program_desc) {
  context_->make_current();
  errors_.keep_pending();
  GlPipeline p;
  p.program = programs_[program];
  p.topology = gl_topology(desc.topology);
  p.fixed = fixed_state(desc, program_desc);
  gl_.CreateVertexArrays(1, &p.vertex_array);
  for (GLuint b = 0; b < desc.vertex_layouts.size(); ++b) {
    const VertexLayout& layout = desc.vertex_layouts[b];
    p.strides.push_back(static_cast<GLsizei>(layout.stride));
    gl_.VertexArrayBindingDivisor(p.vertex_array, b, layout.per_instance ? 1 : 0);
    for (const VertexAttribute& a : layout.attributes) {
      gl_.EnableVertexArrayAttrib(p.vertex_array, a.location);
      gl_.VertexArrayAttribFormat(p.vertex_array, a.location, a.components, GL_FLOAT, GL_FALSE, a.offset);
      gl_.VertexArrayAttribBinding(p.vertex_array, a.location, b);
    }
  }
  p.bound_vertex_buffers.assign(p.strides.size(), 0);
  if (const GLenum error = errors_.take(); error != GL_NO_ERROR) {
    gl_.DeleteVertexArrays(1, &p.vertex_array);
    const auto kind = error == GL_OUT_OF_MEMORY ? DeviceErrorKind::OutOfMemory : DeviceErrorKind::LimitExceeded;
    throw DeviceError(kind, "create_pipeline", desc.label,
                      std::string("the driver refuses the vertex layout: ") + gl_error_name(error));
  }
  slot(pipelines_, id) = std::move(p);
}

void GlBackend::destroy_buffer(uint32_t id) {
  context_->make_current();
  gl_.DeleteBuffers(1, &buffers_[id].name);
  buffers_[id] = {};
}

void GlBackend::destroy_texture(uint32_t id) {
  context_->make_current();
  if (caches_.forget_texture(textures_[id].serial)) state_.forget_framebuffer();
  gl_.DeleteTextures(1, &textures_[id].name);
  textures_[id] = {};
}

void GlBackend::destroy_program(uint32_t id) {
  context_->make_current();
  state_.use_program(0);  // its name may be given again
  programs_[id].reset();
}

void GlBackend::destroy_pipeline(uint32_t id) {
  context_->make_current();
  state_.use_program(0);
  state_.bind_vertex_array(0);
  gl_.DeleteVertexArrays(1, &pipelines_[id].vertex_array);
  pipelines_[id] = {};
}

// ---- Work -----------------------------------------------------------------------------------------------------------

void GlBackend::update_buffer(uint32_t id, size_t offset, std::span<const std::byte> data) {
  context_->make_current();
  gl_.NamedBufferSubData(buffers_[id].name, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(data.size()),
                         data.data());
  zones_.note_work();
}

void GlBackend::begin_pass(const ResolvedPass& pass) {
  context_->make_current();
  const GlTexture* depth_stencil = pass.has_depth_stencil ? &textures_[pass.depth_stencil] : nullptr;
  const GLuint name = caches_.framebuffer(textures_[pass.colour], depth_stencil, pass.desc->label);
  state_.bind_framebuffer(name, pass.width, pass.height);
  pass_writes_memory_ = false;
  const bool clear_depth_stencil = depth_stencil && pass.desc->clear_depth_stencil;
  if (!pass.desc->clear_colour && !clear_depth_stencil) return;
  state_.open_write_masks();
  if (pass.desc->clear_colour) gl_.ClearNamedFramebufferfv(name, GL_COLOR, 0, pass.desc->colour_value.data());
  if (clear_depth_stencil) {
    gl_.ClearNamedFramebufferfi(name, GL_DEPTH_STENCIL, 0, pass.desc->depth_value, pass.desc->stencil_value);
  }
  zones_.note_work();
}

void GlBackend::bind(std::span<const BoundResource> bindings) {
  for (const BoundResource& b : bindings) {
    switch (b.kind) {
      case BindingKind::Uniform: {
        const GlBuffer& buffer = buffers_[b.object];
        state_.uniform_buffer(b.slot, buffer.serial, buffer.name, b.offset, b.size);
        break;
      }
      case BindingKind::Storage: {
        const GlBuffer& buffer = buffers_[b.object];
        state_.storage_buffer(b.slot, buffer.serial, buffer.name, b.offset, b.size);
        break;
      }
      case BindingKind::Sampled: {
        const GlTexture& texture = textures_[b.object];
        state_.sampled(b.slot, texture.serial, texture.name, caches_.sampler(b.sampler));
        break;
      }
      case BindingKind::Image: {
        const GlTexture& texture = textures_[b.object];
        state_.image(b.slot, texture.serial, texture.name, texture.dimension == 3, gl_format(texture.format).internal);
        break;
      }
    }
  }
}

void GlBackend::bind_geometry(GlPipeline& pipeline, const ResolvedDraw& draw) {
  state_.bind_vertex_array(pipeline.vertex_array);
  for (GLuint i = 0; i < pipeline.strides.size(); ++i) {
    const GlBuffer& buffer = buffers_[draw.vertex_buffers[i]];
    if (pipeline.bound_vertex_buffers[i] == buffer.serial) continue;
    gl_.BindVertexBuffer(i, buffer.name, 0, pipeline.strides[i]);
    pipeline.bound_vertex_buffers[i] = buffer.serial;
  }
  if (!draw.indexed) return;
  const GlBuffer& indices = buffers_[draw.index_buffer];
  if (pipeline.bound_index_buffer == indices.serial) return;
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.name);
  pipeline.bound_index_buffer = indices.serial;
}

void GlBackend::draw(const ResolvedDraw& draw) {
  context_->make_current();
  GlPipeline& pipeline = pipelines_[draw.pipeline];
  state_.use_program(pipeline.program->name);
  state_.apply(pipeline.fixed);
  bind(draw.bindings);
  bind_geometry(pipeline, draw);
  const auto count = static_cast<GLsizei>(draw.count), instances = static_cast<GLsizei>(draw.instances);
  if (draw.indexed) {
    const uintptr_t offset = uintptr_t{draw.first} * sizeof(uint32_t);
    gl_.DrawElementsInstanced(pipeline.topology, count, GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset),
                              instances);
  } else {
    gl_.DrawArraysInstanced(pipeline.topology, static_cast<GLint>(draw.first), count, instances);
  }
  pass_writes_memory_ |= pipeline.program->writes_memory;
  zones_.note_work();
}

void GlBackend::end_pass() {
  context_->make_current();
  // What is drawn is seen by all that follows without a barrier; what programs store is not.
  if (pass_writes_memory_) gl_.MemoryBarrier(GL_ALL_BARRIER_BITS);
}

void GlBackend::dispatch(uint32_t program, std::span<const BoundResource> bindings, std::array<uint32_t, 3> groups) {
  context_->make_current();
  for (size_t axis = 0; axis < 3; ++axis) {
    if (groups[axis] > max_groups_[axis]) {
      throw DeviceError(DeviceErrorKind::LimitExceeded, "dispatch", "",
                        std::to_string(groups[axis]) + " groups on axis " + std::to_string(axis) +
                            ", the driver takes " + std::to_string(max_groups_[axis]));
    }
  }
  state_.use_program(programs_[program]->name);
  bind(bindings);
  gl_.DispatchCompute(groups[0], groups[1], groups[2]);
  gl_.MemoryBarrier(GL_ALL_BARRIER_BITS);
  zones_.note_work();
}

void GlBackend::begin_zone(const std::string& name) {
  context_->make_current();
  zones_.begin(name);
}

void GlBackend::end_zone() {
  context_->make_current();
  zones_.end();
}

std::vector<ZoneTime> GlBackend::submit_and_wait() {
  context_->make_current();
  zones_.finish();
  std::vector<ZoneTime> zones = zones_.take();
  errors_.throw_pending("submit_and_wait", "");
  return zones;
}

void GlBackend::read_texture(uint32_t id, std::span<std::byte> out) {
  context_->make_current();
  read_texels(gl_, textures_[id], out);
  errors_.throw_pending("read_texture", "");
}

void GlBackend::read_buffer(uint32_t id, size_t offset, std::span<std::byte> out) {
  context_->make_current();
  gl_.GetNamedBufferSubData(buffers_[id].name, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(out.size()),
                            out.data());
  errors_.throw_pending("read_buffer", "");
}

}  // namespace

std::unique_ptr<Backend> make_gl_backend(const DeviceOptions& options) {
  set_driver_environment();
  if (options.gl_platform == "osmesa") return std::make_unique<GlBackend>(make_osmesa_context());
  if (options.gl_platform == "egl") return std::make_unique<GlBackend>(make_egl_context());
  throw DeviceError(DeviceErrorKind::BadArgument, "make_device", "gl",
                    "unknown gl platform '" + options.gl_platform + "' (osmesa or egl)");
}

}  // namespace volumark
