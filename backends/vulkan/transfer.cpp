#include "backends/vulkan/transfer.h"

#include <algorithm>
#include <cstring>

namespace volumark::vulkan {
namespace {

struct Slab {
  VkOffset3D offset;
  VkExtent3D extent;
  size_t first_texel, texels;
};

// Whole slices while they fit, else whole rows of a slice: each slab is one run of the tight image.
template <class Function>
void for_each_slab(const GpuTexture& texture, Function&& function) {
  const size_t row = texture.extent.width;
  const size_t slice = row * texture.extent.height;
  const size_t most = Transfer::kStagingBytes / texel_bytes(texture.format);
  const auto at_once = [](size_t capacity, size_t item, uint32_t count) {
    return static_cast<uint32_t>(std::clamp<size_t>(capacity / item, 1, count));
  };
  const uint32_t slices = at_once(most, slice, texture.extent.depth);
  const uint32_t rows = slices > 1 ? texture.extent.height : at_once(most, row, texture.extent.height);
  for (uint32_t z = 0; z < texture.extent.depth; z += slices)
    for (uint32_t y = 0; y < texture.extent.height; y += rows) {
      const VkExtent3D extent{texture.extent.width, std::min(rows, texture.extent.height - y),
                              std::min(slices, texture.extent.depth - z)};
      function(Slab{{0, static_cast<int32_t>(y), static_cast<int32_t>(z)},
                    extent,
                    z * slice + y * row,
                    row * extent.height * extent.depth});
    }
}

VkBufferImageCopy copy_of(const Slab& slab, VkImageAspectFlags aspect, size_t buffer_offset) {
  VkBufferImageCopy copy{};
  copy.bufferOffset = buffer_offset;
  copy.imageSubresource = {aspect, 0, 0, 1};
  copy.imageOffset = slab.offset;
  copy.imageExtent = slab.extent;
  return copy;
}

// In the staging buffer depth and stencil lie apart, all depths first, since Vulkan copies one aspect at a time.
std::vector<VkBufferImageCopy> copies_of(const GpuTexture& texture, const Slab& slab) {
  if (!is_depth_stencil(texture.format)) return {copy_of(slab, VK_IMAGE_ASPECT_COLOR_BIT, 0)};
  return {copy_of(slab, VK_IMAGE_ASPECT_DEPTH_BIT, 0),
          copy_of(slab, VK_IMAGE_ASPECT_STENCIL_BIT, slab.texels * sizeof(float))};
}

void from_staging(const GpuTexture& texture, const Slab& slab, const std::byte* staging, std::span<std::byte> out) {
  const size_t texel = texel_bytes(texture.format);
  std::byte* to = out.data() + slab.first_texel * texel;
  if (!is_depth_stencil(texture.format)) {
    std::memcpy(to, staging, slab.texels * texel);
    return;
  }
  for (size_t i = 0; i < slab.texels; ++i) {
    std::memcpy(to + 8 * i, staging + 4 * i, 4);
    const auto stencil = static_cast<uint32_t>(staging[4 * slab.texels + i]);
    std::memcpy(to + 8 * i + 4, &stencil, 4);
  }
}

void record_clear(const Context& context, VkCommandBuffer commands, const GpuTexture& texture) {
  const VkImageSubresourceRange all{aspects_of(texture.format), 0, 1, 0, 1};
  if (is_depth_stencil(texture.format)) {
    const VkClearDepthStencilValue zero{0, 0};
    context.vk.vkCmdClearDepthStencilImage(commands, texture.image, texture.layout, &zero, 1, &all);
  } else {
    const VkClearColorValue zero{};
    context.vk.vkCmdClearColorImage(commands, texture.image, texture.layout, &zero, 1, &all);
  }
}

void make_visible_to_host(const Context& context, VkCommandBuffer commands) {
  VkMemoryBarrier2 barrier = full_barrier();
  barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
  record_barriers(context, commands, &barrier, {});
}

}  // namespace

Transfer::Transfer(const Context& context) : context_(context), commands_(context) {}

GpuBuffer& Transfer::staging(size_t bytes, std::string_view call, std::string_view label) {
  if (!staging_ || staging_->size < bytes) {
    staging_.reset();
    staging_ = std::make_unique<GpuBuffer>(context_, bytes, GpuBuffer::Use::Transfer, call, label);
  }
  return *staging_;
}

void Transfer::fill(GpuTexture& texture, std::span<const std::byte> data) {
  constexpr const char* kCall = "create_texture";
  const auto move_to = [&](VkImageLayout layout) {
    const VkImageMemoryBarrier2 barrier = transition(texture, layout);
    record_barriers(context_, commands_.get(kCall), nullptr, {&barrier, 1});
  };
  // Before anything is recorded: when it fails, no command may be left that names the texture.
  if (!data.empty()) staging(std::min(kStagingBytes, data.size()), kCall, texture.label);
  move_to(VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  if (data.empty()) {
    record_clear(context_, commands_.get(kCall), texture);
  } else {
    GpuBuffer& through = *staging_;
    bool first = true;
    for_each_slab(texture, [&](const Slab& slab) {
      if (!first) commands_.submit_and_wait(kCall);  // the last slab is submitted with the transition behind it
      first = false;
      const size_t texel = texel_bytes(texture.format);  // never depth and stencil: those start without data
      std::memcpy(through.mapped, data.data() + slab.first_texel * texel, slab.texels * texel);
      const std::vector<VkBufferImageCopy> copies = copies_of(texture, slab);
      context_.vk.vkCmdCopyBufferToImage(commands_.get(kCall), through.buffer, texture.image, texture.layout,
                                         static_cast<uint32_t>(copies.size()), copies.data());
    });
  }
  move_to(texture.rest_layout);
  commands_.submit_and_wait(kCall);
}

void Transfer::fill(GpuBuffer& buffer, std::span<const std::byte> data) {
  constexpr const char* kCall = "create_buffer";
  if (buffer.mapped != nullptr) {
    if (data.empty())
      std::memset(buffer.mapped, 0, buffer.size);
    else
      std::memcpy(buffer.mapped, data.data(), data.size());
    return;
  }
  if (data.empty()) {
    context_.vk.vkCmdFillBuffer(commands_.get(kCall), buffer.buffer, 0, VK_WHOLE_SIZE, 0);
    commands_.submit_and_wait(kCall);
    return;
  }
  GpuBuffer& through = staging(std::min(kStagingBytes, data.size()), kCall, buffer.label);
  for (size_t at = 0; at < data.size(); at += through.size) {
    const VkBufferCopy copy{0, at, std::min(through.size, data.size() - at)};
    std::memcpy(through.mapped, data.data() + at, copy.size);
    context_.vk.vkCmdCopyBuffer(commands_.get(kCall), through.buffer, buffer.buffer, 1, &copy);
    commands_.submit_and_wait(kCall);
  }
}

void Transfer::read(GpuTexture& texture, std::span<std::byte> out) {
  constexpr const char* kCall = "read_texture";
  GpuBuffer& through = staging(std::min(kStagingBytes, out.size()), kCall, texture.label);
  const VkImageLayout before = texture.layout;
  for_each_slab(texture, [&](const Slab& slab) {
    const VkCommandBuffer commands = commands_.get(kCall);
    const VkImageMemoryBarrier2 there = transition(texture, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    record_barriers(context_, commands, nullptr, {&there, 1});
    const std::vector<VkBufferImageCopy> copies = copies_of(texture, slab);
    context_.vk.vkCmdCopyImageToBuffer(commands, texture.image, texture.layout, through.buffer,
                                       static_cast<uint32_t>(copies.size()), copies.data());
    const VkImageMemoryBarrier2 back = transition(texture, before);
    record_barriers(context_, commands, nullptr, {&back, 1});
    make_visible_to_host(context_, commands);
    commands_.submit_and_wait(kCall);
    from_staging(texture, slab, through.mapped, out);
  });
}

void Transfer::read(GpuBuffer& buffer, size_t offset, std::span<std::byte> out) {
  constexpr const char* kCall = "read_buffer";
  if (buffer.fast_to_read) {
    std::memcpy(out.data(), buffer.mapped + offset, out.size());
    return;
  }
  GpuBuffer& through = staging(std::min(kStagingBytes, out.size()), kCall, buffer.label);
  for (size_t at = 0; at < out.size(); at += through.size) {
    const VkBufferCopy copy{offset + at, 0, std::min(through.size, out.size() - at)};
    context_.vk.vkCmdCopyBuffer(commands_.get(kCall), buffer.buffer, through.buffer, 1, &copy);
    make_visible_to_host(context_, commands_.get(kCall));
    commands_.submit_and_wait(kCall);
    std::memcpy(out.data() + at, through.mapped, copy.size);
  }
}

}  // namespace volumark::vulkan
