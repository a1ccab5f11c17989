// The subcommands of `volumark`: each adds itself to the parser and, when chosen, sets `action`.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "backends/device.h"
#include "scenes/scene.h"
#include "scenes/scene_io.h"

namespace volumark::cli {

enum ExitCode { kOk = 0, kBadNews = 1, kUsage = 2, kAmbiguous = 3, kInterrupted = 130 };

// What was asked cannot be done as asked: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Options before or after any subcommand.
struct Globals {
  DeviceOptions device;
  std::vector<std::string> data;
  bool require_backends = false;
  std::vector<std::string> argv;
  DataOptions data_options() const;
};

// One chosen subcommand; returns the exit code.
using Action = std::function<int()>;

void add_list(CLI::App& app, const Globals& globals, Action& action);
void add_render(CLI::App& app, const Globals& globals, Action& action);
void add_run(CLI::App& app, const Globals& globals, Action& action);
void add_report(CLI::App& app, const Globals& globals, Action& action);
void add_diff(CLI::App& app, const Globals& globals, Action& action);
void add_validate(CLI::App& app, const Globals& globals, Action& action);
void add_verify(CLI::App& app, const Globals& globals, Action& action);
void add_bench(CLI::App& app, const Globals& globals, Action& action);
void add_probe(CLI::App& app, const Globals& globals, Action& action);

// "name=value" or UsageError.
std::pair<std::string, std::string> split_assignment(const std::string& text);
// "640x480" or UsageError.
std::pair<int, int> parse_size(const std::string& text);
// make_device, with an unknown id as UsageError that names the nearest.
Device open_backend(const std::string& id, const Globals& globals);
void check_backend_name(const std::string& id);

}  // namespace volumark::cli
