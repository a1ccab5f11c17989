#include "backends/vulkan/context.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace volumark::vulkan {
namespace {

constexpr VkQueueFlags kBoth = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

const char* name_of(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "VK_ERROR_OUT_OF_HOST_MEMORY";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
    case VK_ERROR_OUT_OF_POOL_MEMORY:
      return "VK_ERROR_OUT_OF_POOL_MEMORY";
    case VK_ERROR_DEVICE_LOST:
      return "VK_ERROR_DEVICE_LOST";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "VK_ERROR_INITIALIZATION_FAILED";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "VK_ERROR_INCOMPATIBLE_DRIVER";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "VK_ERROR_FEATURE_NOT_PRESENT";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "VK_ERROR_EXTENSION_NOT_PRESENT";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "VK_ERROR_LAYER_NOT_PRESENT";
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
      return "VK_ERROR_FORMAT_NOT_SUPPORTED";
    case VK_ERROR_TOO_MANY_OBJECTS:
      return "VK_ERROR_TOO_MANY_OBJECTS";
    default:
      return nullptr;
  }
}

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  static_cast<ValidationLog*>(user)->add(data->pMessage);
  return VK_FALSE;
}

// Performance hints are left out: an attribute that a program does not read is no fault of the backend. So is what the
// loader says of drivers that nobody asked for.
VkDebugUtilsMessengerCreateInfoEXT messenger_info(ValidationLog& log) {
  VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  info.pfnUserCallback = on_message;
  info.pUserData = &log;
  return info;
}

bool layer_is_installed(const char* name) {
  uint32_t count = 0;
  vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  return std::any_of(layers.begin(), layers.end(),
                     [&](const VkLayerProperties& layer) { return std::strcmp(layer.layerName, name) == 0; });
}

// Mesa reads these when a driver starts. The disk cache would make the second run of a measurement differ from the
// first; the default sampling path of llvmpipe filters 8-bit textures in 8-bit arithmetic.
std::vector<std::string> set_mesa_environment() {
  std::vector<std::string> on;
  const auto ask = [&](const char* name, const char* value) {
    setenv(name, value, 0);
    if (std::strstr(std::getenv(name), value) != nullptr) on.push_back(std::string(name) + "=" + value);
  };
  ask("MESA_SHADER_CACHE_DISABLE", "true");
  ask("GALLIVM_PERF", "no_aos_sampling");
  return on;
}

}  // namespace

void check(VkResult result, std::string_view call, std::string_view label, std::string_view what,
           DeviceErrorKind otherwise) {
  if (result >= 0) return;
  DeviceErrorKind kind = otherwise;
  if (result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY ||
      result == VK_ERROR_OUT_OF_POOL_MEMORY || result == VK_ERROR_TOO_MANY_OBJECTS)
    kind = DeviceErrorKind::OutOfMemory;
  if (result == VK_ERROR_DEVICE_LOST) kind = DeviceErrorKind::DeviceLost;
  const char* name = name_of(result);
  const std::string text = name != nullptr ? name : "VkResult " + std::to_string(result);
  throw DeviceError(kind, call, label, std::string(what) + ": " + text);
}

void ValidationLog::add(std::string message) {
  const std::lock_guard lock(mutex_);
  messages_.push_back(std::move(message));
}

std::vector<std::string> ValidationLog::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(messages_, {});
}

Context::Context(const DeviceOptions& options) {
  workarounds = set_mesa_environment();
  if (volkInitialize() != VK_SUCCESS)
    throw DeviceError(DeviceErrorKind::MissingCapability, "make_vulkan_backend", "",
                      "no Vulkan loader (libvulkan.so.1) on this machine; install libvulkan1 and mesa-vulkan-drivers");
  try {
    make_instance(options.validation);
    physical = choose_device(instance_, options.vk_device);
    make_device();
  } catch (...) {
    destroy();
    throw;
  }
  if (driver.driverID != VK_DRIVER_ID_MESA_LLVMPIPE)
    std::erase_if(workarounds, [](const std::string& name) { return name.starts_with("GALLIVM"); });
}

Context::~Context() { destroy(); }

void Context::destroy() {
  if (device != VK_NULL_HANDLE) vk.vkDestroyDevice(device, nullptr);
  if (messenger_ != VK_NULL_HANDLE) destroy_messenger_(instance_, messenger_, nullptr);
  if (instance_ != VK_NULL_HANDLE) vkDestroyInstance(instance_, nullptr);
  // Too late to throw; but a leak that only shows when the device goes must not pass unseen.
  for (const std::string& message : validation_.take())
    std::fprintf(stderr, "volumark: vulkan validation, at the end: %s\n", message.c_str());
}

void Context::make_instance(bool validation) {
  constexpr const char* kCall = "make_vulkan_backend";
  if (vkEnumerateInstanceVersion == nullptr || volkGetInstanceVersion() < VK_API_VERSION_1_3)
    throw DeviceError(DeviceErrorKind::MissingCapability, kCall, "", "the Vulkan loader is older than 1.3; update it");
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.pApplicationName = "volumark";
  application.apiVersion = VK_API_VERSION_1_3;

  const VkValidationFeatureEnableEXT synchronisation = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  VkValidationFeaturesEXT checks{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
  checks.enabledValidationFeatureCount = 1;
  checks.pEnabledValidationFeatures = &synchronisation;
  VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(validation_);
  checks.pNext = &messenger;
  const char* extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME};

  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &application;
  if (validation) {
    if (!layer_is_installed(kValidationLayer))
      throw DeviceError(DeviceErrorKind::MissingCapability, kCall, "",
                        "validation was asked for, but VK_LAYER_KHRONOS_validation is not installed; install "
                        "vulkan-validationlayers");
    info.pNext = &checks;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &kValidationLayer;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = extensions;
  }
  check(vkCreateInstance(&info, nullptr, &instance_), kCall, "",
        "vkCreateInstance (is a driver installed? mesa-vulkan-drivers has lavapipe)",
        DeviceErrorKind::MissingCapability);
  volkLoadInstanceOnly(instance_);
  if (!validation) return;
  // Kept here and not taken from volk: its globals belong to whichever instance was loaded last.
  const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
  destroy_messenger_ = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
  check(create(instance_, &messenger, nullptr, &messenger_), kCall, "", "vkCreateDebugUtilsMessengerEXT");
}

void Context::make_device() {
  constexpr const char* kCall = "make_vulkan_backend";
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceMaintenance4Properties sizes{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES};
  VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
  all.pNext = &driver;
  driver.pNext = &sizes;
  vkGetPhysicalDeviceProperties2(physical, &all);
  driver.pNext = nullptr;
  properties = all.properties;
  max_buffer_bytes = sizes.maxBufferSize;
  vkGetPhysicalDeviceMemoryProperties(physical, &memory);
  for (uint32_t i = 0; i < memory.memoryHeapCount; ++i)
    if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
      largest_device_heap = std::max(largest_device_heap, memory.memoryHeaps[i].size);

  VkPhysicalDeviceVulkan13Features has13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  VkPhysicalDeviceVulkan12Features has12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &has13};
  VkPhysicalDeviceFeatures2 has{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &has12};
  vkGetPhysicalDeviceFeatures2(physical, &has);
  if (!has13.dynamicRendering || !has13.synchronization2 || !has12.hostQueryReset)
    throw DeviceError(DeviceErrorKind::MissingCapability, kCall, properties.deviceName,
                      "needs dynamicRendering, synchronization2 and hostQueryReset, which this device lacks");

  VkPhysicalDeviceVulkan13Features want13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  want13.dynamicRendering = VK_TRUE;
  want13.synchronization2 = VK_TRUE;
  want13.maintenance4 = has13.maintenance4;
  want13.shaderDemoteToHelperInvocation = has13.shaderDemoteToHelperInvocation;
  want13.shaderTerminateInvocation = has13.shaderTerminateInvocation;
  VkPhysicalDeviceVulkan12Features want12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &want13};
  want12.hostQueryReset = VK_TRUE;
  VkPhysicalDeviceFeatures2 want{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &want12};
  want.features.geometryShader = has.features.geometryShader;
  want.features.shaderFloat64 = has.features.shaderFloat64;
  want.features.fullDrawIndexUint32 = has.features.fullDrawIndexUint32;
  want.features.largePoints = has.features.largePoints;
  want.features.shaderClipDistance = has.features.shaderClipDistance;
  want.features.shaderCullDistance = has.features.shaderCullDistance;
  want.features.fragmentStoresAndAtomics = has.features.fragmentStoresAndAtomics;
  want.features.vertexPipelineStoresAndAtomics = has.features.vertexPipelineStoresAndAtomics;
  want.features.shaderStorageImageWriteWithoutFormat = has.features.shaderStorageImageWriteWithoutFormat;
  want.features.shaderTessellationAndGeometryPointSize = has.features.shaderTessellationAndGeometryPointSize;
  features = want.features;

  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  const auto family = std::find_if(families.begin(), families.end(),
                                   [](const auto& item) { return (item.queueFlags & kBoth) == kBoth; });
  if (family == families.end())
    throw DeviceError(DeviceErrorKind::MissingCapability, kCall, properties.deviceName,
                      "no queue with both graphics and compute");
  queue_family = static_cast<uint32_t>(family - families.begin());
  timestamp_bits = family->timestampValidBits;

  const float priority = 1;
  VkDeviceQueueCreateInfo queue_info{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue_info.queueFamilyIndex = queue_family;
  queue_info.queueCount = 1;
  queue_info.pQueuePriorities = &priority;
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &want};
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue_info;
  check(vkCreateDevice(physical, &info, nullptr, &device), kCall, properties.deviceName, "vkCreateDevice",
        DeviceErrorKind::MissingCapability);
  volkLoadDeviceTable(&vk, device);
  vk.vkGetDeviceQueue(device, queue_family, 0, &queue);
}

void Context::throw_if_validation_spoke(std::string_view call, std::string_view label) const {
  const std::vector<std::string> messages = validation_.take();
  if (messages.empty()) return;
  std::string text = "the validation layers said:";
  for (const std::string& message : messages) text += "\n  " + message;
  throw DeviceError(DeviceErrorKind::BadArgument, call, label, text);
}

int Context::memory_type(uint32_t type_bits, VkMemoryPropertyFlags wanted) const {
  for (uint32_t i = 0; i < memory.memoryTypeCount; ++i)
    if ((type_bits >> i & 1) && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return static_cast<int>(i);
  return -1;
}

VkDeviceMemory Context::allocate(const VkMemoryRequirements& requirements, int type, std::string_view call,
                                 std::string_view label) const {
  const auto refuse = [&](const std::string& why) {
    throw DeviceError(DeviceErrorKind::OutOfMemory, call, label,
                      std::to_string(requirements.size) + " bytes wanted; " + why);
  };
  if (type < 0) refuse("the device has no memory type for them");
  const auto index = static_cast<uint32_t>(type);
  const VkDeviceSize heap = memory.memoryHeaps[memory.memoryTypes[index].heapIndex].size;
  if (requirements.size > heap) refuse("the whole heap has " + std::to_string(heap));
  VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  info.allocationSize = requirements.size;
  info.memoryTypeIndex = index;
  VkDeviceMemory result = VK_NULL_HANDLE;
  check(vk.vkAllocateMemory(device, &info, nullptr, &result), call, label,
        "vkAllocateMemory of " + std::to_string(requirements.size) + " bytes");
  return result;
}

bool Context::format_has(VkFormat format, VkFormatFeatureFlags wanted) const {
  VkFormatProperties found{};
  vkGetPhysicalDeviceFormatProperties(physical, format, &found);
  return (found.optimalTilingFeatures & wanted) == wanted;
}

}  // namespace volumark::vulkan
