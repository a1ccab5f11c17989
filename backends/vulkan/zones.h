// Timing zones by timestamps of the device's queue (by the host's clock at recording time where it has none).
#pragma once

#include <chrono>

#include "backends/vulkan/context.h"

namespace volumark::vulkan {

class Zones {
 public:
  explicit Zones(const Context& context) : context_(context) {}
  ~Zones();
  Zones(const Zones&) = delete;

  void begin(VkCommandBuffer commands, const std::string& name);
  void end(VkCommandBuffer commands);  // of the zone begun last and still open
  // All zones since the last call, in the order they began; their work has ended.
  std::vector<ZoneTime> take();

 private:
  using Clock = std::chrono::steady_clock;
  struct Zone {
    std::string name;
    uint32_t begin_query, end_query;
    Clock::time_point begin_host, end_host;
  };
  uint32_t stamp(VkCommandBuffer commands);
  uint64_t value(uint32_t query) const;

  static constexpr uint32_t kPoolQueries = 256;
  const Context& context_;
  std::vector<VkQueryPool> pools_;
  uint32_t used_ = 0;
  std::vector<Zone> zones_;
  std::vector<size_t> open_;
};

}  // namespace volumark::vulkan
