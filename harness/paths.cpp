#include "harness/paths.h"

#include <unistd.h>

#include <climits>
#include <cstdlib>
#include <string>

namespace volumark {
namespace {

namespace fs = std::filesystem;

fs::path from_environment(const char* variable) {
  const char* value = std::getenv(variable);
  return value == nullptr ? fs::path() : fs::path(value);
}

}  // namespace

fs::path executable_folder() {
  char path[PATH_MAX];
  const ssize_t length = ::readlink("/proc/self/exe", path, sizeof path);
  return length > 0 ? fs::path(std::string(path, static_cast<size_t>(length))).parent_path() : fs::path();
}

std::vector<fs::path> library_folders() {
  const fs::path here = executable_folder();
  return {here, here / "../lib/volumark", VM_BUILD_DIRECTORY "/lib/volumark"};
}

fs::path experiment_directory() {
  if (fs::path folder = from_environment("VOLUMARK_EXPERIMENTS"); !folder.empty()) return folder;
  const fs::path installed = executable_folder() / "../share/volumark/experiments";
  return fs::exists(installed) ? installed.lexically_normal() : fs::path(VM_SOURCE_DIRECTORY "/harness/experiments");
}

fs::path cache_directory() {
  if (fs::path folder = from_environment("VOLUMARK_CACHE"); !folder.empty()) return folder;
  if (const fs::path folder = from_environment("XDG_CACHE_HOME"); !folder.empty()) return folder / "volumark";
  if (const fs::path folder = from_environment("HOME"); !folder.empty()) return folder / ".cache/volumark";
  return fs::temp_directory_path() / "volumark-cache";
}

}  // namespace volumark
