#include "reports/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "reports/analysis.h"
#include "reports/attribution_table.h"
#include "reports/effects_table.h"
#include "reports/pairs_table.h"
#include "reports/paper_table.h"
#include "reports/series_name.h"
#include "reports/text_table.h"

namespace volumark {
namespace {

using Row = std::vector<std::string>;

struct SeriesName {
  std::string experiment, scene, method, backend;
  // clang-tidy 14 takes the defaulted comparison for a zero pointer.
  friend auto operator<=>(const SeriesName&, const SeriesName&) = default;  // NOLINT(modernize-use-nullptr)
};

bool is_software(const Results& results, const std::string& backend) {
  return std::any_of(results.backends.begin(), results.backends.end(),
                     [&](const BackendResultInfo& info) { return info.id == backend && info.software; });
}

// The quality values between which a time lies: "1..0.5"; of a measured cell its own.
std::string between(const Results& results, const TimeToError& found) {
  const auto value = [&](size_t index) {
    const std::optional<Quality>& quality = results.results[index].quality;
    return quality ? fmt::format("{:g}", quality->value) : std::string("-");
  };
  return found.coarse == found.fine ? value(found.fine) : value(found.coarse) + ".." + value(found.fine);
}

struct SeriesTable {
  const char* metric;
  const char* shown;
  std::span<const double> targets;
};

std::string time_to_error_table(const Results& results, const SeriesTable& wanted) {
  std::vector<SeriesName> order;  // as first met
  std::map<SeriesName, std::vector<CostPoint>> series;
  for (size_t i = 0; i < results.results.size(); ++i) {
    const Result& result = results.results[i];
    const auto point = cost_point(results, i, wanted.metric);
    if (!point) continue;
    const SeriesName name{result.key.experiment, result.key.scene,
                          result.key.method + series_suffix(results, result.key), result.key.backend};
    if (!series.contains(name)) order.push_back(name);
    series[name].push_back(*point);
  }
  if (series.empty()) return {};
  std::vector<Row> rows = {{"scene", "method", "backend"}};
  for (const double target : wanted.targets) rows[0].push_back(fmt::format("{} {:g}", wanted.shown, target));
  rows[0].push_back("best");
  rows[0].emplace_back("at");
  for (const SeriesName& name : order) {
    Row row = {name.scene, name.method, name.backend + (is_software(results, name.backend) ? "*" : "")};
    TimeToError found;
    for (const double target : wanted.targets) {
      found = time_to_error(series[name], target);
      row.push_back(found.seconds ? fmt::format("{}{} ({})", found.interpolated ? "" : "<",
                                                seconds_text(*found.seconds), between(results, found))
                                  : "-");
    }
    row.push_back(fmt::format("{:.1e}", found.best_error));
    row.push_back(seconds_text(found.best_seconds));
    rows.push_back(std::move(row));
  }
  return text_table(rows, 3);
}

std::string time_to_error_tables(const Results& results) {
  const std::string rmse = time_to_error_table(results, {"rmse", "rmse", kErrorTargets});
  const std::string flip = time_to_error_table(results, {"flip_p99", "flip", kFlipTargets});
  if (rmse.empty()) return {};
  return "Time a frame to reach an RMSE, worst view (in brackets the settings of the quality axis between which it "
         "lies;\n"
         "- not reached, see best; < a setting that was measured and not undercut by a faster one; * software: never "
         "ranked\n"
         "against a GPU)\n\n" +
         rmse + "\nThe same for FLIP, 99th percentile\n\n" + flip;
}

// Of cells that were measured without a reference: nothing but the time is known.
std::string times_table(const Results& results) {
  std::vector<Row> rows = {{"scene", "method", "backend", "setting", "time", "95 %"}};
  for (const Result& result : results.results) {
    if (result.outcome != Outcome::Ok || result.error || !result.metrics || a_view_shows_nothing(result)) continue;
    const Stats& wall = result.metrics->frame_wall.stats;
    rows.push_back({result.key.scene, result.key.method + series_suffix(results, result.key),
                    result.key.backend + (is_software(results, result.key.backend) ? "*" : ""),
                    result.quality ? fmt::format("{}={:g}", result.quality->parameter, result.quality->value) : "-",
                    seconds_text(wall.median), seconds_text(wall.median_lo) + ".." + seconds_text(wall.median_hi)});
  }
  if (rows.size() == 1) return {};
  return "\nTime a frame, measured without a reference: nothing is known of the error\n\n" + text_table(rows, 4);
}

std::string empty_view_lines(const Results& results) {
  const auto empty = std::count_if(results.results.begin(), results.results.end(), a_view_shows_nothing);
  return empty == 0 ? ""
                    : fmt::format(
                          "\nViews that show nothing but the background have no say in errors; cells with such "
                          "views: {}\n",
                          empty);
}

std::string convergence_table(const Results& results) {
  std::vector<Row> rows = {{"scene", "method", "backend", "axis", "order", "95 %", "expected", "verdict"}};
  for (const Convergence& row : results.convergence) {
    if (row.verdict == "not stated" || !(row.expected > 0)) continue;
    const bool fitted = row.fitted_points > 0;
    rows.push_back({row.key.scene, row.key.method + series_suffix(results, row.key), row.key.backend, row.parameter,
                    fitted ? fmt::format("{:.2f}", row.fitted) : "-",
                    fitted ? fmt::format("{:.2f}..{:.2f}", row.fitted_lo, row.fitted_hi) : "-",
                    fmt::format("{:g}", row.expected), row.verdict});
  }
  return rows.size() == 1 ? "" : "\nOrder of convergence (error ~ axis^order)\n\n" + text_table(rows, 4);
}

std::string parity_lines(const Results& results) {
  if (results.parity.empty()) return {};
  double worst = 0;
  size_t apart = 0;
  std::string out;
  for (const ParityRow& row : results.parity) {
    worst = std::max(worst, row.interior_max);
    if (row.ok) continue;
    ++apart;
    out += fmt::format("  {} {} view {}: {} and {} differ by {:.2e} in {} of {} interior pixels (limit {:g})\n",
                       row.key.scene, row.key.method, row.view, row.key.backend, row.other, row.interior_max,
                       row.interior_over, row.interior_pixels, row.limit);
  }
  return fmt::format(
             "\nBackends against each other: {} comparisons, {} above the limit, largest interior difference "
             "{:.2e}\n",
             results.parity.size(), apart, worst) +
         out;
}

std::string outcome_lines(const Results& results) {
  std::map<std::string, size_t> counts;
  std::map<std::string, std::vector<std::string>> reasons;  // those that are not ok: reason -> cells
  for (const Result& result : results.results) {
    const std::string outcome = to_string(result.outcome);
    ++counts[outcome];
    if (result.outcome != Outcome::Ok)
      reasons[outcome + ": " + result.reason].push_back(
          fmt::format("{} {} {}", result.key.scene, result.key.method, result.key.backend));
  }
  std::string out = "\nCells:";
  for (const auto& [outcome, count] : counts) out += fmt::format(" {} {}", count, outcome);
  out += "\n";
  for (const auto& [reason, cells] : reasons)
    out += fmt::format("  {}\n    {}{}\n", reason, cells.front(),
                       cells.size() > 1 ? fmt::format(" and {} more", cells.size() - 1) : "");
  const auto failed =
      std::count_if(results.self_test.begin(), results.self_test.end(), [](const SelfTestRow& row) { return !row.ok; });
  if (!results.self_test.empty())
    out += fmt::format("Metrics' self test: {} of {} check values met\n",
                       results.self_test.size() - static_cast<size_t>(failed), results.self_test.size());
  return out;
}

}  // namespace

std::string seconds_text(double seconds) {
  if (!std::isfinite(seconds)) return "-";
  if (seconds < 1e-3) return fmt::format("{:.3g} us", seconds * 1e6);
  return seconds < 1 ? fmt::format("{:.3g} ms", seconds * 1e3) : fmt::format("{:.3g} s", seconds);
}

std::string tables_text(const Results& results) {
  return time_to_error_tables(results) + times_table(results) + empty_view_lines(results) + convergence_table(results) +
         attribution_text(results) + pairs_text(results) + effects_table(results) + papers_text(results) +
         parity_lines(results) + outcome_lines(results);
}

}  // namespace volumark
