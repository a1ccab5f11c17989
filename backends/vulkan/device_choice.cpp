#include <algorithm>
#include <cctype>

#include "backends/vulkan/context.h"

namespace volumark::vulkan {
namespace {

struct Found {
  VkPhysicalDevice device;
  std::string name;
  VkDriverId driver;
  uint32_t api;
};

std::vector<Found> find_devices(VkInstance instance) {
  uint32_t count = 0;
  vkEnumeratePhysicalDevices(instance, &count, nullptr);
  std::vector<VkPhysicalDevice> devices(count);
  vkEnumeratePhysicalDevices(instance, &count, devices.data());
  devices.resize(count);
  std::vector<Found> found;
  for (VkPhysicalDevice device : devices) {
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver};
    vkGetPhysicalDeviceProperties2(device, &properties);
    found.push_back({device, properties.properties.deviceName, driver.driverID, properties.properties.apiVersion});
  }
  return found;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool is_number(const std::string& text) {
  return !text.empty() && text.size() < 6 &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

bool matches(const Found& found, size_t index, const std::string& wanted) {
  if (wanted.empty()) return found.driver == VK_DRIVER_ID_MESA_LLVMPIPE;
  if (is_number(wanted)) return index == std::stoul(wanted);
  return lower(found.name).find(lower(wanted)) != std::string::npos;
}

std::string list_of(const std::vector<Found>& found) {
  std::string text;
  for (size_t i = 0; i < found.size(); ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(i) + ": '" + found[i].name + "'";
  return text.empty() ? "none" : text;
}

}  // namespace

VkPhysicalDevice choose_device(VkInstance instance, const std::string& wanted) {
  const std::vector<Found> found = find_devices(instance);
  for (size_t i = 0; i < found.size(); ++i) {
    if (!matches(found[i], i, wanted)) continue;
    if (found[i].api < VK_API_VERSION_1_3)
      throw DeviceError(DeviceErrorKind::MissingCapability, "make_vulkan_backend", found[i].name,
                        "the device offers Vulkan " + std::to_string(VK_API_VERSION_MAJOR(found[i].api)) + "." +
                            std::to_string(VK_API_VERSION_MINOR(found[i].api)) + "; 1.3 is needed");
    return found[i].device;
  }
  const std::string asked =
      wanted.empty() ? "no lavapipe (llvmpipe) device; install mesa-vulkan-drivers, or choose a device by name or index"
                     : "no Vulkan device '" + wanted + "'";
  throw DeviceError(DeviceErrorKind::MissingCapability, "make_vulkan_backend", wanted,
                    asked + "; devices found: " + list_of(found));
}

}  // namespace volumark::vulkan
