// A command buffer with its pool and fence: begin, record, submit and wait, again and again.
#pragma once

#include "backends/vulkan/context.h"

namespace volumark::vulkan {

class Commands {
 public:
  explicit Commands(const Context& context) : context_(context) {
    try {
      make();
    } catch (...) {
      free();
      throw;
    }
  }
  ~Commands() { free(); }
  Commands(const Commands&) = delete;

  bool recording() const { return recording_; }

  // Begins if need be.
  VkCommandBuffer get(std::string_view call) {
    if (recording_) return buffer_;
    check(context_.vk.vkResetCommandPool(context_.device, pool_, 0), call, "", "vkResetCommandPool");
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(context_.vk.vkBeginCommandBuffer(buffer_, &info), call, "", "vkBeginCommandBuffer");
    recording_ = true;
    return buffer_;
  }

  void submit_and_wait(std::string_view call) {
    recording_ = false;
    check(context_.vk.vkEndCommandBuffer(buffer_), call, "", "vkEndCommandBuffer");
    VkCommandBufferSubmitInfo commands{};
    commands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
    commands.commandBuffer = buffer_;
    VkSubmitInfo2 info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
    info.commandBufferInfoCount = 1;
    info.pCommandBufferInfos = &commands;
    check(context_.vk.vkResetFences(context_.device, 1, &fence_), call, "", "vkResetFences");
    check(context_.vk.vkQueueSubmit2(context_.queue, 1, &info, fence_), call, "", "vkQueueSubmit2");
    check(context_.vk.vkWaitForFences(context_.device, 1, &fence_, VK_TRUE, UINT64_MAX), call, "", "vkWaitForFences");
  }

 private:
  void make() {
    constexpr const char* kCall = "make_vulkan_backend";
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = context_.queue_family;
    check(context_.vk.vkCreateCommandPool(context_.device, &pool, nullptr, &pool_), kCall, "", "vkCreateCommandPool");
    VkCommandBufferAllocateInfo buffer{};
    buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    buffer.commandPool = pool_;
    buffer.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    buffer.commandBufferCount = 1;
    check(context_.vk.vkAllocateCommandBuffers(context_.device, &buffer, &buffer_), kCall, "",
          "vkAllocateCommandBuffers");
    VkFenceCreateInfo fence{};
    fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    check(context_.vk.vkCreateFence(context_.device, &fence, nullptr, &fence_), kCall, "", "vkCreateFence");
  }
  void free() {
    context_.vk.vkDestroyFence(context_.device, fence_, nullptr);
    context_.vk.vkDestroyCommandPool(context_.device, pool_, nullptr);
  }

  const Context& context_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer buffer_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  bool recording_ = false;
};

}  // namespace volumark::vulkan
