// The bytes of a file in memory, plain or gzip-compressed, read from front to back. Memory grows with what is really
// there, never with what a header claims: a truncated file or a decompression bomb ends in a DataError.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scenes/volume.h"

namespace volumark {

class ByteSource {
 public:
  ByteSource(std::span<const std::byte> file, bool gzip, std::string what);
  ~ByteSource();
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  // The next `count` bytes; fewer only at the end of the file.
  std::vector<std::byte> read_up_to(size_t count);
  void skip(size_t count);   // throws at the end
  void limit(size_t count);  // from here on the file ends after so many bytes, as a file within an archive
  // All that is left must be the samples: another number of bytes is an error that states both. Host byte order.
  std::vector<std::byte> read_voxels(const glm::dvec3& size, VoxelType type, bool big_endian);

  static bool looks_gzipped(std::span<const std::byte> file);

 private:
  struct Inflate;
  size_t read_some(std::byte* to, size_t count);
  size_t copy_some(std::byte* to, size_t count);
  size_t inflate_some(std::byte* to, size_t count);
  std::span<const std::byte> rest_;
  std::unique_ptr<Inflate> inflate_;
  std::string what_;
  size_t left_ = std::numeric_limits<size_t>::max();  // bytes that limit() leaves
};

}  // namespace volumark
