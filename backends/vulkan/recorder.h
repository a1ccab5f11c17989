// The recorded work: passes, draws, dispatches, buffer updates and zones in one command buffer, with the barriers
// between them. Between passes everything is ordered with everything; inside a pass nothing is but by the rasteriser.
#pragma once

#include <memory>

#include "backends/vulkan/commands.h"
#include "backends/vulkan/descriptors.h"
#include "backends/vulkan/zones.h"

namespace volumark::vulkan {

class Recorder {
 public:
  explicit Recorder(const Context& context);

  struct Pass {
    GpuTexture* colour;
    GpuTexture* depth_stencil;  // or null
    const PassDesc* desc;
  };
  struct Draw {
    const GpuProgram* program;
    uint32_t program_id;
    VkPipeline pipeline;
    std::span<GpuBuffer* const> vertex_buffers;
    GpuBuffer* index_buffer;  // or null
    std::span<const ResolvedBinding> bindings;
    uint32_t first, count, instances;
  };

  void begin_pass(const Pass& pass);
  void draw(const Draw& draw);
  void end_pass();
  void dispatch(const GpuProgram& program, uint32_t program_id, std::span<const ResolvedBinding> bindings,
                std::array<uint32_t, 3> groups);
  void update(GpuBuffer& buffer, size_t offset, std::span<const std::byte> data);
  void begin_zone(const std::string& name);
  void end_zone();

  // Runs what is recorded to its end; nothing recorded refers to anything any more.
  void flush(std::string_view call);
  std::vector<ZoneTime> take_zones() { return zones_.take(); }

  bool recording() const { return commands_.recording(); }
  template <class Object>
  bool refers_to(const Object& object) const {
    return commands_.recording() && object.used_in == serial_;
  }
  // An id was given up and may come to mean another object.
  void forget_ids();

 private:
  // Orders all recorded so far before what follows, and brings textures to their rest layout but for `keep`.
  void order(VkCommandBuffer commands, std::span<const Pass> next_pass);
  void attach(GpuTexture& texture, VkImageLayout layout, bool cleared);
  VkBuffer stage(std::span<const std::byte> data, size_t& offset);
  void use(std::span<const ResolvedBinding> bindings);
  void bind(VkPipelineBindPoint point, VkPipeline pipeline, const GpuProgram& program, uint32_t program_id,
            std::span<const ResolvedBinding> bindings);

  static constexpr size_t kChunkBytes = 256 << 10;
  const Context& context_;
  Commands commands_;
  Descriptors descriptors_;
  Zones zones_;
  uint64_t serial_ = 1;
  bool unordered_ = false;             // something was recorded since the last barrier
  std::vector<GpuTexture*> attached_;  // not in their rest layout
  std::vector<VkImageMemoryBarrier2> image_barriers_;
  std::vector<std::unique_ptr<GpuBuffer>> chunks_;  // data of updates, until the work has ended
  size_t chunk_used_ = 0;

  // What the command buffer has bound, to leave out binding it again.
  struct Bound {
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;
    uint32_t program_id = 0;
    std::vector<BoundResource> bindings;
    std::array<VkBuffer, 4> vertices{};
    VkBuffer indices = VK_NULL_HANDLE;
  };
  Bound bound_;
};

}  // namespace volumark::vulkan
