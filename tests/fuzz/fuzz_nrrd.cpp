// NRRD bytes: a Volume, or a DataError; nothing else may happen.
#include <cstdint>
#include <cstdlib>

#include "scenes/data/nrrd.h"
#include "scenes/errors.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace volumark;
  const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
  try {
    const auto beside = [&](const std::string&) { return std::vector<std::byte>(64); };
    const Volume volume = read_nrrd(bytes, beside, NonFinite::Zero, "fuzz");
    const auto n =
        static_cast<size_t>(volume.size.x) * static_cast<size_t>(volume.size.y) * static_cast<size_t>(volume.size.z);
    // What was accepted is complete and has a place in the world.
    if (volume.voxels.size() != n * voxel_bytes(volume.type)) std::abort();
    if (!(volume.min_value <= volume.max_value)) std::abort();
    for (int axis = 0; axis < 3; ++axis) {
      if (!(volume.spacing[axis] > 0)) std::abort();
    }
  } catch (const DataError&) {
  }
  return 0;
}
