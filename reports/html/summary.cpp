// The first lines of the page: which run this was, and one tile for each question of the kind "can I trust it".
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/html/format.h"
#include "reports/html/sections.h"

namespace volumark::html {
namespace {

std::string tile(const std::string& state, const std::string& href, const std::string& title, const std::string& value,
                 const std::string& detail) {
  return fmt::format(
      "<li class=\"tile {}\"><a href=\"#{}\"><span class=\"tile-title\">{}</span><span class=\"tile-value\">{}</span>"
      "<span class=\"tile-detail\">{}</span></a></li>",
      state, href, title, value, detail);
}

std::string outcome_tile(const Results& results) {
  if (results.results.empty()) return tile("none", "cells", "Outcomes", "no cell", "nothing was drawn and measured");
  std::map<Outcome, int> counts;
  for (const Result& result : results.results) ++counts[result.outcome];
  std::string detail;
  for (const Outcome outcome : {Outcome::WrongImage, Outcome::Failed, Outcome::Timeout, Outcome::Unsupported})
    if (counts[outcome] > 0)
      detail += fmt::format("{}{} {}", detail.empty() ? "" : ", ", counts[outcome],
                            outcome == Outcome::WrongImage ? "wrong image" : to_string(outcome));
  const bool bad = counts[Outcome::WrongImage] + counts[Outcome::Failed] + counts[Outcome::Timeout] > 0;
  const char* state = bad ? "bad" : counts[Outcome::Unsupported] > 0 ? "warn" : "good";
  return tile(state, bad || counts[Outcome::Unsupported] > 0 ? "problems" : "cells", "Outcomes",
              fmt::format("{} of {} ok", counts[Outcome::Ok], results.results.size()),
              detail.empty() ? "every cell drew a right image" : detail);
}

std::string bound_tile(const Results& results) {
  if (results.results.empty()) return "";
  double worst = -1;
  bool estimate = false;
  std::string where;
  size_t at_bound = 0;
  for (const Result& result : results.results)
    for (const ViewResult& view : result.views) {
      if (!view.reference) continue;
      at_bound += view.at_bound;
      if (view.reference->bound > worst) {
        worst = view.reference->bound;
        estimate = view.reference->estimate;
        where = result.key.scene;
      }
    }
  if (worst < 0) return tile("warn", "scenes", "Reference", "none", "no cell was compared with a reference");
  return tile(worst < kErrorTargets[3] ? "good" : "warn", "scenes", "Worst reference bound",
              scientific(worst) + (estimate ? " <small>estimate</small>" : ""),
              escape(where) + (at_bound > 0 ? fmt::format("; {} views at the bound", at_bound) : ""));
}

std::string parity_tile(const Results& results) {
  if (results.results.empty()) return "";
  if (results.parity.empty()) return tile("none", "checks", "Backends agree", "not compared", "");
  const auto ok = std::count_if(results.parity.begin(), results.parity.end(), [](const auto& row) { return row.ok; });
  const auto worst = std::max_element(results.parity.begin(), results.parity.end(),
                                      [](const auto& a, const auto& b) { return a.interior_max < b.interior_max; });
  return tile(ok == static_cast<int64_t>(results.parity.size()) ? "good" : "bad", "parity", "Backends agree",
              fmt::format("{} of {}", ok, results.parity.size()),
              fmt::format("worst {} inside {}, limit {}", scientific(worst->interior_max), escape(worst->key.scene),
                          compact(worst->limit)));
}

std::string convergence_tile(const Results& results) {
  std::map<std::string, int> counts;
  for (const Convergence& row : results.convergence) ++counts[row.verdict];
  if (results.results.empty()) return "";
  if (results.convergence.empty()) return tile("none", "scenes", "Convergence", "not measured", "");
  const int judged = counts["pass"] + counts["fail"];
  std::string detail;
  for (const char* verdict : {"fail", "not resolved", "at the bound", "not stated"})
    if (counts[verdict] > 0) detail += fmt::format("{}{} {}", detail.empty() ? "" : ", ", counts[verdict], verdict);
  // An order that is stated, and cannot be seen, is no good news.
  const bool unseen = std::any_of(results.convergence.begin(), results.convergence.end(), [](const Convergence& row) {
    return row.verdict == "not resolved" && row.expected > 0 && row.values.size() > 2;
  });
  return tile(counts["fail"] > 0 ? "bad"
              : unseen           ? "warn"
              : judged > 0       ? "good"
                                 : "none",
              "scenes", "Order of convergence",
              judged > 0 ? fmt::format("{} of {} pass", counts["pass"], judged) : "none judged", detail);
}

std::string self_test_tile(const Results& results) {
  if (results.self_test.empty()) return tile("warn", "self-test", "Metrics self-test", "not run", "");
  const auto ok =
      std::count_if(results.self_test.begin(), results.self_test.end(), [](const auto& row) { return row.ok; });
  return tile(ok == static_cast<int64_t>(results.self_test.size()) ? "good" : "bad", "self-test", "Metrics self-test",
              fmt::format("{} of {}", ok, results.self_test.size()), "published check values");
}

std::string claims_tile(const Results& results) {
  if (results.claims.empty()) return "";
  std::map<std::string, int> counts;
  for (const Claim& claim : results.claims) ++counts[claim.verdict];
  return tile(
      counts["fails"] > 0     ? "bad"
      : counts["unknown"] > 0 ? "warn"
                              : "good",
      "claims", "Claims",
      fmt::format("{} of {} reproduced", counts["holds"], counts["holds"] + counts["fails"] + counts["unknown"]),
      fmt::format("{} not reproduced, {} not comparable here", counts["fails"], counts["unknown"]));
}

std::string item(const std::string& name, const std::string& value) {
  return value.empty() ? "" : "<span><span class=\"dim\">" + name + "</span> " + escape(value) + "</span>";
}

}  // namespace

std::string run_line(const Model& model) {
  const Results& r = model.results;
  std::string out = "<p class=\"run\">" + item("run", r.run.id);
  out += item("finished", r.run.finished_at);
  out += item("commit", r.git.sha.substr(0, 12) + (r.git.branch.empty() ? "" : " on " + r.git.branch) +
                            (r.git.dirty ? ", with uncommitted changes" : ""));
  out += item("machine", fmt::format("{}, {} cores, {}", r.machine.cpu, r.machine.cores, r.machine.os));
  out += item("build", fmt::format("{} {} {}", r.build.compiler, r.build.version, r.build.type)) + "</p>";
  if (r.run.interrupted || r.run.finished_at.empty())
    out +=
        "<p class=\"warning\" role=\"note\">This run did not finish: cells may be missing. Go on with <code>--resume"
        "</code>.</p>";
  return out;
}

std::string summary_tiles(const Model& model) {
  const Results& r = model.results;
  return "<ul class=\"tiles\">" + outcome_tile(r) + bound_tile(r) + parity_tile(r) + convergence_tile(r) +
         claims_tile(r) + self_test_tile(r) + "</ul>";
}

}  // namespace volumark::html
