#include "reports/html/hard_case_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "reports/html/format.h"

namespace volumark::html {

bool has_deviation(const HardCaseRow& row) { return row.outcome == "pass" || row.outcome == "fail"; }

double share_of_bound(const HardCaseRow& row) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  if (!std::isfinite(row.deviation)) return inf;
  const double size = std::abs(row.deviation);
  if (row.bound > 0) return size / row.bound;
  return size > 0 ? inf : 0;
}

HardCaseSummary summarise(std::span<const HardCaseRow> rows) {
  HardCaseSummary out;
  std::set<std::string> ids;
  for (const HardCaseRow& row : rows) {
    if (row.outcome == "not_applicable") {
      ++out.not_applicable;
      continue;
    }
    ids.insert(row.id);
    ++(row.outcome == "pass" ? out.passed : row.outcome == "fail" ? out.failed : out.errors);
    if (has_deviation(row) && (out.worst == nullptr || share_of_bound(row) > share_of_bound(*out.worst)))
      out.worst = &row;
  }
  out.cases = ids.size();
  return out;
}

double severity(const HardCaseRow& row) {
  if (row.outcome == "not_applicable") return -1;
  return has_deviation(row) ? share_of_bound(row) : std::numeric_limits<double>::infinity();
}

std::vector<HardCaseGroup> group_cases(std::span<const HardCaseRow> rows) {
  std::vector<HardCaseGroup> out;
  for (const HardCaseRow& row : rows) {
    auto found = std::find_if(out.begin(), out.end(), [&](const HardCaseGroup& group) { return group.id == row.id; });
    if (found == out.end()) found = out.insert(out.end(), {row.id, {}});
    found->rows.push_back(&row);
  }
  for (HardCaseGroup& group : out)
    std::stable_sort(group.rows.begin(), group.rows.end(),
                     [](const HardCaseRow* a, const HardCaseRow* b) { return severity(*a) > severity(*b); });
  return out;
}

const HardCaseRow* motion_check(std::span<const HardCaseRow> rows, const SensitivityRow& motion) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const HardCaseRow& row) {
    return row.number == "24" && row.method == motion.key.method && row.backend == motion.key.backend &&
           row.check.starts_with(motion.key.scene + ":");
  });
  return found == rows.end() ? nullptr : &*found;
}

std::string place_of(const HardCaseRow& row) {
  std::string where;
  for (const std::string& word : {row.method, row.backend})
    if (!word.empty()) where += (where.empty() ? "" : ", ") + word;
  return row.id + (where.empty() ? "" : " (" + where + ")");
}

std::string share_text(const HardCaseRow& row) {
  if (!has_deviation(row)) return "no deviation measured";
  if (!std::isfinite(row.deviation)) return "no number";
  const double share = share_of_bound(row);
  if (!std::isfinite(share)) return "off by " + number(row.deviation) + " where it must be exact";
  return number(share) + " of its bound";
}

}  // namespace volumark::html
