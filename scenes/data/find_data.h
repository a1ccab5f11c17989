// Finds the data file of a scene on this machine.
#pragma once

#include <filesystem>

#include "scenes/scene_io.h"
#include "scenes/scene_plan.h"

namespace volumark {

// In this order: beside the scene file (or an absolute path); options.directories, by file name or by size and
// checksum; where the Debian package installs it; options.cache. A file with another checksum than the scene states is
// passed over; DataError where there is no other, DataMissing where there is none at all.
std::filesystem::path find_data(const FileSpec& spec, const std::filesystem::path& scene_file,
                                const DataOptions& options);

// Checksum of a file; remembered within the process by path, size and time of change.
std::string file_sha256(const std::filesystem::path& path);

// Whether its package is one of npm's.
bool is_npm(const FileSpec& spec);

// One line: how to get the file.
std::string how_to_get(const FileSpec& spec);

}  // namespace volumark
