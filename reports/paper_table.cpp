#include "reports/paper_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/measures.h"
#include "reports/text_table.h"

namespace volumark {
namespace {

std::string figure(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "-"; }

std::string cells_text(const Results& results, const std::string& paper) {
  std::vector<TextRow> rows = {{"table", "cell", "scene", "backend", "unit", "published", "ours", "ours/published"}};
  for (const Result& result : results.results) {
    if (!result.paper || result.paper->key != paper) continue;
    const PaperCell& cell = *result.paper;
    const double ours = our_figure(result);
    rows.push_back({cell.table, cell.cell, result.key.scene, result.key.backend, cell.unit, figure(cell.published),
                    figure(ours), figure(ours / cell.published)});
  }
  return rows.size() == 1 ? "" : text_table(rows, 5) + "\n";
}

std::string claims_text(const Results& results, const std::string& paper) {
  std::string out;
  std::string last;
  for (const Claim& claim : results.claims) {
    if (claim.paper != paper) continue;
    const std::string head = fmt::format("{} ({}, {}): {}", claim.id, claim.rule, claim.measure, claim.text);
    if (head != last) out += head + "\n";
    last = head;
    out += fmt::format("  {:<7} {:<19} {}", claim.backend, verdict_words(claim.verdict), measured_text(claim));
    if (std::isfinite(claim.expected)) out += fmt::format(", published {:.4g}", claim.expected);
    out += claim.reason.empty() ? "\n" : "\n          " + claim.reason + "\n";
  }
  return out;
}

}  // namespace

std::string verdict_words(const std::string& verdict) {
  if (verdict == "holds") return "reproduced";
  if (verdict == "fails") return "not reproduced";
  return verdict == "unknown" ? "not comparable here" : verdict == "not_judged" ? "not judged" : verdict;
}

std::string measured_text(const Claim& claim) {
  if (!std::isfinite(claim.measured)) return "-";
  if (claim.measured_lo == claim.measured_hi || !std::isfinite(claim.measured_lo)) return figure(claim.measured);
  return fmt::format("{:.4g} ({:.4g}..{:.4g})", claim.measured, claim.measured_lo, claim.measured_hi);
}

std::vector<std::string> papers_of(const Results& results) {
  std::vector<std::string> out;
  const auto add = [&](const std::string& paper) {
    if (!paper.empty() && std::find(out.begin(), out.end(), paper) == out.end()) out.push_back(paper);
  };
  for (const Result& result : results.results)
    if (result.paper) add(result.paper->key);
  for (const Claim& claim : results.claims) add(claim.paper);
  return out;
}

double our_figure(const Result& result) {
  if (!result.paper || (result.outcome != Outcome::Ok && result.outcome != Outcome::WrongImage) ||
      !measure_fault(result.paper->measure).empty())
    return std::numeric_limits<double>::quiet_NaN();
  const std::optional<Measured> found = measured(result, result.paper->measure);
  return found ? in_unit(found->value, result.paper->unit) : std::numeric_limits<double>::quiet_NaN();
}

std::string papers_text(const Results& results) {
  std::string out;
  for (const std::string& paper : papers_of(results)) {
    const std::string cells = cells_text(results, paper), claims = claims_text(results, paper);
    out += fmt::format(
               "\nThe paper {}: published figures are of its machine (- : none is printed there), ours of this "
               "one\n\n",
               paper) +
           cells + claims;
  }
  return out;
}

}  // namespace volumark
