#include "backends/vulkan/descriptors.h"

#include <algorithm>

namespace volumark::vulkan {
namespace {

constexpr size_t kMostBindings = 16;

bool same(const BoundResource& a, const BoundResource& b) {
  return a.slot == b.slot && a.kind == b.kind && a.object == b.object && a.offset == b.offset && a.size == b.size &&
         a.sampler == b.sampler;
}

size_t sampler_index(const Sampler& sampler) {
  return static_cast<size_t>(sampler.filter) * 3 + static_cast<size_t>(sampler.wrap);
}

uint64_t hash_of(uint32_t program, std::span<const ResolvedBinding> bindings) {
  uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&](uint64_t value) { hash = (hash ^ value) * 0x9e3779b97f4a7c15u ^ hash >> 29; };
  add(program);
  for (const ResolvedBinding& binding : bindings) {
    add(binding.bound->object);
    add(binding.bound->offset);
    add(binding.bound->size);
    add(sampler_index(binding.bound->sampler));
  }
  return hash;
}

}  // namespace

bool same_bindings(std::span<const BoundResource> a, std::span<const BoundResource> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

Descriptors::Descriptors(const Context& context) : context_(context) {}

Descriptors::~Descriptors() {
  for (VkSampler sampler : samplers_) context_.vk.vkDestroySampler(context_.device, sampler, nullptr);
  for (VkDescriptorPool pool : pools_) context_.vk.vkDestroyDescriptorPool(context_.device, pool, nullptr);
}

VkSampler Descriptors::make_sampler(const Sampler& sampler) const {
  const VkFilter filter = sampler.filter == Filter::Linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
  const VkSamplerAddressMode mode = sampler.wrap == Wrap::Clamp    ? VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE
                                    : sampler.wrap == Wrap::Border ? VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER
                                                                   : VK_SAMPLER_ADDRESS_MODE_REPEAT;
  VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  info.magFilter = info.minFilter = filter;
  info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST;
  info.addressModeU = info.addressModeV = info.addressModeW = mode;
  info.borderColor = VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK;
  VkSampler result = VK_NULL_HANDLE;
  check(context_.vk.vkCreateSampler(context_.device, &info, nullptr, &result), "draw", "", "vkCreateSampler");
  return result;
}

VkDescriptorSet Descriptors::get(const GpuProgram& program, uint32_t program_id,
                                 std::span<const ResolvedBinding> bindings) {
  const uint64_t hash = hash_of(program_id, bindings);
  const auto equal = [](const ResolvedBinding& a, const BoundResource& b) { return same(*a.bound, b); };
  const auto [first, last] = sets_.equal_range(hash);
  for (auto it = first; it != last; ++it) {
    const Entry& entry = it->second;
    if (entry.program == program_id &&
        std::equal(bindings.begin(), bindings.end(), entry.bindings.begin(), entry.bindings.end(), equal))
      return entry.set;
  }
  for (const ResolvedBinding& binding : bindings) {
    if (binding.bound->kind != BindingKind::Sampled) continue;
    if (binding.bound->sampler.filter == Filter::Linear && !binding.texture->filterable)
      throw DeviceError(DeviceErrorKind::MissingCapability, "draw", binding.texture->label,
                        std::string("the device cannot filter ") + to_string(binding.texture->format) + " linearly");
    VkSampler& sampler = samplers_[sampler_index(binding.bound->sampler)];
    if (sampler == VK_NULL_HANDLE) sampler = make_sampler(binding.bound->sampler);
  }
  Entry entry{program_id, {}, allocate(program)};
  for (const ResolvedBinding& binding : bindings) entry.bindings.push_back(*binding.bound);
  write(entry.set, bindings);
  const VkDescriptorSet set = entry.set;
  sets_.emplace(hash, std::move(entry));
  return set;
}

void Descriptors::add_pool() {
  // Every set has at most 16 bindings; 4 of a kind is far above what programs have on average.
  constexpr uint32_t kOfAKind = 4 * kPoolSets;
  const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kOfAKind},
                                        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kOfAKind},
                                        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kOfAKind},
                                        {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, kOfAKind}};
  VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  info.maxSets = kPoolSets;
  info.poolSizeCount = static_cast<uint32_t>(std::size(sizes));
  info.pPoolSizes = sizes;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  check(context_.vk.vkCreateDescriptorPool(context_.device, &info, nullptr, &pool), "draw", "",
        "vkCreateDescriptorPool");
  pools_.push_back(pool);
}

VkDescriptorSet Descriptors::allocate(const GpuProgram& program) {
  for (bool fresh = false;;) {
    if (current_pool_ == pools_.size()) {
      add_pool();
      fresh = true;
    }
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pools_[current_pool_];
    info.descriptorSetCount = 1;
    info.pSetLayouts = &program.set_layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    const VkResult result = context_.vk.vkAllocateDescriptorSets(context_.device, &info, &set);
    const bool full = result == VK_ERROR_OUT_OF_POOL_MEMORY || result == VK_ERROR_FRAGMENTED_POOL;
    if (!full || fresh) check(result, "draw", program.label, "vkAllocateDescriptorSets");
    if (result == VK_SUCCESS) {
      ++set_count_;
      return set;
    }
    ++current_pool_;
  }
}

void Descriptors::write(VkDescriptorSet set, std::span<const ResolvedBinding> bindings) const {
  std::array<VkDescriptorBufferInfo, kMostBindings> buffers;
  std::array<VkDescriptorImageInfo, kMostBindings> images;
  std::array<VkWriteDescriptorSet, kMostBindings> writes;
  for (size_t i = 0; i < bindings.size(); ++i) {
    const BoundResource& bound = *bindings[i].bound;
    VkWriteDescriptorSet& item = writes[i] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    item.dstSet = set;
    item.dstBinding = bound.slot;
    item.descriptorCount = 1;
    item.pBufferInfo = &buffers[i];
    item.pImageInfo = &images[i];
    switch (bound.kind) {
      case BindingKind::Uniform:
        item.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
        buffers[i] = {bindings[i].buffer->buffer, bound.offset,
                      std::min<VkDeviceSize>(bound.size, context_.properties.limits.maxUniformBufferRange)};
        break;
      case BindingKind::Storage:
        item.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        buffers[i] = {bindings[i].buffer->buffer, bound.offset, bound.size};
        break;
      case BindingKind::Sampled:
        item.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        images[i] = {samplers_[sampler_index(bound.sampler)], bindings[i].texture->view,
                     bindings[i].texture->rest_layout};
        break;
      case BindingKind::Image:
        item.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
        images[i] = {VK_NULL_HANDLE, bindings[i].texture->view, VK_IMAGE_LAYOUT_GENERAL};
        break;
    }
  }
  context_.vk.vkUpdateDescriptorSets(context_.device, static_cast<uint32_t>(bindings.size()), writes.data(), 0,
                                     nullptr);
}

void Descriptors::forget() {
  sets_.clear();
  stale_ = true;
}

void Descriptors::recycle() {
  if (!stale_ && set_count_ < kMostSets) return;
  for (VkDescriptorPool pool : pools_) context_.vk.vkResetDescriptorPool(context_.device, pool, 0);
  sets_.clear();
  current_pool_ = 0;
  set_count_ = 0;
  stale_ = false;
}

}  // namespace volumark::vulkan
