// volumark verify: the stability suite.
#include "harness/verify/verify.h"

#include <fmt/format.h>

#include <atomic>
#include <csignal>
#include <nlohmann/json.hpp>

#include "harness/cli/commands.h"
#include "harness/environment.h"
#include "harness/run_folder.h"

namespace volumark::cli {
namespace {

using Json = nlohmann::json;

struct VerifyArguments {
  VerifyOptions options;
  std::string out;
  bool json = false, list = false, quiet = false;
};

std::atomic<bool> stop_asked{false};
extern "C" void on_verify_signal(int) {
  if (stop_asked.exchange(true)) std::_Exit(kInterrupted);
}

const char* needs_text(const HardCase& hard_case) {
  switch (hard_case.needs) {
    case CaseNeeds::Host:
      return "once";
    case CaseNeeds::Backends:
      return "every method, backends against each other";
    case CaseNeeds::Method:
    case CaseNeeds::Scenes:
      return "every method on every backend";
    case CaseNeeds::Absent:
      break;
  }
  return "";
}

int list_cases(bool json) {
  Json rows = Json::array();
  for (const HardCase& hard_case : hard_case_list()) {
    const bool absent = hard_case.needs == CaseNeeds::Absent;
    if (!json) {
      fmt::print("{:>3}  {:<24} {}\n                              {}\n", hard_case.number, hard_case.id,
                 hard_case.title,
                 absent ? std::string("not there yet: ") + hard_case.source
                        : fmt::format("{}; {}", needs_text(hard_case), hard_case.source));
      continue;
    }
    rows.push_back({{"id", hard_case.id},
                    {"number", hard_case.number},
                    {"title", hard_case.title},
                    {"source", hard_case.source},
                    {"needs", needs_text(hard_case)},
                    {"available", !absent}});
  }
  if (json) fmt::print("{}\n", rows.dump(2));
  for (const Method* method : method_list())
    for (const CaseExemption& exemption : method->info().exempt)
      if (!json) fmt::print("{} is exempt from {}: {}\n", method->info().name, exemption.id, exemption.reason);
  return kOk;
}

std::string number_text(double value) {
  return value >= std::numeric_limits<double>::max() ? "-" : fmt::format("{:.8g}", value);
}

// One line for each case, method and backend, that of its worst check; every check that did not pass has its own.
void print_table(const std::vector<HardCaseRow>& rows) {
  fmt::print("{:>3} {:<23} {:<17} {:<7} {:>13} {:>13} {:>9}  {}\n", "", "case", "method", "backend", "expected",
             "measured", "of bound", "check");
  const auto print_row = [](const HardCaseRow& row) {
    const double share = share_of_bound(row);
    fmt::print("{:>3} {:<23} {:<17} {:<7} {:>13} {:>13} {:>9}  {}\n", row.number, row.id, row.method, row.backend,
               number_text(row.expected), number_text(row.measured), share < 1e6 ? fmt::format("{:.3f}", share) : "-",
               row.outcome == "pass" ? row.check : fmt::format("{}: {}: {}", row.outcome, row.check, row.reason));
  };
  for (size_t i = 0; i < rows.size();) {
    const HardCaseRow* worst = nullptr;
    size_t end = i;
    for (; end < rows.size() && rows[end].id == rows[i].id && rows[end].method == rows[i].method &&
           rows[end].backend == rows[i].backend;
         ++end) {
      if (rows[end].outcome != "pass") {
        print_row(rows[end]);
      } else if (worst == nullptr || share_of_bound(rows[end]) > share_of_bound(*worst)) {
        worst = &rows[end];
      }
    }
    if (worst != nullptr) print_row(*worst);
    i = end;
  }
}

Results results_of(VerifyOutcome outcome, const Globals& globals, const std::string& started) {
  Results results;
  results.run.started_at = started;
  results.run.finished_at = utc_now();
  results.run.id = started + "-verify";
  results.run.argv = globals.argv;
  results.run.order = "case by case, as listed";
  results.run.interrupted = outcome.interrupted;
  results.git = git_info();
  results.build = build_info();
  results.machine = machine_info();
  results.machine.load_after = load_average();
  results.backends = std::move(outcome.backends);
  results.scenes = std::move(outcome.scenes);
  results.hard_cases = std::move(outcome.rows);
  results.sensitivity = std::move(outcome.sensitivity);
  return results;
}

int run_verify(const VerifyArguments& arguments, const Globals& globals) {
  if (arguments.list) return list_cases(arguments.json);
  VerifyOptions options = arguments.options;
  options.device = globals.device;
  options.require_backends = globals.require_backends || !options.backends.empty();
  options.data = globals.data_options();
  options.stop = &stop_asked;
  std::optional<RunFolder> folder;
  if (!arguments.out.empty()) {
    folder.emplace(arguments.out);
    options.out = arguments.out;
  }
  std::signal(SIGINT, on_verify_signal);
  std::signal(SIGTERM, on_verify_signal);
  const std::string started = utc_now();
  const bool talk = !arguments.json && !arguments.quiet;
  const VerifyOutcome outcome = verify(options, [&](const std::string& line) {
    if (talk) {
      fmt::print("{}\n", line);
      std::fflush(stdout);
    }
  });
  const Results results = results_of(outcome, globals, started);
  if (folder) folder->save(results, true);
  if (arguments.json) {
    const Json all = to_json(results);
    fmt::print("{}\n", Json{{"hard_cases", all["hard_cases"]},
                            {"sensitivity", all["sensitivity"]},
                            {"summary", verify_summary(outcome)}}
                           .dump(2));
  } else {
    if (talk) fmt::print("\n");
    print_table(outcome.rows);
    fmt::print("{}\n", verify_summary(outcome));
    if (folder) fmt::print("{}\n", (folder->path() / "results.json").string());
  }
  if (outcome.interrupted) return kInterrupted;
  return verify_failed(outcome) ? kBadNews : kOk;
}

}  // namespace

void add_verify(CLI::App& app, const Globals& globals, Action& action) {
  auto arguments = std::make_shared<VerifyArguments>();
  VerifyOptions& options = arguments->options;
  CLI::App* command = app.add_subcommand(
      "verify", "Hard cases with known answers: is this driver, and is each method, numerically stable?");
  command->add_option("--backend,-b", options.backends, "only these backends (default: gl, vulkan, cpu)")
      ->delimiter(',');
  command->add_option("--method,-m", options.methods, "only these methods")->delimiter(',');
  command->add_option("--case,-c", options.cases, "only these cases, by id or number")->delimiter(',');
  command->add_option("--out,-o", arguments->out, "folder for results.json and pictures of the worst pixels");
  command->add_flag("--json", arguments->json, "rows as JSON");
  command->add_flag("--list", arguments->list, "the cases, those that wait for techniques too");
  command->add_flag("--quiet,-q", arguments->quiet, "no line a case while it runs");
  command->footer("Example: volumark verify --backend cpu --out out/verify && volumark report out/verify");
  command->callback(
      [&globals, &action, arguments] { action = [&globals, arguments] { return run_verify(*arguments, globals); }; });
}

}  // namespace volumark::cli
