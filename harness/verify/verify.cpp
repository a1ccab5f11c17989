#include "harness/verify/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <set>

#include "harness/environment.h"
#include "harness/metrics/metrics.h"
#include "harness/picture_store.h"
#include "harness/scene_context.h"
#include "harness/verify/case_run.h"
#include "harness/verify/scene_shelf.h"
#include "harness/verify/sensitivity.h"
#include "scenes/nearest.h"

namespace volumark {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

[[noreturn]] void unknown(const std::string& kind, const std::string& name, const std::vector<std::string>& known) {
  throw std::invalid_argument(
      fmt::format("unknown {} \"{}\"{}; known: {}", kind, name, did_you_mean(name, known), fmt::join(known, ", ")));
}

std::vector<const Method*> chosen_methods(const VerifyOptions& options) {
  std::vector<const Method*> all = options.method_list;
  if (all.empty()) all.assign(method_list().begin(), method_list().end());
  std::vector<std::string> ids;
  for (const HardCase& hard_case : hard_case_list()) ids.emplace_back(hard_case.id);
  for (const Method* method : all)
    for (const CaseExemption& exemption : method->info().exempt)
      if (std::find(ids.begin(), ids.end(), exemption.id) == ids.end())
        throw std::invalid_argument(fmt::format("method {} exempts itself from a case that is not there: \"{}\"{}",
                                                method->info().name, exemption.id, did_you_mean(exemption.id, ids)));
  if (options.methods.empty()) return all;
  std::vector<const Method*> chosen;
  for (const std::string& name : options.methods) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Method* m) { return m->info().name == name; });
    if (found == all.end()) {
      std::vector<std::string> names;
      for (const Method* method : all) names.push_back(method->info().name);
      unknown("method", name, names);
    }
    chosen.push_back(*found);
  }
  return chosen;
}

std::vector<const HardCase*> chosen_cases(const VerifyOptions& options) {
  std::vector<std::string> known;
  for (const HardCase& hard_case : hard_case_list()) known.emplace_back(hard_case.id);
  std::set<std::string> wanted(options.cases.begin(), options.cases.end());
  for (const std::string& name : wanted) {
    const auto named = [&](const HardCase& c) { return name == c.id || name == c.number; };
    if (std::none_of(hard_case_list().begin(), hard_case_list().end(), named)) unknown("case", name, known);
  }
  std::vector<const HardCase*> chosen;
  for (const HardCase& hard_case : hard_case_list())
    if (wanted.empty() || wanted.contains(hard_case.id) || wanted.contains(hard_case.number))
      chosen.push_back(&hard_case);
  return chosen;
}

class Suite {
 public:
  Suite(const VerifyOptions& options, const std::function<void(const std::string&)>& progress)
      : options_(options),
        progress_(progress),
        cases_(chosen_cases(options)),
        methods_(chosen_methods(options)),
        shelf_(options.data) {
    open_backends();
  }

  VerifyOutcome run() {
    for (const HardCase* hard_case : cases_) {
      if (stopped()) break;
      case_rows_.clear();
      run_case(*hard_case);
      if (options_.out) store_pictures();
      for (VerifyRow& row : case_rows_) outcome_.rows.push_back(std::move(row.row));
    }
    outcome_.interrupted = stopped();
    return std::move(outcome_);
  }

 private:
  bool stopped() const { return options_.stop != nullptr && options_.stop->load(); }
  void say(const std::string& line) const {
    if (progress_) progress_(line);
  }

  void open_backends() {
    std::vector<std::string> known, drawing;
    for (const BackendEntry& entry : backend_list()) {
      known.emplace_back(entry.id);
      if (known.back() != "null") drawing.emplace_back(entry.id);
    }
    for (const std::string& id : options_.backends.empty() ? drawing : options_.backends) {
      if (std::find(known.begin(), known.end(), id) == known.end()) unknown("backend", id, known);
      try {
        devices_.emplace_back(id, std::make_unique<Device>(make_device(id, options_.device)));
        outcome_.backends.push_back(backend_result_info(devices_.back().second->info()));
      } catch (const DeviceError& error) {
        closed_[id] = error.what();
      }
    }
  }

  // A backend that cannot be opened leaves one row a case, never none.
  void add_closed(const HardCase& hard_case) {
    for (const auto& [id, why] : closed_) {
      HardCaseRow row = CaseRun({.hard_case = &hard_case}).new_row("backend " + id, "");
      row.backend = id;
      row.outcome = options_.require_backends ? "error" : "not_applicable";
      row.reason = fmt::format("backend {} cannot be opened: {}", id, why);
      case_rows_.push_back({std::move(row), nullptr, nullptr});
    }
  }

  void run_case(const HardCase& hard_case) {
    switch (hard_case.needs) {
      case CaseNeeds::Absent:
        return;
      case CaseNeeds::Host:
        run_once(hard_case, nullptr, nullptr);
        return;
      case CaseNeeds::Backends:
        add_closed(hard_case);
        for (const Method* method : methods_) run_once(hard_case, method, nullptr);
        return;
      case CaseNeeds::Method:
      case CaseNeeds::Scenes:
        add_closed(hard_case);
        for (const Method* method : methods_)
          for (auto& [id, device] : devices_) run_once(hard_case, method, device.get());
    }
  }

  std::string command_of(const HardCase& hard_case, const Method* method, const Device* device) const {
    std::string out = "volumark verify --case " + std::string(hard_case.id);
    if (method != nullptr) out += " --method " + method->info().name;
    if (device != nullptr) out += " --backend " + device->info().id;
    return out;
  }

  void run_once(const HardCase& hard_case, const Method* method, Device* device) {
    if (stopped()) return;
    const auto start = std::chrono::steady_clock::now();
    CaseRun::Given given{
        &hard_case, method, device, {}, &shelf_, &options_.data, command_of(hard_case, method, device)};
    for (auto& [id, open] : devices_) given.devices.emplace_back(id, open.get());
    CaseRun run(std::move(given));
    try {
      if (const CaseExemption* exemption = exemption_of(hard_case, method)) {
        run.not_applicable("exempt", exemption->reason);
      } else if (hard_case.needs == CaseNeeds::Scenes) {
        run_sensitivity(run, outcome_.sensitivity, outcome_.scenes);
      } else {
        hard_case.check(run);
      }
    } catch (const NotApplicable& why) {
      run.not_applicable(run.empty() ? "the case" : "the rest of the case", why.what());
    } catch (const std::exception& error) {
      run.error(error.what());
    }
    if (run.empty()) run.error("the case checked nothing");
    finish(hard_case, run.take(), seconds_since(start));
  }

  static const CaseExemption* exemption_of(const HardCase& hard_case, const Method* method) {
    if (method == nullptr) return nullptr;
    for (const CaseExemption& exemption : method->info().exempt)
      if (exemption.id == hard_case.id) return &exemption;
    return nullptr;
  }

  void finish(const HardCase& hard_case, std::vector<VerifyRow> rows, double seconds) {
    const HardCaseRow& first = rows.front().row;
    double worst = 0;
    size_t bad = 0;
    for (const VerifyRow& row : rows) {
      bad += row.row.outcome == "fail" || row.row.outcome == "error";
      if (row.row.outcome == "pass") worst = std::max(worst, share_of_bound(row.row));
    }
    say(fmt::format("{:>3} {:<24} {:<18} {:<7} {:>3} checks  {}  {:.2f} s", hard_case.number, hard_case.id,
                    first.method, first.backend, rows.size(),
                    bad > 0 ? fmt::format("{} FAILED", bad) : fmt::format("{:.3f} of the bound", worst), seconds));
    for (VerifyRow& row : rows) {
      row.row.seconds = seconds / static_cast<double>(rows.size());
      case_rows_.push_back(std::move(row));
    }
  }

  // Of the case's worst row that has pictures, and of up to eight that failed.
  void store_pictures() {
    const PictureStore store(*options_.out);
    VerifyRow* worst = nullptr;
    int failed = 0;
    for (VerifyRow& row : case_rows_) {
      if (!row.picture) continue;
      if (worst == nullptr || share_of_bound(row.row) > share_of_bound(worst->row)) worst = &row;
      if (row.row.outcome == "fail" && failed++ < 8) store_row(store, row, failed);
    }
    if (worst != nullptr && !worst->row.picture) store_row(store, *worst, 0);
  }

  static void store_row(const PictureStore& store, VerifyRow& row, int index) {
    const std::string stem =
        fmt::format("verify/{}-{}-{}-{}", row.row.id, row.row.method.empty() ? "host" : row.row.method,
                    row.row.backend.empty() ? "all" : row.row.backend, index);
    row.row.picture = store.linear(stem, *row.picture, glm::dvec3(0));
    if (row.expected) {
      const double scale = std::max(row.row.deviation, 1e-6);
      row.row.difference =
          store.shown(stem + "-difference", signed_difference_picture(*row.picture, *row.expected, scale));
    }
  }

  const VerifyOptions& options_;
  const std::function<void(const std::string&)>& progress_;
  std::vector<const HardCase*> cases_;
  std::vector<const Method*> methods_;
  SceneShelf shelf_;
  std::vector<std::pair<std::string, std::unique_ptr<Device>>> devices_;
  std::map<std::string, std::string> closed_;  // backends that cannot be opened, and why
  std::vector<VerifyRow> case_rows_;
  VerifyOutcome outcome_;
};

}  // namespace

VerifyOutcome verify(const VerifyOptions& options, const std::function<void(const std::string&)>& progress) {
  return Suite(options, progress).run();
}

std::vector<HardCaseRow> run_hard_cases(const VerifyOptions& options,
                                        const std::function<void(const std::string&)>& progress) {
  return verify(options, progress).rows;
}

double share_of_bound(const HardCaseRow& row) {
  if (row.deviation == 0) return 0;
  return row.bound > 0 ? row.deviation / row.bound : std::numeric_limits<double>::infinity();
}

bool verify_failed(const VerifyOutcome& outcome) {
  return std::any_of(outcome.rows.begin(), outcome.rows.end(),
                     [](const HardCaseRow& row) { return row.outcome == "fail" || row.outcome == "error"; });
}

std::string verify_summary(const VerifyOutcome& outcome) {
  std::set<std::string> cases;
  const HardCaseRow* worst = nullptr;
  std::map<std::string, int> count;
  for (const HardCaseRow& row : outcome.rows) {
    ++count[row.outcome];
    if (row.outcome == "not_applicable") continue;
    cases.insert(row.id);
    if (row.outcome == "error") continue;
    if (worst == nullptr || share_of_bound(row) > share_of_bound(*worst)) worst = &row;
  }
  std::string out = fmt::format("{} cases, {} checks", cases.size(), count["pass"] + count["fail"] + count["error"]);
  if (worst != nullptr) {
    const double share = share_of_bound(*worst);
    out += share < 1000 ? fmt::format(", worst deviation {:.2f} of its bound", share)
                        : ", worst deviation beyond 1000 times its bound";
    out += fmt::format(", in {}", worst->id);
    if (!worst->method.empty())
      out += fmt::format(" ({}, {})", worst->method, worst->backend.empty() ? "all backends" : worst->backend);
  }
  if (count["fail"] > 0) out += fmt::format("; {} failed", count["fail"]);
  if (count["error"] > 0) out += fmt::format("; {} ended in an error", count["error"]);
  if (count["not_applicable"] > 0) out += fmt::format("; {} not applicable", count["not_applicable"]);
  return out;
}

}  // namespace volumark
