// Draws nothing: colour targets read back as their clear value, buffers as what was written. Tests of the order of
// calls and of everything above the Device run on it without a driver.
#include <cstring>
#include <map>
#include <utility>

#include "backends/backend.h"
#include "backends/texel.h"

namespace volumark {
namespace {

class NullBackend final : public Backend {
 public:
  NullBackend() {
    info_.id = "null";
    info_.api = "null";
    info_.vendor = info_.driver = info_.renderer = "volumark null";
    info_.version = "1";
    info_.threads = 1;
    info_.limits = {16384, 16384, 2048, size_t{1} << 31};
    info_.capabilities = {Capability::GeometryStage, Capability::Compute, Capability::StorageImages};
    info_.absent = {{Capability::GpuTimers, "nothing is drawn"}, {Capability::Float64, "nothing is drawn"}};
  }

  const BackendInfo& info() const override { return info_; }

  void create_buffer(uint32_t id, const BufferDesc& desc) override { fill(buffers_[id], desc.size, desc.data); }
  void create_texture(uint32_t id, const TextureDesc& desc) override {
    const size_t texels =
        static_cast<size_t>(desc.width) * static_cast<size_t>(desc.height) * static_cast<size_t>(desc.depth);
    fill(textures_[id].bytes, texels * texel_bytes(desc.format), desc.data);
    textures_[id].format = desc.format;
  }
  void create_program(uint32_t, const ProgramDesc&) override {}
  void create_pipeline(uint32_t, uint32_t, const PipelineDesc&, const ProgramDesc&) override {}
  void destroy_buffer(uint32_t id) override { buffers_.erase(id); }
  void destroy_texture(uint32_t id) override { textures_.erase(id); }
  void destroy_program(uint32_t) override {}
  void destroy_pipeline(uint32_t) override {}

  void update_buffer(uint32_t id, size_t offset, std::span<const std::byte> data) override {
    std::memcpy(buffers_.at(id).data() + offset, data.data(), data.size());
  }
  void begin_pass(const ResolvedPass& pass) override {
    if (pass.desc->clear_colour) {
      auto& texture = textures_.at(pass.colour);
      fill_texels(texture.format, pass.desc->colour_value, texture.bytes);
    }
    if (pass.has_depth_stencil && pass.desc->clear_depth_stencil) {
      fill_depth_stencil(pass.desc->depth_value, pass.desc->stencil_value, textures_.at(pass.depth_stencil).bytes);
    }
  }
  void draw(const ResolvedDraw&) override {}
  void end_pass() override {}
  void dispatch(uint32_t, std::span<const BoundResource>, std::array<uint32_t, 3>) override {}
  void begin_zone(const std::string& name) override { zones_.push_back({name, 0}); }
  void end_zone() override {}
  std::vector<ZoneTime> submit_and_wait() override { return std::exchange(zones_, {}); }
  void read_texture(uint32_t id, std::span<std::byte> out) override {
    std::memcpy(out.data(), textures_.at(id).bytes.data(), out.size());
  }
  void read_buffer(uint32_t id, size_t offset, std::span<std::byte> out) override {
    std::memcpy(out.data(), buffers_.at(id).data() + offset, out.size());
  }

 private:
  struct TextureBytes {
    Format format = Format::RGBA8;
    std::vector<std::byte> bytes;
  };
  static void fill(std::vector<std::byte>& bytes, size_t size, std::span<const std::byte> data) {
    bytes.assign(size, std::byte{0});
    if (!data.empty()) std::memcpy(bytes.data(), data.data(), size);
  }

  BackendInfo info_;
  std::map<uint32_t, std::vector<std::byte>> buffers_;
  std::map<uint32_t, TextureBytes> textures_;
  std::vector<ZoneTime> zones_;
};

}  // namespace

std::unique_ptr<Backend> make_null_backend(const DeviceOptions&) { return std::make_unique<NullBackend>(); }

}  // namespace volumark
