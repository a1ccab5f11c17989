#include "backends/vulkan/zones.h"

#include <algorithm>

namespace volumark::vulkan {

Zones::~Zones() {
  for (VkQueryPool pool : pools_) context_.vk.vkDestroyQueryPool(context_.device, pool, nullptr);
}

// ALL_COMMANDS at both ends: a zone begins when the work before it has ended, and so contains its own work alone.
uint32_t Zones::stamp(VkCommandBuffer commands) {
  if (context_.timestamp_bits == 0) return 0;
  if (used_ == pools_.size() * kPoolQueries) {
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = kPoolQueries;
    VkQueryPool pool = VK_NULL_HANDLE;
    check(context_.vk.vkCreateQueryPool(context_.device, &info, nullptr, &pool), "begin_zone", "", "vkCreateQueryPool");
    pools_.push_back(pool);
    context_.vk.vkResetQueryPool(context_.device, pool, 0, kPoolQueries);
  }
  context_.vk.vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pools_[used_ / kPoolQueries],
                                   used_ % kPoolQueries);
  return used_++;
}

void Zones::begin(VkCommandBuffer commands, const std::string& name) {
  const uint32_t query = stamp(commands);
  open_.push_back(zones_.size());
  zones_.push_back({name, query, query, Clock::now(), Clock::now()});
}

void Zones::end(VkCommandBuffer commands) {
  Zone& zone = zones_.at(open_.back());
  zone.end_query = stamp(commands);
  zone.end_host = Clock::now();
  open_.pop_back();
}

uint64_t Zones::value(uint32_t query) const {
  uint64_t result = 0;
  check(context_.vk.vkGetQueryPoolResults(context_.device, pools_[query / kPoolQueries], query % kPoolQueries, 1,
                                          sizeof result, &result, sizeof result,
                                          VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "submit_and_wait", "", "vkGetQueryPoolResults");
  return result;
}

std::vector<ZoneTime> Zones::take() {
  std::vector<ZoneTime> result;
  if (zones_.empty()) return result;
  const uint64_t mask = context_.timestamp_bits >= 64 ? ~uint64_t{0} : (uint64_t{1} << context_.timestamp_bits) - 1;
  const double tick = 1e-9 * static_cast<double>(context_.properties.limits.timestampPeriod);
  for (const Zone& zone : zones_) {
    double seconds = std::chrono::duration<double>(zone.end_host - zone.begin_host).count();
    if (context_.timestamp_bits > 0)
      seconds = tick * static_cast<double>((value(zone.end_query) - value(zone.begin_query)) & mask);
    result.push_back({zone.name, seconds});
  }
  for (VkQueryPool pool : pools_) context_.vk.vkResetQueryPool(context_.device, pool, 0, kPoolQueries);
  used_ = 0;
  zones_.clear();
  open_.clear();
  return result;
}

}  // namespace volumark::vulkan
