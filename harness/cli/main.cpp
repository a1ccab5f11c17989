// volumark: the command line. One file a subcommand; this one reads the common options and turns errors into exit
// codes.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "harness/cli/commands.h"
#include "harness/environment.h"
#include "harness/image_io.h"
#include "harness/metrics/metrics.h"
#include "harness/run_folder.h"
#include "methods/parameters.h"
#include "scenes/errors.h"

namespace volumark::cli {
namespace {

void add_globals(CLI::App& app, Globals& globals) {
  app.add_option("--gl-platform", globals.device.gl_platform, "osmesa (software) or egl (the GPU's driver)")
      ->check(CLI::IsMember({"osmesa", "egl"}))
      ->capture_default_str();
  app.add_option("--vk-device", globals.device.vk_device,
                 "Vulkan device: index or part of its name (default: lavapipe)");
  app.add_option("--threads", globals.device.threads, "worker threads of software backends; 0: all")
      ->check(CLI::Range(0, 1024));
  app.add_option("--data", globals.data, "folder with data files (also VOLUMARK_DATA)");
  app.add_flag("--validation", globals.device.validation, "Vulkan validation layers: any message fails the cell");
  app.add_flag("--require-backends", globals.require_backends, "a backend that cannot be opened is a failure");
}

// llvmpipe and lavapipe read their thread count from the environment, once a process.
void apply_threads(const Globals& globals) {
  if (globals.device.threads > 0)
    ::setenv("LP_NUM_THREADS", globals.device.threads == 1 ? "0" : std::to_string(globals.device.threads).c_str(), 1);
}

int run_action(const Action& action) {
  const auto usage = [](const std::exception& error) {
    fmt::print(stderr, "volumark: {}\n", error.what());
    return static_cast<int>(kUsage);
  };
  try {
    return action();
  } catch (const UsageError& error) {
    return usage(error);
  } catch (const ParameterError& error) {
    return usage(error);
  } catch (const SceneError& error) {
    return usage(error);
  } catch (const DataMissing& error) {
    fmt::print(stderr, "volumark: {}\nto get it: {}\n", error.what(), error.how_to_get);
    return kUsage;
  } catch (const ResultsError& error) {
    return usage(error);
  } catch (const FolderError& error) {
    return usage(error);
  } catch (const ImageError& error) {
    return usage(error);
  } catch (const MetricError& error) {
    return usage(error);
  } catch (const std::invalid_argument& error) {
    return usage(error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "volumark: {}\n", error.what());
    return kBadNews;
  }
}

int parse_and_run(int argc, char** argv) {
  CLI::App app("volumark: how fast, and how right, does a method draw a volume here?");
  app.footer(
      "Example: volumark run quick --out out/quick && volumark report out/quick\n"
      "Exit codes: 0 ok, 1 bad news (wrong image, failure, regression), 2 usage or data error, 3 ambiguous, 130 "
      "interrupted");
  app.require_subcommand(1);
  app.fallthrough();
  app.set_version_flag("--version", version_line());
  Globals globals;
  globals.argv.assign(argv, argv + argc);
  add_globals(app, globals);
  Action action;
  add_list(app, globals, action);
  add_render(app, globals, action);
  add_run(app, globals, action);
  add_report(app, globals, action);
  add_diff(app, globals, action);
  add_validate(app, globals, action);
  add_verify(app, globals, action);
  add_bench(app, globals, action);
  add_probe(app, globals, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kOk : kUsage;
  }
  apply_threads(globals);
  return run_action(action);
}

}  // namespace
}  // namespace volumark::cli

int main(int argc, char** argv) { return volumark::cli::parse_and_run(argc, argv); }
