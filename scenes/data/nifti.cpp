#include "scenes/data/nifti.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "scenes/data/byte_source.h"
#include "scenes/data/orientation.h"
#include "scenes/errors.h"

namespace volumark {
namespace {

constexpr size_t kHeaderBytes = 348;

// The header's fields by their offsets in nifti1.h, in the file's byte order.
class Header {
 public:
  Header(std::vector<std::byte> bytes, const std::string& what) : bytes_(std::move(bytes)) {
    if (bytes_.size() < kHeaderBytes) {
      throw DataError(
          fmt::format("{}: expected a NIfTI-1 header of {} bytes, found {}", what, kHeaderBytes, bytes_.size()));
    }
    if (get<int32_t>(0) != 348) {
      swapped_ = true;
      if (get<int32_t>(0) != 348) throw DataError(what + ": not a NIfTI-1 file (the header's size is not 348)");
    }
    if (std::memcmp(bytes_.data() + 344, "ni1", 4) == 0) {
      throw DataError(what + ": a NIfTI-1 pair (.hdr and .img); only files in one piece (.nii) are supported");
    }
    if (std::memcmp(bytes_.data() + 344, "n+1", 4) != 0) throw DataError(what + ": not a NIfTI-1 file (wrong magic)");
  }

  template <typename T>
  T get(size_t offset) const {
    std::byte raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + offset, sizeof(T));
    if (swapped_) std::reverse(raw, raw + sizeof(T));
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }
  double real(size_t offset) const { return static_cast<double>(get<float>(offset)); }
  bool big_endian() const { return swapped_ == (std::endian::native == std::endian::little); }

 private:
  std::vector<std::byte> bytes_;
  bool swapped_ = false;
};

glm::ivec3 size_of(const Header& header, const std::string& what) {
  const int dimensions = header.get<int16_t>(40);
  if (dimensions < 1 || dimensions > 7) {
    throw DataError(fmt::format("{}: expected 1 to 7 dimensions, found {}", what, dimensions));
  }
  glm::ivec3 size(1);
  for (int d = 0; d < dimensions; ++d) {
    const int n = header.get<int16_t>(42 + 2 * static_cast<size_t>(d));
    if (d < 3) {
      size[d] = n;
    } else if (n > 1) {
      throw DataError(fmt::format(
          "{}: dimension {} has {} entries; only single volumes of three dimensions are supported", what, d + 1, n));
    }
  }
  return size;
}

constexpr int kSignedBytes = 256;  // DT_INT8

VoxelType type_of(const Header& header, const std::string& what) {
  const int code = header.get<int16_t>(70);
  switch (code) {
    case 2:
    case kSignedBytes:
      return VoxelType::U8;
    case 4:
      return VoxelType::I16;
    case 16:
      return VoxelType::F32;
    case 512:
      return VoxelType::U16;
    default:
      throw DataError(
          fmt::format("{}: data type {} is not supported; expected 2 (uint8), 256 (int8), 4 (int16), 512 "
                      "(uint16) or 16 (float32)",
                      what, code));
  }
}

// nifti1.h, method 2: the quaternion (a, b, c, d) with a >= 0 from b, c, d; the third column turned by qfac.
glm::dmat3 rotation_of(const Header& header) {
  double b = header.real(256), c = header.real(260), d = header.real(264);
  double a = 1 - (b * b + c * c + d * d);
  if (a < 1e-7) {
    const double length = std::sqrt(b * b + c * c + d * d);
    b /= length, c /= length, d /= length;
    a = 0;
  } else {
    a = std::sqrt(a);
  }
  const double qfac = header.real(76) < 0 ? -1 : 1;
  return {glm::dvec3(a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)),
          glm::dvec3(2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)),
          glm::dvec3(2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - b * b - c * c) * qfac};
}

// Sizes of unused axes may be 0 in the file.
glm::dvec3 pixel_size(const Header& header, const glm::ivec3& size) {
  glm::dvec3 p(header.real(80), header.real(84), header.real(88));
  for (int axis = 0; axis < 3; ++axis) {
    if (size[axis] == 1 && p[axis] == 0) p[axis] = 1;
    p[axis] = std::abs(p[axis]);
  }
  return p;
}

glm::dvec3 finite(const glm::dvec3& v, const char* name, const std::string& what) {
  if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
    throw DataError(fmt::format("{}: {} is not finite", what, name));
  }
  return v;
}

void orient(Volume& volume, const Header& header, const std::string& what) {
  if (header.get<int16_t>(254) > 0) {
    glm::dmat3 steps(1);
    for (int row = 0; row < 3; ++row) {
      const size_t at = 280 + 16 * static_cast<size_t>(row);
      for (int column = 0; column < 3; ++column) steps[column][row] = header.real(at + 4 * static_cast<size_t>(column));
      volume.origin[row] = header.real(at + 12);
    }
    set_steps(volume, steps, what);
    finite(volume.origin, "the offset of the sform", what);
    return;
  }
  const glm::dvec3 p = pixel_size(header, volume.size);
  glm::dmat3 steps(1);
  const bool quaternion = header.get<int16_t>(252) > 0;
  if (quaternion) steps = rotation_of(header);
  for (int axis = 0; axis < 3; ++axis) steps[axis] *= p[axis];
  set_steps(volume, steps, what);
  if (quaternion) {
    volume.origin = finite({header.real(268), header.real(272), header.real(276)}, "the offset of the qform", what);
  } else {
    centre_at_origin(volume);
  }
}

}  // namespace

Volume read_nifti(std::span<const std::byte> file, NonFinite non_finite, const std::string& what) {
  ByteSource source(file, ByteSource::looks_gzipped(file), what);
  const Header header(source.read_up_to(kHeaderBytes), what);
  Volume volume;
  volume.size = size_of(header, what);
  volume.type = type_of(header, what);
  checked_bytes(volume.size, volume.type, what);
  const double slope = header.real(112), intercept = header.real(116);
  if (slope != 0) {  // 0: no scaling
    if (!std::isfinite(slope) || !std::isfinite(intercept)) {
      throw DataError(fmt::format("{}: scl_slope {} and scl_inter {} must be finite", what, slope, intercept));
    }
    volume.slope = slope;
    volume.intercept = intercept;
  }
  orient(volume, header, what);
  const double offset = header.real(108);
  if (!(offset >= 352) || !(offset < 1e9)) {
    throw DataError(fmt::format("{}: vox_offset is {}; expected at least 352", what, offset));
  }
  source.skip(static_cast<size_t>(offset) - kHeaderBytes);
  volume.voxels = source.read_voxels(volume.size, volume.type, header.big_endian());
  if (header.get<int16_t>(70) == kSignedBytes) from_signed_bytes(volume);
  finish_volume(volume, non_finite, what);
  return volume;
}

}  // namespace volumark
