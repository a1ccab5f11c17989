// Descriptor sets by what they bind. A set lives on, from submission to submission, until something was destroyed;
// then all are dropped at once. The six samplers live here as well.
#pragma once

#include <array>
#include <unordered_map>

#include "backends/backend.h"
#include "backends/vulkan/programs.h"
#include "backends/vulkan/resources.h"

namespace volumark::vulkan {

// What a binding of the backend's interface stands for.
struct ResolvedBinding {
  const BoundResource* bound;
  GpuBuffer* buffer;    // Uniform, Storage
  GpuTexture* texture;  // Sampled, Image
};

class Descriptors {
 public:
  explicit Descriptors(const Context& context);
  ~Descriptors();
  Descriptors(const Descriptors&) = delete;

  VkDescriptorSet get(const GpuProgram& program, uint32_t program_id, std::span<const ResolvedBinding> bindings);
  // Ids may come to mean other objects: sets made so far are found no more.
  void forget();
  // No work is pending: memory of forgotten sets may be used again.
  void recycle();

 private:
  struct Entry {
    uint32_t program;
    std::vector<BoundResource> bindings;
    VkDescriptorSet set;
  };
  VkDescriptorSet allocate(const GpuProgram& program);
  void write(VkDescriptorSet set, std::span<const ResolvedBinding> bindings) const;
  void add_pool();
  VkSampler make_sampler(const Sampler& sampler) const;

  static constexpr size_t kPoolSets = 256, kMostSets = 8192;
  const Context& context_;
  std::array<VkSampler, 6> samplers_{};
  std::vector<VkDescriptorPool> pools_;
  size_t current_pool_ = 0;
  size_t set_count_ = 0;
  bool stale_ = false;
  std::unordered_multimap<uint64_t, Entry> sets_;
};

bool same_bindings(std::span<const BoundResource> a, std::span<const BoundResource> b);

}  // namespace volumark::vulkan
