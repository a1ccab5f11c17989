#include "reports/attribution_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reports/series_name.h"
#include "reports/tables.h"
#include "reports/text_table.h"

namespace volumark {
namespace {

constexpr size_t kFewCells = 6;        // up to so many, every part has its row
constexpr double kShownWorth = 0.005;  // share of the squared error
constexpr size_t kShownParts = 3;

std::string text(const ParamValue& value) {
  return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

std::string number(double value) { return std::isnan(value) ? "-" : fmt::format("{:.2e}", value); }
std::string share(double value) {
  if (std::isnan(value)) return "-";
  return fmt::format("{:.1f} %", std::abs(value) < 5e-4 ? 0.0 : 100 * value);  // never -0.0
}
std::string time(double seconds) { return seconds > 0 ? seconds_text(seconds) : "-"; }

const Result* cell_of(const Results& results, const CellKey& key) {
  const auto found =
      std::find_if(results.results.begin(), results.results.end(), [&](const Result& r) { return r.key == key; });
  return found == results.results.end() ? nullptr : &*found;
}

std::string setting(const Results& results, const CellKey& key) {
  const Result* cell = cell_of(results, key);
  return cell != nullptr && cell->quality ? fmt::format("{}={:g}", cell->quality->parameter, cell->quality->value)
                                          : "-";
}

// What is left with every part ideal, and what that is.
std::string rest(const Attribution& entry) {
  if (std::isnan(entry.all_ideal)) return "-";
  if (entry.all_ideal <= entry.bound) return number(entry.all_ideal) + " (at the bound)";
  return number(entry.all_ideal);
}

std::string largest_parts(const Attribution& entry) {
  std::string out;
  size_t shown = 0;
  for (const AttributionPart& part : entry.parts) {  // largest first
    if (!(std::abs(part.worth) >= kShownWorth) || shown++ == kShownParts) continue;
    out += fmt::format("{}{} {:.0f} %", out.empty() ? "" : ", ", part.aspect, 100 * part.worth);
  }
  if (!out.empty()) return out;
  return entry.parts.empty() && !entry.note.empty() ? "-" : "the method's own";  // the note says why not
}

std::string summary_table(const Results& results) {
  std::vector<TextRow> rows = {{"scene", "method", "backend", "setting", "worth", "rmse", "all ideal"}};
  for (const Attribution& entry : results.attribution)
    rows.push_back({entry.key.scene, entry.key.method + series_suffix(results, entry.key), entry.key.backend,
                    setting(results, entry.key), largest_parts(entry), number(entry.error), rest(entry)});
  return text_table(rows, 5);
}

std::string detail_table(const Results& results) {
  std::vector<TextRow> rows = {{"scene", "method", "backend", "setting", "made ideal", "rmse", "worth", "a frame"}};
  for (const Attribution& entry : results.attribution) {
    rows.push_back({entry.key.scene, entry.key.method + series_suffix(results, entry.key), entry.key.backend,
                    setting(results, entry.key), "nothing", number(entry.error), "", time(entry.seconds)});
    std::string idle;
    for (const AttributionPart& part : entry.parts) {
      if (part.error == entry.error) {
        idle += (idle.empty() ? "" : ", ") + part.aspect;
        continue;
      }
      rows.push_back({"", "", "", "",
                      fmt::format("{} ({} {} -> {})", part.aspect, part.parameter, text(part.from), text(part.to)),
                      number(part.error), share(part.worth), time(part.seconds)});
    }
    if (!idle.empty()) rows.push_back({"", "", "", "", "without effect: " + idle, "", "0 %", ""});
    if (entry.parts.size() > 1)
      rows.push_back({"", "", "", "", "all of them", rest(entry),
                      share(1 - entry.all_ideal * entry.all_ideal / (entry.error * entry.error)), ""});
  }
  return text_table(rows, 5);
}

// Each cause once, with the number of cells that it was named in.
std::string notes(const Results& results) {
  std::vector<std::string> order;
  std::map<std::string, int> count;
  const auto add = [&](const std::string& note) {
    if (!note.empty() && count[note]++ == 0) order.push_back(note);
  };
  for (const Attribution& entry : results.attribution) {
    for (const AttributionPart& part : entry.parts)
      if (!part.note.empty()) add(part.aspect + ": " + part.note);
    add(entry.note);
  }
  std::string out;
  for (const std::string& note : order) out += fmt::format("  {} ({} times)\n", note, count[note]);
  return out.empty() ? "" : "\nNamed causes\n" + out;
}

std::string floors(const Results& results) {
  std::vector<TextRow> rows = {{"scene", "method", "backend", "held by", "floor"}};
  for (const Convergence& row : results.convergence)
    if (row.floor > 0 && !row.floor_reason.empty())
      rows.push_back({row.key.scene, row.key.method + series_suffix(results, row.key), row.key.backend,
                      row.floor_reason, number(row.floor)});
  return rows.size() == 1 ? "" : "\nWhere the error stops falling\n\n" + text_table(rows, 4);
}

}  // namespace

std::string attribution_text(const Results& results) {
  if (results.attribution.empty()) return {};
  return "\nWhere the error comes from: one part made ideal at a time; worth: the share of the squared error that this "
         "takes\n"
         "away (below 0: the error grew)\n\n" +
         (results.attribution.size() <= kFewCells ? detail_table(results) : summary_table(results)) + notes(results) +
         floors(results);
}

}  // namespace volumark
