#include <algorithm>
#include <cstdlib>
#include <regex>
#include <thread>

#include "backends/vulkan/context.h"

namespace volumark::vulkan {
namespace {

std::string version_text(uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) + "." +
         std::to_string(VK_API_VERSION_PATCH(version));
}

std::string vendor_name(uint32_t id) {
  switch (id) {
    case VK_VENDOR_ID_MESA:
      return "Mesa";
    case 0x1002:
      return "AMD";
    case 0x10de:
      return "NVIDIA";
    case 0x8086:
      return "Intel";
    case 0x13b5:
      return "Arm";
    case 0x5143:
      return "Qualcomm";
    default:
      return "PCI vendor " + std::to_string(id);
  }
}

// llvmpipe names its compiler and its vectors only in the device's name: "llvmpipe (LLVM 15.0.6, 256 bits)".
void add_llvm(const std::string& name, BackendInfo& info) {
  std::smatch found;
  if (std::regex_search(name, found, std::regex("LLVM ([0-9.]+)"))) info.llvm = found[1];
  if (std::regex_search(name, found, std::regex("([0-9]+) bits"))) info.simd_bits = std::stoi(found[1]);
}

int software_threads() {
  if (const char* set = std::getenv("LP_NUM_THREADS")) return std::max(1, std::atoi(set));
  return static_cast<int>(std::thread::hardware_concurrency());
}

void add_capabilities(const Context& context, BackendInfo& info) {
  const auto add = [&](Capability capability, bool present, const char* why_not) {
    if (present)
      info.capabilities.push_back(capability);
    else
      info.absent.emplace_back(capability, why_not);
  };
  add(Capability::GeometryStage, context.features.geometryShader, "the device has no geometryShader feature");
  add(Capability::Compute, true, "");
  add(Capability::StorageImages, true, "");
  add(Capability::GpuTimers, context.timestamp_bits > 0, "the device's queue has no timestamps");
  add(Capability::Float64, context.features.shaderFloat64, "the device has no shaderFloat64 feature");
}

}  // namespace

BackendInfo describe(const Context& context) {
  BackendInfo info;
  const VkPhysicalDeviceProperties& properties = context.properties;
  info.id = "vulkan";
  info.api = "Vulkan 1.3";
  info.vendor = vendor_name(properties.vendorID);
  info.renderer = properties.deviceName;
  info.version = version_text(properties.apiVersion);
  info.driver = std::string(context.driver.driverName) + " " + context.driver.driverInfo;
  info.software = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  if (info.software) {
    add_llvm(info.renderer, info);
    info.threads = software_threads();
  }
  info.limits.texture_1d = static_cast<int>(properties.limits.maxImageDimension1D);
  info.limits.texture_2d = static_cast<int>(properties.limits.maxImageDimension2D);
  info.limits.texture_3d = static_cast<int>(properties.limits.maxImageDimension3D);
  info.limits.storage_buffer_bytes = properties.limits.maxStorageBufferRange;
  add_capabilities(context, info);
  info.workarounds = context.workarounds;
  return info;
}

}  // namespace volumark::vulkan
