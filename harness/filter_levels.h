// How finely a driver filters: between two neighbouring texels 0 and 1 of a 3D texture, the distinct values that linear
// filtering meets at 4096 evenly spread places. About 256 means weights of 8 bits: an error of up to 1/255 of the
// texture's range that no smaller step takes away. Exact filtering meets 4096.
#pragma once

#include <map>
#include <string>

#include "backends/device.h"

namespace volumark {

inline constexpr int kFilterPlaces = 4096;
inline constexpr double kCoarseFilterLevels = 300;  // at most so many: the filter is what limits

// Texture format ("r8", "r16", "r16f", "r32f") -> distinct values, 1..4096. A format that the backend refuses is left
// out. Throws DeviceError where the device cannot draw at all. Leaves nothing alive on the device.
std::map<std::string, double> measure_filter_levels(Device& device);

}  // namespace volumark
