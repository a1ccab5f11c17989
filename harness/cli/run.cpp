// volumark run: experiments into a folder.
#include <fmt/format.h>

#include <csignal>

#include "harness/cli/commands.h"
#include "harness/effect_variants.h"
#include "harness/paths.h"
#include "harness/resume.h"
#include "harness/run_folder.h"
#include "harness/runner.h"
#include "harness/verify/verify.h"
#include "reports/tables.h"

namespace volumark::cli {
namespace {

struct RunArguments {
  RunOptions options;
  std::string out;
  std::vector<std::string> only, sweeps;
  bool no_images = false, no_reference = false, verify = false;
};

std::atomic<bool> stop_asked{false};

extern "C" void on_signal(int) {
  if (stop_asked.exchange(true)) std::_Exit(kInterrupted);  // asked twice: at once; the journal has what was finished
}

// The stability suite on the run's backends and methods; its rows go into the run's results.
void add_verification(const RunOptions& options, RunOutcome& outcome) {
  VerifyOptions wanted;
  wanted.backends = options.filter.backends;
  wanted.methods = options.filter.methods;
  wanted.device = options.cell.device;
  wanted.require_backends = options.cell.require_backends;
  wanted.data = options.data;
  wanted.stop = &stop_asked;
  if (options.images) wanted.out = options.out;
  RunFolder folder(options.out);
  VerifyOutcome found = verify(wanted, [](const std::string& line) { fmt::print("{}\n", line); });
  fmt::print("{}\n", verify_summary(found));
  if (verify_failed(found)) outcome.bad_news.push_back("stability: " + verify_summary(found));
  outcome.interrupted = outcome.interrupted || found.interrupted;
  if (found.interrupted) {  // a part of the suite must not read as the whole of it
    outcome.results.run.interrupted = true;
    outcome.results.run.finished_at.clear();
  }
  outcome.results.hard_cases = std::move(found.rows);
  outcome.results.sensitivity = std::move(found.sensitivity);
  folder.save(outcome.results, true);
}

int run(const RunArguments& arguments, const Globals& globals) {
  RunOptions options = arguments.options;
  for (const std::string& text : arguments.only) options.filter.only.push_back(split_assignment(text));
  for (const std::string& text : arguments.sweeps) options.sweeps.push_back(parse_sweep(text));
  for (const std::string& backend : options.filter.backends) check_backend_name(backend);
  for (std::string& variant : options.filter.variants) variant = variant_from_word(variant);
  options.out = arguments.out.empty() ? "out/" + std::filesystem::path(options.experiments.front()).stem().string()
                                      : arguments.out;
  options.cache = cache_directory() / "references";
  options.images = !arguments.no_images;
  options.references = !arguments.no_reference;
  options.data = globals.data_options();
  options.cell.device = globals.device;
  options.cell.require_backends = globals.require_backends;
  options.cell.stop = &stop_asked;
  options.argv = globals.argv;
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  RunOutcome outcome = run_experiments(options);
  if (arguments.verify && !outcome.interrupted) add_verification(options, outcome);
  if (outcome.skipped > 0) fmt::print("{} cells were measured before\n", outcome.skipped);
  fmt::print("\n{}\n", tables_text(outcome.results));
  for (const std::string& line : outcome.bad_news) fmt::print("{}\n", line);
  fmt::print("{}\n", (options.out / "results.json").string());
  if (outcome.interrupted) {
    fmt::print("interrupted; go on with: {}\n", resume_command(options.argv));
    return kInterrupted;
  }
  return outcome.bad_news.empty() ? kOk : kBadNews;
}

}  // namespace

void add_run(CLI::App& app, const Globals& globals, Action& action) {
  auto arguments = std::make_shared<RunArguments>();
  RunOptions& options = arguments->options;
  CLI::App* command = app.add_subcommand("run", "Run experiments: every cell measured, compared and written down");
  command->add_option("experiment", options.experiments, "names (volumark list experiments), or .json files")
      ->required();
  command->add_option("--out,-o", arguments->out, "folder for results.json and images (default: out/EXPERIMENT)");
  command->add_flag("--resume", options.resume, "go on with an unfinished run in that folder");
  command->add_flag("--overwrite", options.overwrite, "replace the run that is in that folder");
  command->add_option("--backend,-b", options.filter.backends, "only these backends")->delimiter(',');
  command->add_option("--scene", options.filter.scenes, "only these scenes")->delimiter(',');
  command->add_option("--method,-m", options.filter.methods, "only these methods")->delimiter(',');
  command->add_option("--only", arguments->only, "only cells with this parameter: name=value")->take_all();
  command
      ->add_option("--sweep", arguments->sweeps,
                   "name=a,b,c or name=from..to*factor: of the quality axis instead of the experiment's values, of any "
                   "other parameter each value a series of its own")
      ->take_all();
  command
      ->add_option("--variant", options.filter.variants,
                   "of an experiment that switches effects, only: all, none, 'only NAME', 'without NAME'")
      ->delimiter(',');
  command->add_flag("--ignore-effects", options.ignore_effects,
                    "draw without the effects that a method cannot simulate; results and pictures say so");
  command->add_flag("--no-reference", arguments->no_reference,
                    "measure times alone, without references and errors: for scenes whose reference takes too long");
  command->add_flag("--verify", arguments->verify,
                    "then run the stability suite (volumark verify) into the same results");
  command->add_flag("--no-images", arguments->no_images, "keep no pictures");
  command->footer("Example: volumark run quick --backend cpu --out out/quick");
  command->callback(
      [&globals, &action, arguments] { action = [&globals, arguments] { return run(*arguments, globals); }; });
}

}  // namespace volumark::cli
