#include <algorithm>
#include <array>

#include "backends/backend.h"

namespace volumark {
namespace {

constexpr std::array kBackends = {
    BackendEntry{"gl", "OpenGL 4.5 core: OSMesa (llvmpipe), or EGL on a real GPU", &make_gl_backend},
    BackendEntry{"vulkan", "Vulkan 1.3: lavapipe, or any device by name", &make_vulkan_backend},
    BackendEntry{"cpu", "tile-binned SIMD rasterizer on all cores", &make_cpu_backend},
    BackendEntry{"null", "draws nothing, checks everything: for tests", &make_null_backend},
};

}  // namespace

std::span<const BackendEntry> backend_list() { return kBackends; }

Device make_device(std::string_view id, const DeviceOptions& options) {
  const auto* entry = std::ranges::find_if(kBackends, [&](const BackendEntry& e) { return id == e.id; });
  if (entry == kBackends.end()) {
    std::string known;
    for (const auto& e : kBackends) known += std::string(known.empty() ? "" : ", ") + e.id;
    throw std::invalid_argument("unknown backend '" + std::string(id) + "': known are " + known);
  }
  return Device(entry->make(options));
}

}  // namespace volumark
