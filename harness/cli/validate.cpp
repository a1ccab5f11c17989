// volumark validate: is this a results file as its schema says?
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "harness/cli/commands.h"
#include "reports/results.h"
#include "scenes/json_reader.h"

namespace volumark::cli {
namespace {

int validate(const std::string& path) {
  const std::filesystem::path file =
      std::filesystem::is_directory(path) ? std::filesystem::path(path) / "results.json" : std::filesystem::path(path);
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw UsageError(file.string() + ": cannot be read: no such file, or no permission");
  const nlohmann::json json = parse_json(std::string(std::istreambuf_iterator<char>(stream), {}), file.string());
  const std::vector<SchemaFault> faults = validate_results(json);
  constexpr size_t kMost = 50;
  for (size_t i = 0; i < std::min(faults.size(), kMost); ++i)
    fmt::print(stderr, "{}: {}: {}\n", file.string(), faults[i].pointer, faults[i].message);
  if (faults.size() > kMost) fmt::print(stderr, "... and {} more\n", faults.size() - kMost);
  if (!faults.empty()) return kBadNews;
  fmt::print("{}: valid, {} results\n", file.string(), json["results"].size());
  return kOk;
}

}  // namespace

void add_validate(CLI::App& app, const Globals&, Action& action) {
  auto path = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("validate", "Check a results file against its schema");
  command->add_option("results", *path, "a run's folder, or results.json")->required();
  command->footer("Example: volumark validate out/quick/results.json");
  command->callback([&action, path] { action = [path] { return validate(*path); }; });
}

}  // namespace volumark::cli
