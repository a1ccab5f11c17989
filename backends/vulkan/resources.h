// Buffers and textures of the device, one allocation each. They free themselves; whoever owns them must first be sure
// that no work still reads them.
#pragma once

#include "backends/vulkan/context.h"

namespace volumark::vulkan {

VkFormat vk_format(Format format);
VkImageAspectFlags aspects_of(Format format);

class GpuBuffer {
 public:
  enum class Use {
    General,   // device memory; mapped as well where that costs nothing
    Transfer,  // host memory, always mapped, cached where there is such a type
  };
  GpuBuffer(const Context& context, size_t size, Use use, std::string_view call, std::string_view label);
  ~GpuBuffer();
  GpuBuffer(const GpuBuffer&) = delete;

  VkBuffer buffer = VK_NULL_HANDLE;
  std::byte* mapped = nullptr;  // null: reached by copies only
  bool fast_to_read = false;    // mapped, and reads go through the host's caches
  size_t size = 0;
  uint64_t used_in = 0;  // the recording that last referred to it
  std::string label;

 private:
  void free();
  const Context& context_;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
};

class GpuTexture {
 public:
  GpuTexture(const Context& context, const TextureDesc& desc);
  ~GpuTexture();
  GpuTexture(const GpuTexture&) = delete;

  VkImage image = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;         // for programs (of a depth format: the depth)
  VkImageView target_view = VK_NULL_HANDLE;  // as an attachment: all aspects
  Format format;
  VkExtent3D extent;
  bool filterable = false;
  VkImageLayout rest_layout;                         // in which programs see it, and in which it is left outside passes
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  // after all that is recorded so far
  uint64_t used_in = 0;
  std::string label;

 private:
  void make_image(const TextureDesc& desc);
  VkImageView make_view(const TextureDesc& desc, VkImageAspectFlags aspects) const;
  void free();
  const Context& context_;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
};

// A whole-image transition that orders everything before with everything after; sets texture.layout.
VkImageMemoryBarrier2 transition(GpuTexture& texture, VkImageLayout to);
VkMemoryBarrier2 full_barrier();
void record_barriers(const Context& context, VkCommandBuffer commands, const VkMemoryBarrier2* memory,
                     std::span<const VkImageMemoryBarrier2> images);

}  // namespace volumark::vulkan
