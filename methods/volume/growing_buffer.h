// A buffer for what a method uploads every frame. What it grew out of stays alive until the end: draws recorded before
// may still read it. Dies before the Device.
#pragma once

#include <algorithm>
#include <vector>

#include "backends/device.h"

namespace volumark {

class GrowingBuffer {
 public:
  GrowingBuffer(Device& device, const char* label) : device_(device), label_(label) {}
  ~GrowingBuffer() {
    for (const Buffer buffer : buffers_) device_.destroy(buffer);
  }
  GrowingBuffer(const GrowingBuffer&) = delete;
  GrowingBuffer& operator=(const GrowingBuffer&) = delete;

  Buffer upload(std::span<const std::byte> data) {
    if (data.size() > size_) {
      size_ = std::max(data.size(), size_ + size_ / 2);
      buffers_.push_back(device_.create_buffer({label_, size_, {}}));
    }
    device_.update_buffer(buffers_.back(), 0, data);
    return buffers_.back();
  }

 private:
  Device& device_;
  const char* label_;
  size_t size_ = 0;
  std::vector<Buffer> buffers_;
};

}  // namespace volumark
