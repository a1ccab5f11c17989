#include "scenes/volume_finish.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "scenes/errors.h"

namespace volumark {
namespace {

constexpr double kMaxBytes = 64.0 * 1024 * 1024 * 1024;

template <typename T>
void find_range(Volume& volume, NonFinite non_finite, const std::string& what) {
  const size_t n = volume.voxels.size() / sizeof(T);
  T lo = std::numeric_limits<T>::max(), hi = std::numeric_limits<T>::lowest();
  size_t bad = 0, first_bad = 0;
  for (size_t i = 0; i < n; ++i) {
    std::byte* const at = volume.voxels.data() + i * sizeof(T);
    T value;
    std::memcpy(&value, at, sizeof(T));
    if constexpr (std::is_floating_point_v<T>) {
      if (!std::isfinite(value)) {
        if (bad++ == 0) first_bad = i;
        value = 0;
        std::memcpy(at, &value, sizeof(T));
      }
    }
    lo = std::min(lo, value);
    hi = std::max(hi, value);
  }
  if (bad > 0 && non_finite == NonFinite::Refuse) {
    const auto x = static_cast<size_t>(volume.size.x), y = static_cast<size_t>(volume.size.y);
    throw DataError(
        fmt::format("{}: {} of {} samples are NaN or infinite, the first at ({}, {}, {}); "
                    "\"non_finite\": \"zero\" in the scene's volume replaces them by 0",
                    what, bad, n, first_bad % x, first_bad / x % y, first_bad / (x * y)));
  }
  const double a = static_cast<double>(lo) * volume.slope + volume.intercept;
  const double b = static_cast<double>(hi) * volume.slope + volume.intercept;
  volume.min_value = std::min(a, b);
  volume.max_value = std::max(a, b);
}

}  // namespace

void from_signed_bytes(Volume& volume) {
  for (std::byte& voxel : volume.voxels) voxel ^= std::byte{0x80};  // stored + 128, in two's complement
  volume.intercept -= 128 * volume.slope;
}

void finish_volume(Volume& volume, NonFinite non_finite, const std::string& what) {
  switch (volume.type) {
    case VoxelType::U8:
      return find_range<uint8_t>(volume, non_finite, what);
    case VoxelType::U16:
      return find_range<uint16_t>(volume, non_finite, what);
    case VoxelType::I16:
      return find_range<int16_t>(volume, non_finite, what);
    case VoxelType::F32:
      return find_range<float>(volume, non_finite, what);
  }
}

size_t checked_bytes(const glm::dvec3& size, VoxelType type, const std::string& what) {
  const std::string text = fmt::format("{} x {} x {}", size.x, size.y, size.z);
  if (!(size.x >= 1 && size.y >= 1 && size.z >= 1)) {
    throw DataError(fmt::format("{}: size {}: every side must be at least 1", what, text));
  }
  const double bytes = size.x * size.y * size.z * static_cast<double>(voxel_bytes(type));
  if (!(bytes <= kMaxBytes) || !(std::max({size.x, size.y, size.z}) <= 1 << 20)) {
    throw DataError(fmt::format("{}: size {} of {}: at most 64 GiB and 1048576 samples a side can be loaded", what,
                                text, to_string(type)));
  }
  return static_cast<size_t>(bytes);
}

}  // namespace volumark
