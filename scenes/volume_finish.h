// The last step of every loader: looks at all samples once.
#pragma once

#include <string>

#include "scenes/volume.h"

namespace volumark {

// What to do with NaN and infinite samples: refuse the file (DataError with their number and the first position), or
// replace them by a stored 0.
enum class NonFinite { Refuse, Zero };

// Voxels that were read as U8 but are signed: the same data values from unsigned bytes, so that nothing else need know
// of signed ones. To be called once, before finish_volume.
void from_signed_bytes(Volume& volume);

// Sets min_value and max_value. The voxels must be complete. `what` names the file in errors.
void finish_volume(Volume& volume, NonFinite non_finite, const std::string& what);

// Throws DataError where a side is below 1 or the volume is beyond what is sensible to hold (64 GiB); returns its
// bytes.
size_t checked_bytes(const glm::dvec3& size, VoxelType type, const std::string& what);

}  // namespace volumark
