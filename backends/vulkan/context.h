// The Vulkan instance, the chosen device and its one queue, with everything that the rest of the backend asks about
// them. Device functions are called through `vk`, a table of this device, so that several backends can live at once.
// Destroyed last, after every object made from it.
#pragma once

#include <volk.h>

#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "backends/device.h"

namespace volumark::vulkan {

// Throws DeviceError when `result` is not success. `otherwise`: the kind for results that name no cause of their own.
void check(VkResult result, std::string_view call, std::string_view label, std::string_view what,
           DeviceErrorKind otherwise = DeviceErrorKind::DeviceLost);

// Warnings and errors of the validation layers, from whatever thread they come.
class ValidationLog {
 public:
  void add(std::string message);
  std::vector<std::string> take();

 private:
  std::mutex mutex_;
  std::vector<std::string> messages_;
};

class Context {
 public:
  explicit Context(const DeviceOptions& options);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // Throws what the validation layers have said since the last call, if anything.
  void throw_if_validation_spoke(std::string_view call, std::string_view label) const;
  // Index of a memory type with all of `wanted` among those of `type_bits`, or -1.
  int memory_type(uint32_t type_bits, VkMemoryPropertyFlags wanted) const;
  // Throws OutOfMemory when the driver or the heap's size refuses.
  VkDeviceMemory allocate(const VkMemoryRequirements& requirements, int type, std::string_view call,
                          std::string_view label) const;
  bool format_has(VkFormat format, VkFormatFeatureFlags wanted) const;

  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  uint32_t queue_family = 0;
  uint32_t timestamp_bits = 0;
  VolkDeviceTable vk{};
  VkPhysicalDeviceProperties properties{};
  VkPhysicalDeviceDriverProperties driver{};
  VkPhysicalDeviceFeatures features{};  // those that are on
  VkPhysicalDeviceMemoryProperties memory{};
  VkDeviceSize largest_device_heap = 0;
  VkDeviceSize max_buffer_bytes = 0;
  std::vector<std::string> workarounds;

 private:
  void make_instance(bool validation);
  void make_device();
  void destroy();

  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  PFN_vkDestroyDebugUtilsMessengerEXT destroy_messenger_ = nullptr;
  mutable ValidationLog validation_;
};

// device_choice.cpp: the device that `wanted` (DeviceOptions::vk_device) names, or a DeviceError that lists all there
// are.
VkPhysicalDevice choose_device(VkInstance instance, const std::string& wanted);

// device_info.cpp
BackendInfo describe(const Context& context);

}  // namespace volumark::vulkan
