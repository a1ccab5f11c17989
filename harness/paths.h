// Where the program finds what was installed with it, and where it keeps what it may lose.
#pragma once

#include <filesystem>
#include <vector>

namespace volumark {

std::filesystem::path executable_folder();

// Modules: beside the executable, in ../lib/volumark of it, then in the build tree.
std::vector<std::filesystem::path> library_folders();

// Shipped experiments: VOLUMARK_EXPERIMENTS, else ../share/volumark/experiments of the executable, else the source
// tree.
std::filesystem::path experiment_directory();

// VOLUMARK_CACHE, else XDG_CACHE_HOME/volumark, else HOME/.cache/volumark, else a folder in the temporary directory.
std::filesystem::path cache_directory();

}  // namespace volumark
