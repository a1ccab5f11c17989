// The Backend interface over the parts beside this file: it knows which object an id means, keeps destroyed objects
// until no recorded work refers to them, and hands validation messages on.
#include <algorithm>

#include "backends/vulkan/recorder.h"
#include "backends/vulkan/transfer.h"

namespace volumark {
namespace vulkan {
namespace {

template <class Object>
class Table {
 public:
  Object& at(uint32_t id) const { return *objects_.at(id); }
  void set(uint32_t id, std::unique_ptr<Object> object) {
    if (id >= objects_.size()) objects_.resize(id + 1);
    objects_[id] = std::move(object);
  }
  std::unique_ptr<Object> take(uint32_t id) { return std::move(objects_.at(id)); }

 private:
  std::vector<std::unique_ptr<Object>> objects_;
};

struct PipelineEntry {
  std::unique_ptr<GpuPipeline> pipeline;
  uint32_t program;
};

// Destroyed while the recording may refer to them.
struct Graveyard {
  std::vector<std::unique_ptr<GpuBuffer>> buffers;
  std::vector<std::unique_ptr<GpuTexture>> textures;
  std::vector<std::unique_ptr<GpuProgram>> programs;
  std::vector<std::unique_ptr<PipelineEntry>> pipelines;
};

class VulkanBackend final : public Backend {
 public:
  explicit VulkanBackend(const DeviceOptions& options)
      : context_(options), info_(describe(context_)), transfer_(context_), recorder_(context_) {
    context_.throw_if_validation_spoke("make_vulkan_backend", "");
  }
  ~VulkanBackend() override { context_.vk.vkDeviceWaitIdle(context_.device); }

  const BackendInfo& info() const override { return info_; }

  void create_buffer(uint32_t id, const BufferDesc& desc) override {
    require_alive("create_buffer", desc.label);
    auto buffer =
        std::make_unique<GpuBuffer>(context_, desc.size, GpuBuffer::Use::General, "create_buffer", desc.label);
    transfer_.fill(*buffer, desc.data);
    context_.throw_if_validation_spoke("create_buffer", desc.label);
    buffers_.set(id, std::move(buffer));
  }

  void create_texture(uint32_t id, const TextureDesc& desc) override {
    require_alive("create_texture", desc.label);
    auto texture = std::make_unique<GpuTexture>(context_, desc);
    transfer_.fill(*texture, desc.data);
    context_.throw_if_validation_spoke("create_texture", desc.label);
    textures_.set(id, std::move(texture));
  }

  void create_program(uint32_t id, const ProgramDesc& desc) override {
    require_alive("create_program", desc.label);
    auto program = std::make_unique<GpuProgram>(context_, desc);
    context_.throw_if_validation_spoke("create_program", desc.label);
    programs_.set(id, std::move(program));
  }

  void create_pipeline(uint32_t id, uint32_t program, const PipelineDesc& desc, const ProgramDesc&) override {
    require_alive("create_pipeline", desc.label);
    auto entry = std::make_unique<PipelineEntry>();
    entry->pipeline = std::make_unique<GpuPipeline>(context_, programs_.at(program), desc);
    entry->program = program;
    context_.throw_if_validation_spoke("create_pipeline", desc.label);
    pipelines_.set(id, std::move(entry));
  }

  void destroy_buffer(uint32_t id) override {
    auto buffer = buffers_.take(id);
    recorder_.forget_ids();
    if (recorder_.refers_to(*buffer)) graveyard_.buffers.push_back(std::move(buffer));
  }
  void destroy_texture(uint32_t id) override {
    auto texture = textures_.take(id);
    recorder_.forget_ids();
    if (recorder_.refers_to(*texture)) graveyard_.textures.push_back(std::move(texture));
  }
  void destroy_program(uint32_t id) override {
    auto program = programs_.take(id);
    recorder_.forget_ids();
    if (recorder_.recording()) graveyard_.programs.push_back(std::move(program));
  }
  void destroy_pipeline(uint32_t id) override {
    auto pipeline = pipelines_.take(id);
    recorder_.forget_ids();
    if (recorder_.recording()) graveyard_.pipelines.push_back(std::move(pipeline));
  }

  void update_buffer(uint32_t id, size_t offset, std::span<const std::byte> data) override {
    require_alive("update_buffer", buffers_.at(id).label);
    recorder_.update(buffers_.at(id), offset, data);
  }

  void begin_pass(const ResolvedPass& pass) override {
    require_alive("begin_pass", pass.desc->label);
    recorder_.begin_pass(
        {&textures_.at(pass.colour), pass.has_depth_stencil ? &textures_.at(pass.depth_stencil) : nullptr, pass.desc});
  }

  void draw(const ResolvedDraw& draw) override {
    const PipelineEntry& entry = pipelines_.at(draw.pipeline);
    vertex_buffers_.clear();
    for (uint32_t id : draw.vertex_buffers) vertex_buffers_.push_back(&buffers_.at(id));
    GpuBuffer* indices = draw.indexed ? &buffers_.at(draw.index_buffer) : nullptr;
    recorder_.draw({&programs_.at(entry.program), entry.program, entry.pipeline->pipeline, vertex_buffers_, indices,
                    resolve(draw.bindings), draw.first, draw.count, draw.instances});
  }

  void end_pass() override { recorder_.end_pass(); }

  void dispatch(uint32_t program, std::span<const BoundResource> bindings, std::array<uint32_t, 3> groups) override {
    require_alive("dispatch", programs_.at(program).label);
    recorder_.dispatch(programs_.at(program), program, resolve(bindings), groups);
  }

  void begin_zone(const std::string& name) override { recorder_.begin_zone(name); }
  void end_zone() override { recorder_.end_zone(); }

  std::vector<ZoneTime> submit_and_wait() override {
    flush("submit_and_wait");
    std::vector<ZoneTime> zones = recorder_.take_zones();
    context_.throw_if_validation_spoke("submit_and_wait", "");
    return zones;
  }

  void read_texture(uint32_t id, std::span<std::byte> out) override {
    flush("read_texture");
    guarded([&] { transfer_.read(textures_.at(id), out); });
    context_.throw_if_validation_spoke("read_texture", textures_.at(id).label);
  }

  void read_buffer(uint32_t id, size_t offset, std::span<std::byte> out) override {
    flush("read_buffer");
    guarded([&] { transfer_.read(buffers_.at(id), offset, out); });
    context_.throw_if_validation_spoke("read_buffer", buffers_.at(id).label);
  }

 private:
  void require_alive(const char* call, const std::string& label) const {
    if (lost_) throw DeviceError(DeviceErrorKind::DeviceLost, call, label, "the device was lost before this call");
  }

  // Remembers that the device is gone: whatever comes after would only hang or crash the driver.
  template <class Function>
  void guarded(Function&& function) {
    try {
      function();
    } catch (const DeviceError& error) {
      lost_ = lost_ || error.kind == DeviceErrorKind::DeviceLost;
      throw;
    }
  }

  void flush(const char* call) {
    require_alive(call, "");
    guarded([&] { recorder_.flush(call); });
    graveyard_ = {};
  }

  std::span<const ResolvedBinding> resolve(std::span<const BoundResource> bindings) {
    resolved_.clear();
    for (const BoundResource& bound : bindings) {
      const bool buffer = bound.kind == BindingKind::Uniform || bound.kind == BindingKind::Storage;
      resolved_.push_back(
          {&bound, buffer ? &buffers_.at(bound.object) : nullptr, buffer ? nullptr : &textures_.at(bound.object)});
    }
    return resolved_;
  }

  Context context_;
  BackendInfo info_;
  Transfer transfer_;
  Recorder recorder_;
  Table<GpuBuffer> buffers_;
  Table<GpuTexture> textures_;
  Table<GpuProgram> programs_;
  Table<PipelineEntry> pipelines_;
  Graveyard graveyard_;
  std::vector<ResolvedBinding> resolved_;
  std::vector<GpuBuffer*> vertex_buffers_;
  bool lost_ = false;
};

}  // namespace
}  // namespace vulkan

std::unique_ptr<Backend> make_vulkan_backend(const DeviceOptions& options) {
  return std::make_unique<vulkan::VulkanBackend>(options);
}

}  // namespace volumark
