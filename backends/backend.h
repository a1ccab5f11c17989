// What a backend implements. Device has checked every argument before a call gets here; a backend throws DeviceError
// only for what the driver itself refuses. Objects are known by the small integer that Device gives (reused after
// destroy). Descriptors' `data` spans live only during the call.
#pragma once

#include "backends/device.h"

namespace volumark {

struct BoundResource {
  uint32_t slot;
  BindingKind kind;
  uint32_t object;      // buffer or texture
  size_t offset, size;  // of the buffer, resolved
  Sampler sampler;
};

struct ResolvedDraw {
  uint32_t pipeline;
  std::vector<uint32_t> vertex_buffers;
  bool indexed = false;
  uint32_t index_buffer = 0;
  std::vector<BoundResource> bindings;  // sorted by slot
  uint32_t first = 0, count = 0, instances = 1;
};

struct ResolvedPass {
  uint32_t colour;
  bool has_depth_stencil;
  uint32_t depth_stencil;
  int width, height;
  const PassDesc* desc;
};

class Backend {
 public:
  virtual ~Backend() = default;
  virtual const BackendInfo& info() const = 0;

  virtual void create_buffer(uint32_t id, const BufferDesc& desc) = 0;
  virtual void create_texture(uint32_t id, const TextureDesc& desc) = 0;
  virtual void create_program(uint32_t id, const ProgramDesc& desc) = 0;
  // `program` is the id of desc.program; program_desc what it was made from.
  virtual void create_pipeline(uint32_t id, uint32_t program, const PipelineDesc& desc,
                               const ProgramDesc& program_desc) = 0;
  virtual void destroy_buffer(uint32_t id) = 0;
  virtual void destroy_texture(uint32_t id) = 0;
  virtual void destroy_program(uint32_t id) = 0;
  virtual void destroy_pipeline(uint32_t id) = 0;

  virtual void update_buffer(uint32_t id, size_t offset, std::span<const std::byte> data) = 0;
  virtual void begin_pass(const ResolvedPass& pass) = 0;
  virtual void draw(const ResolvedDraw& draw) = 0;
  virtual void end_pass() = 0;
  virtual void dispatch(uint32_t program, std::span<const BoundResource> bindings, std::array<uint32_t, 3> groups) = 0;
  virtual void begin_zone(const std::string& name) = 0;
  virtual void end_zone() = 0;
  virtual std::vector<ZoneTime> submit_and_wait() = 0;
  virtual void read_texture(uint32_t id, std::span<std::byte> out) = 0;
  virtual void read_buffer(uint32_t id, size_t offset, std::span<std::byte> out) = 0;
};

std::unique_ptr<Backend> make_gl_backend(const DeviceOptions& options);
std::unique_ptr<Backend> make_vulkan_backend(const DeviceOptions& options);
std::unique_ptr<Backend> make_cpu_backend(const DeviceOptions& options);
std::unique_ptr<Backend> make_null_backend(const DeviceOptions& options);

}  // namespace volumark
