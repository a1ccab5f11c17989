#include "scenes/data/byte_source.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "scenes/errors.h"
#include "scenes/volume_finish.h"

namespace volumark {

struct ByteSource::Inflate {
  z_stream stream{};
  bool ended = false;
  ~Inflate() { inflateEnd(&stream); }
};

ByteSource::ByteSource(std::span<const std::byte> file, bool gzip, std::string what)
    : rest_(file), what_(std::move(what)) {
  if (!gzip) return;
  inflate_ = std::make_unique<Inflate>();
  if (inflateInit2(&inflate_->stream, 15 + 16) != Z_OK) throw DataError(what_ + ": zlib cannot start");
}

ByteSource::~ByteSource() = default;

bool ByteSource::looks_gzipped(std::span<const std::byte> file) {
  return file.size() >= 2 && file[0] == std::byte{0x1f} && file[1] == std::byte{0x8b};
}

void ByteSource::limit(size_t count) { left_ = count; }

size_t ByteSource::read_some(std::byte* to, size_t count) {
  const size_t got = inflate_ ? inflate_some(to, std::min(count, left_)) : copy_some(to, std::min(count, left_));
  left_ -= got;
  return got;
}

size_t ByteSource::copy_some(std::byte* to, size_t count) {
  const size_t n = std::min(count, rest_.size());
  if (n > 0) std::memcpy(to, rest_.data(), n);
  rest_ = rest_.subspan(n);
  return n;
}

size_t ByteSource::inflate_some(std::byte* to, size_t count) {
  z_stream& z = inflate_->stream;
  size_t done = 0;
  while (done < count && !inflate_->ended) {
    const size_t in = std::min<size_t>(rest_.size(), 1 << 30), out = std::min<size_t>(count - done, 1 << 30);
    z.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(rest_.data()));
    z.avail_in = static_cast<uInt>(in);
    z.next_out = reinterpret_cast<Bytef*>(to + done);
    z.avail_out = static_cast<uInt>(out);
    const int result = inflate(&z, Z_NO_FLUSH);
    rest_ = rest_.subspan(in - z.avail_in);
    done += out - z.avail_out;
    if (result == Z_STREAM_END) {
      // A gzip file may have several members, one after the other.
      if (looks_gzipped(rest_) && inflateReset(&z) == Z_OK) continue;
      inflate_->ended = true;
    } else if (result == Z_BUF_ERROR || (result == Z_OK && rest_.empty() && z.avail_out > 0)) {
      throw DataError(fmt::format("{}: the gzip stream is truncated", what_));
    } else if (result != Z_OK) {
      throw DataError(
          fmt::format("{}: the gzip stream is damaged ({})", what_, z.msg != nullptr ? z.msg : "no reason given"));
    }
  }
  return done;
}

std::vector<std::byte> ByteSource::read_up_to(size_t count) {
  std::vector<std::byte> bytes;
  size_t chunk = inflate_ ? size_t{1} << 20 : std::min(count, rest_.size());
  while (bytes.size() < count && chunk > 0) {
    const size_t at = bytes.size(), wanted = std::min(chunk, count - at);
    bytes.resize(at + wanted);
    const size_t got = read_some(bytes.data() + at, wanted);
    bytes.resize(at + got);
    if (got < wanted) break;
    chunk = bytes.size();
  }
  return bytes;
}

void ByteSource::skip(size_t count) {
  std::byte buffer[4096];
  for (size_t left = count; left > 0;) {
    const size_t got = read_some(buffer, std::min(left, sizeof(buffer)));
    if (got == 0)
      throw DataError(fmt::format("{}: expected {} bytes before the samples, found {}", what_, count, count - left));
    left -= got;
  }
}

std::vector<std::byte> ByteSource::read_voxels(const glm::dvec3& size, VoxelType type, bool big_endian) {
  const size_t expected = checked_bytes(size, type, what_);
  const std::string wanted =
      fmt::format("{} x {} x {} samples of {}: expected {} bytes", size.x, size.y, size.z, to_string(type), expected);
  if (!inflate_ && std::min(rest_.size(), left_) != expected) {
    throw DataError(fmt::format("{}: {}, found {}", what_, wanted, std::min(rest_.size(), left_)));
  }
  std::vector<std::byte> voxels = read_up_to(expected);
  if (voxels.size() != expected) throw DataError(fmt::format("{}: {}, found {}", what_, wanted, voxels.size()));
  std::byte extra;
  if (read_some(&extra, 1) != 0) throw DataError(fmt::format("{}: {}, found more", what_, wanted));
  const size_t width = voxel_bytes(type);
  if (width > 1 && big_endian != (std::endian::native == std::endian::big)) {
    for (size_t i = 0; i < voxels.size(); i += width) std::reverse(voxels.data() + i, voxels.data() + i + width);
  }
  return voxels;
}

}  // namespace volumark
