// Voxels without a header: the layout is stated in the scene.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "scenes/volume.h"
#include "scenes/volume_finish.h"

namespace volumark {

struct RawLayout {
  glm::ivec3 size{0};
  VoxelType type = VoxelType::U8;
  bool big_endian = false;
  size_t header_bytes = 0;  // skipped, after decompression
  bool gzip = false;
  std::string member{};       // the samples are this file of a tar archive; empty: no archive
  bool signed_bytes = false;  // of U8: bytes are -128 to 127
};

// Spacing 1, centred at the world's origin. Throws DataError.
Volume read_raw(std::span<const std::byte> file, const RawLayout& layout, NonFinite non_finite,
                const std::string& what);

}  // namespace volumark
