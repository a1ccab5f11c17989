// Memory of the cpu backend: cache-aligned blocks counted against a budget, and textures padded by one texel on every
// axis so that the samplers of sample-inl.h may read the upper neighbour without a test.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "backends/cpu/cpu_program.h"

namespace volumark {

// Bytes in use by one backend, and the most it may use. Throws std::bad_alloc above that: the kernel would hand out
// memory that is not there, and end the process later.
class MemoryBudget {
 public:
  explicit MemoryBudget(size_t limit) : limit_(limit) {}
  void take(size_t bytes);
  void give(size_t bytes) { used_ -= bytes; }

 private:
  size_t limit_;
  std::atomic<size_t> used_{0};
};
size_t physical_memory_bytes();

// A zeroed block, 64-byte aligned, with kReadableTail bytes after its end.
class Block {
 public:
  static constexpr size_t kReadableTail = 64;
  Block(size_t size, std::shared_ptr<MemoryBudget> budget);
  ~Block();
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;
  std::byte* data() const { return data_; }
  size_t size() const { return size_; }

 private:
  std::byte* data_ = nullptr;
  size_t size_ = 0;
  std::shared_ptr<MemoryBudget> budget_;
};

class TextureStorage {
 public:
  TextureStorage(const TextureDesc& desc, const std::shared_ptr<MemoryBudget>& budget);

  Format format() const { return format_; }
  int width() const { return width_; }
  int height() const { return height_; }
  ptrdiff_t row_stride() const { return row_stride_; }
  // Colour texels; the caller that writes them says so with mark_written().
  std::byte* texels() const { return block_->data(); }
  // D32FS8: two tight planes.
  float* depth_plane() const { return reinterpret_cast<float*>(block_->data()); }
  uint8_t* stencil_plane() const {
    return stencil_ == nullptr ? nullptr : reinterpret_cast<uint8_t*>(stencil_->data());
  }

  CpuTexture view(const Sampler& sampler) const;
  void mark_written() { padding_stale_ = true; }
  void refresh_padding();  // no work unless written to
  void read(std::span<std::byte> out) const;

 private:
  void upload(std::span<const std::byte> data);
  void pad();

  Format format_;
  int dimension_, width_, height_, depth_;
  ptrdiff_t row_stride_ = 0, slice_stride_ = 0;  // texels
  std::unique_ptr<Block> block_, stencil_;
  bool padding_stale_ = false;
};

}  // namespace volumark
