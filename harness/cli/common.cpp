#include <fmt/format.h>

#include <algorithm>

#include "harness/cli/commands.h"
#include "scenes/nearest.h"

namespace volumark::cli {

DataOptions Globals::data_options() const {
  DataOptions options = data_options_from_environment();
  options.directories.insert(options.directories.begin(), data.begin(), data.end());
  for (const std::string& folder : data)
    if (!std::filesystem::is_directory(folder)) throw UsageError(fmt::format("--data {}: no such folder", folder));
  return options;
}

std::pair<std::string, std::string> split_assignment(const std::string& text) {
  const size_t at = text.find('=');
  if (at == std::string::npos || at == 0) throw UsageError(fmt::format("expected name=value, found \"{}\"", text));
  return {text.substr(0, at), text.substr(at + 1)};
}

std::pair<int, int> parse_size(const std::string& text) {
  int width = 0, height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 1 || height < 1 || width > 16384 ||
      height > 16384)
    throw UsageError(fmt::format("--size: expected WIDTHxHEIGHT of 1 to 16384 pixels each, found \"{}\"", text));
  return {width, height};
}

void check_backend_name(const std::string& id) {
  std::vector<std::string> names;
  for (const BackendEntry& entry : backend_list()) names.emplace_back(entry.id);
  if (std::find(names.begin(), names.end(), id) == names.end())
    throw UsageError(
        fmt::format("unknown backend \"{}\"{}; known: {}", id, did_you_mean(id, names), fmt::join(names, ", ")));
}

Device open_backend(const std::string& id, const Globals& globals) {
  check_backend_name(id);
  return make_device(id, globals.device);
}

}  // namespace volumark::cli
