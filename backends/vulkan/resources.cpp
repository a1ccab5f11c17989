#include "backends/vulkan/resources.h"

#include <algorithm>

namespace volumark::vulkan {
namespace {

constexpr VkMemoryPropertyFlags kMapped = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

// Buffers that programs read stand in device memory. They are mapped as well where all of the device's memory can be
// (software devices, resizable BAR), and when they are small enough for the window that other devices have.
int general_type(const Context& context, const VkMemoryRequirements& needs) {
  constexpr VkDeviceSize kSmall = 64 << 10;
  const int both = context.memory_type(needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | kMapped);
  if (both >= 0) {
    const VkMemoryType& type = context.memory.memoryTypes[both];
    if (needs.size <= kSmall || context.memory.memoryHeaps[type.heapIndex].size >= context.largest_device_heap)
      return both;
  }
  const int local = context.memory_type(needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  return local >= 0 ? local : context.memory_type(needs.memoryTypeBits, 0);
}

int transfer_type(const Context& context, const VkMemoryRequirements& needs) {
  const int cached = context.memory_type(needs.memoryTypeBits, kMapped | VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
  return cached >= 0 ? cached : context.memory_type(needs.memoryTypeBits, kMapped);
}

}  // namespace

VkFormat vk_format(Format format) {
  switch (format) {
    case Format::R8:
      return VK_FORMAT_R8_UNORM;
    case Format::R16:
      return VK_FORMAT_R16_UNORM;
    case Format::R16F:
      return VK_FORMAT_R16_SFLOAT;
    case Format::R32F:
      return VK_FORMAT_R32_SFLOAT;
    case Format::RG8:
      return VK_FORMAT_R8G8_UNORM;
    case Format::RGBA8:
      return VK_FORMAT_R8G8B8A8_UNORM;
    case Format::RGBA16F:
      return VK_FORMAT_R16G16B16A16_SFLOAT;
    case Format::RGBA32F:
      return VK_FORMAT_R32G32B32A32_SFLOAT;
    case Format::D32FS8:
      return VK_FORMAT_D32_SFLOAT_S8_UINT;
  }
  return VK_FORMAT_UNDEFINED;
}

VkImageAspectFlags aspects_of(Format format) {
  return is_depth_stencil(format) ? VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

GpuBuffer::GpuBuffer(const Context& context, size_t bytes, Use use, std::string_view call, std::string_view name)
    : size(bytes), label(name), context_(context) {
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = (bytes + 3) & ~size_t{3};  // vkCmdFillBuffer works in words
  if (context.max_buffer_bytes > 0 && info.size > context.max_buffer_bytes)
    throw DeviceError(DeviceErrorKind::OutOfMemory, call, name,
                      std::to_string(bytes) + " bytes wanted; a buffer of this device can have " +
                          std::to_string(context.max_buffer_bytes));
  info.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  if (use == Use::General)
    info.usage |= VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
                  VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  check(context.vk.vkCreateBuffer(context.device, &info, nullptr, &buffer), call, name, "vkCreateBuffer");
  try {
    VkMemoryRequirements needs{};
    context.vk.vkGetBufferMemoryRequirements(context.device, buffer, &needs);
    const int type = use == Use::General ? general_type(context, needs) : transfer_type(context, needs);
    memory_ = context.allocate(needs, type, call, name);
    check(context.vk.vkBindBufferMemory(context.device, buffer, memory_, 0), call, name, "vkBindBufferMemory");
    const VkMemoryPropertyFlags flags = context.memory.memoryTypes[type].propertyFlags;
    if ((flags & kMapped) == kMapped) {
      void* address = nullptr;
      check(context.vk.vkMapMemory(context.device, memory_, 0, VK_WHOLE_SIZE, 0, &address), call, name, "vkMapMemory");
      mapped = static_cast<std::byte*>(address);
      fast_to_read = (flags & VK_MEMORY_PROPERTY_HOST_CACHED_BIT) != 0;
    }
  } catch (...) {
    free();
    throw;
  }
}

GpuBuffer::~GpuBuffer() { free(); }

void GpuBuffer::free() {
  context_.vk.vkDestroyBuffer(context_.device, buffer, nullptr);
  context_.vk.vkFreeMemory(context_.device, memory_, nullptr);
}

GpuTexture::GpuTexture(const Context& context, const TextureDesc& desc)
    : format(desc.format),
      extent{static_cast<uint32_t>(desc.width), static_cast<uint32_t>(desc.height), static_cast<uint32_t>(desc.depth)},
      label(desc.label),
      context_(context) {
  const bool depth = is_depth_stencil(format);
  rest_layout = depth          ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL
                : desc.storage ? VK_IMAGE_LAYOUT_GENERAL
                               : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  filterable = context.format_has(vk_format(format), VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT);
  try {
    make_image(desc);
    view = make_view(desc, depth ? VkImageAspectFlags{VK_IMAGE_ASPECT_DEPTH_BIT} : aspects_of(format));
    if (desc.target) target_view = depth ? make_view(desc, aspects_of(format)) : view;
  } catch (...) {
    free();
    throw;
  }
}

void GpuTexture::make_image(const TextureDesc& desc) {
  constexpr const char* kCall = "create_texture";
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = static_cast<VkImageType>(VK_IMAGE_TYPE_1D + desc.dimension - 1);
  info.format = vk_format(format);
  info.extent = extent;
  info.mipLevels = info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  if (desc.target)
    info.usage |=
        is_depth_stencil(format) ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  if (desc.storage) info.usage |= VK_IMAGE_USAGE_STORAGE_BIT;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;

  VkImageFormatProperties offered{};
  const VkResult answer = vkGetPhysicalDeviceImageFormatProperties(context_.physical, info.format, info.imageType,
                                                                   info.tiling, info.usage, info.flags, &offered);
  check(answer, kCall, label, std::string("the device has no such texture of format ") + to_string(format),
        DeviceErrorKind::MissingCapability);
  const VkExtent3D& most = offered.maxExtent;
  if (extent.width > most.width || extent.height > most.height || extent.depth > most.depth)
    throw DeviceError(DeviceErrorKind::LimitExceeded, kCall, label,
                      std::string("the device's largest texture of format ") + to_string(format) + " is " +
                          std::to_string(most.width) + "x" + std::to_string(most.height) + "x" +
                          std::to_string(most.depth));
  const VkDeviceSize bytes = VkDeviceSize{extent.width} * extent.height * extent.depth * texel_bytes(format);
  if (bytes > context_.largest_device_heap)
    throw DeviceError(DeviceErrorKind::OutOfMemory, kCall, label,
                      std::to_string(bytes) + " bytes wanted; the device's memory has " +
                          std::to_string(context_.largest_device_heap));
  check(context_.vk.vkCreateImage(context_.device, &info, nullptr, &image), kCall, label, "vkCreateImage");
  VkMemoryRequirements needs{};
  context_.vk.vkGetImageMemoryRequirements(context_.device, image, &needs);
  const int local = context_.memory_type(needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  memory_ = context_.allocate(needs, local >= 0 ? local : context_.memory_type(needs.memoryTypeBits, 0), kCall, label);
  check(context_.vk.vkBindImageMemory(context_.device, image, memory_, 0), kCall, label, "vkBindImageMemory");
}

VkImageView GpuTexture::make_view(const TextureDesc& desc, VkImageAspectFlags aspects) const {
  VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  info.image = image;
  info.viewType = static_cast<VkImageViewType>(VK_IMAGE_VIEW_TYPE_1D + desc.dimension - 1);
  info.format = vk_format(format);
  info.subresourceRange = {aspects, 0, 1, 0, 1};
  VkImageView result = VK_NULL_HANDLE;
  check(context_.vk.vkCreateImageView(context_.device, &info, nullptr, &result), "create_texture", label,
        "vkCreateImageView");
  return result;
}

GpuTexture::~GpuTexture() { free(); }

void GpuTexture::free() {
  if (target_view != view) context_.vk.vkDestroyImageView(context_.device, target_view, nullptr);
  context_.vk.vkDestroyImageView(context_.device, view, nullptr);
  context_.vk.vkDestroyImage(context_.device, image, nullptr);
  context_.vk.vkFreeMemory(context_.device, memory_, nullptr);
}

VkImageMemoryBarrier2 transition(GpuTexture& texture, VkImageLayout to) {
  VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
  barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.oldLayout = texture.layout;
  barrier.newLayout = to;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = texture.image;
  barrier.subresourceRange = {aspects_of(texture.format), 0, 1, 0, 1};
  texture.layout = to;
  return barrier;
}

VkMemoryBarrier2 full_barrier() {
  VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
  barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  return barrier;
}

void record_barriers(const Context& context, VkCommandBuffer commands, const VkMemoryBarrier2* memory,
                     std::span<const VkImageMemoryBarrier2> images) {
  if (memory == nullptr && images.empty()) return;
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.memoryBarrierCount = memory != nullptr ? 1 : 0;
  info.pMemoryBarriers = memory;
  info.imageMemoryBarrierCount = static_cast<uint32_t>(images.size());
  info.pImageMemoryBarriers = images.data();
  context.vk.vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace volumark::vulkan
