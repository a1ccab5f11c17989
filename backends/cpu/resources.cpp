#include "backends/cpu/resources.h"

#include <unistd.h>

#include <cstring>
#include <new>

namespace volumark {

void MemoryBudget::take(size_t bytes) {
  const size_t before = used_.fetch_add(bytes);
  if (before > limit_ || bytes > limit_ - before) {
    used_ -= bytes;
    throw std::bad_alloc();
  }
}

size_t physical_memory_bytes() {
  return static_cast<size_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<size_t>(sysconf(_SC_PAGE_SIZE));
}

Block::Block(size_t size, std::shared_ptr<MemoryBudget> budget) : size_(size), budget_(std::move(budget)) {
  if (size > SIZE_MAX - 2 * kReadableTail) {
    throw std::bad_alloc();
  }
  const size_t bytes = (size + kReadableTail + 63) / 64 * 64;
  budget_->take(bytes);
  try {
    data_ = static_cast<std::byte*>(::operator new (bytes, std::align_val_t{64}));
  } catch (...) {
    budget_->give(bytes);
    throw;
  }
  std::memset(data_, 0, bytes);
}

Block::~Block() {
  ::operator delete (data_, std::align_val_t{64});
  budget_->give((size_ + kReadableTail + 63) / 64 * 64);
}

TextureStorage::TextureStorage(const TextureDesc& desc, const std::shared_ptr<MemoryBudget>& budget)
    : format_(desc.format),
      dimension_(desc.dimension),
      width_(desc.width),
      height_(desc.height),
      depth_(desc.depth),
      row_stride_(width_ + 1) {
  if (is_depth_stencil(format_)) {
    const size_t pixels = static_cast<size_t>(width_) * static_cast<size_t>(height_);
    block_ = std::make_unique<Block>(pixels * sizeof(float), budget);
    stencil_ = std::make_unique<Block>(pixels, budget);
    row_stride_ = width_;
  } else {
    slice_stride_ = row_stride_ * (dimension_ > 1 ? height_ + 1 : 1);
    const ptrdiff_t texels = slice_stride_ * (dimension_ > 2 ? depth_ + 1 : 1);
    if (texels > INT32_MAX) {
      throw std::bad_alloc();  // the samplers count texels in 32 bits
    }
    block_ = std::make_unique<Block>(static_cast<size_t>(texels) * texel_bytes(format_), budget);
  }
  if (!desc.data.empty()) {
    upload(desc.data);
  }
}

void TextureStorage::upload(std::span<const std::byte> data) {
  const std::byte* in = data.data();
  if (is_depth_stencil(format_)) {
    const size_t pixels = static_cast<size_t>(width_) * static_cast<size_t>(height_);
    for (size_t i = 0; i < pixels; ++i, in += 8) {
      std::memcpy(depth_plane() + i, in, sizeof(float));
      uint32_t stencil = 0;
      std::memcpy(&stencil, in + 4, sizeof(stencil));
      stencil_plane()[i] = static_cast<uint8_t>(stencil);
    }
    return;
  }
  const size_t texel = texel_bytes(format_);
  const size_t row = static_cast<size_t>(width_) * texel;
  for (int z = 0; z < depth_; ++z) {
    for (int y = 0; y < height_; ++y, in += row) {
      std::memcpy(texels() + static_cast<size_t>(z * slice_stride_ + y * row_stride_) * texel, in, row);
    }
  }
  pad();
}

// The texel after a row, the row after a slice and the slice after the last repeat the edge.
void TextureStorage::pad() {
  const size_t texel = texel_bytes(format_);
  const auto at = [&](ptrdiff_t index) { return texels() + static_cast<size_t>(index) * texel; };
  for (int z = 0; z < depth_; ++z) {
    for (int y = 0; y < height_; ++y) {
      const ptrdiff_t end = z * slice_stride_ + y * row_stride_ + width_;
      std::memcpy(at(end), at(end - 1), texel);
    }
    if (dimension_ > 1) {
      const ptrdiff_t last = z * slice_stride_ + (height_ - 1) * row_stride_;
      std::memcpy(at(last + row_stride_), at(last), static_cast<size_t>(row_stride_) * texel);
    }
  }
  if (dimension_ > 2) {
    const ptrdiff_t last = (depth_ - 1) * slice_stride_;
    std::memcpy(at(last + slice_stride_), at(last), static_cast<size_t>(slice_stride_) * texel);
  }
  padding_stale_ = false;
}

void TextureStorage::refresh_padding() {
  if (padding_stale_ && !is_depth_stencil(format_)) {
    pad();
  }
}

CpuTexture TextureStorage::view(const Sampler& sampler) const {
  CpuTexture texture;
  texture.data = texels();
  texture.writable = texels();
  texture.format = format_;
  texture.dimension = dimension_;
  texture.width = width_;
  texture.height = height_;
  texture.depth = depth_;
  texture.row_stride = row_stride_;
  texture.slice_stride = slice_stride_;
  texture.sampler = sampler;
  return texture;
}

void TextureStorage::read(std::span<std::byte> out) const {
  std::byte* to = out.data();
  if (is_depth_stencil(format_)) {
    const size_t pixels = static_cast<size_t>(width_) * static_cast<size_t>(height_);
    for (size_t i = 0; i < pixels; ++i, to += 8) {
      std::memcpy(to, depth_plane() + i, sizeof(float));
      const uint32_t stencil = stencil_plane()[i];
      std::memcpy(to + 4, &stencil, sizeof(stencil));
    }
    return;
  }
  const size_t texel = texel_bytes(format_);
  const size_t row = static_cast<size_t>(width_) * texel;
  for (int z = 0; z < depth_; ++z) {
    for (int y = 0; y < height_; ++y, to += row) {
      std::memcpy(to, texels() + static_cast<size_t>(z * slice_stride_ + y * row_stride_) * texel, row);
    }
  }
}

}  // namespace volumark
