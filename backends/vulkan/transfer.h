// Uploads and read-backs that take place at once, outside the recorded work: first contents, and what the host reads.
// Everything goes through one staging buffer of at most kStagingBytes, slab by slab, so that moving a volume costs no
// second copy of it.
#pragma once

#include <memory>

#include "backends/vulkan/commands.h"
#include "backends/vulkan/resources.h"

namespace volumark::vulkan {

class Transfer {
 public:
  static constexpr size_t kStagingBytes = 4 << 20;

  explicit Transfer(const Context& context);

  // First contents; empty data: zero. The texture is left in its rest layout.
  void fill(GpuTexture& texture, std::span<const std::byte> data);
  void fill(GpuBuffer& buffer, std::span<const std::byte> data);
  // No recorded work may be pending.
  void read(GpuTexture& texture, std::span<std::byte> out);
  void read(GpuBuffer& buffer, size_t offset, std::span<std::byte> out);

 private:
  GpuBuffer& staging(size_t bytes, std::string_view call, std::string_view label);

  const Context& context_;
  Commands commands_;
  std::unique_ptr<GpuBuffer> staging_;
};

}  // namespace volumark::vulkan
