// NIfTI-1 files in one piece (https://nifti.nimh.nih.gov/nifti-1): .nii, plain or gzip, either byte order; types uint8,
// uint16, int16, float32; three dimensions. World space is the file's RAS space: sform, else qform, else pixdim alone
// (centred at the origin). scl_slope and scl_inter become Volume::slope and intercept.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "scenes/volume.h"
#include "scenes/volume_finish.h"

namespace volumark {

Volume read_nifti(std::span<const std::byte> file, NonFinite non_finite, const std::string& what);

}  // namespace volumark
