// A data file of any known format -> Volume.
#pragma once

#include <filesystem>
#include <span>

#include "scenes/scene_plan.h"

namespace volumark {

// The whole file in memory. DataError where it cannot be read.
std::vector<std::byte> read_file_bytes(const std::filesystem::path& path);

// By the scene's "raw" layout, else by the file's name (.nrrd, .nhdr, .nii, .nii.gz). The spacing, origin and axes of
// the scene replace those of the file. `path` is used for the voxel file of a detached header.
Volume read_volume(const FileSpec& spec, std::span<const std::byte> bytes, const std::filesystem::path& path);

}  // namespace volumark
