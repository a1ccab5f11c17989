// The hard cases of a run, counted: what the stability line says.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "reports/results.h"

namespace volumark::html {

struct HardCaseSummary {
  size_t cases = 0;                                               // different ids that were checked
  size_t passed = 0, failed = 0, errors = 0, not_applicable = 0;  // rows
  const HardCaseRow* worst = nullptr;                             // of the rows with a deviation; null: none
};

// Deviation in units of its bound: at most 1 where the check holds. Infinite for a deviation that is no number, and
// for any deviation where the bound is 0.
double share_of_bound(const HardCaseRow& row);
bool has_deviation(const HardCaseRow& row);  // passed or failed
HardCaseSummary summarise(std::span<const HardCaseRow> rows);

// For sorting, the worst first: the share of the bound, infinite for an error, below 0 for what does not apply.
double severity(const HardCaseRow& row);

// Rows of one case, in the file's order of first appearance.
struct HardCaseGroup {
  std::string id;
  std::vector<const HardCaseRow*> rows;  // the largest share of the bound first, errors before all
};
std::vector<HardCaseGroup> group_cases(std::span<const HardCaseRow> rows);

// The check that judged a small motion of the camera: its deviation is the change of the pixel that comes nearest to
// its limit, in units of that limit. Null: the file has none.
const HardCaseRow* motion_check(std::span<const HardCaseRow> rows, const SensitivityRow& motion);

// "slab (raycast, gl)"
std::string place_of(const HardCaseRow& row);
// "0.82 x its bound", with words for the odd ones.
std::string share_text(const HardCaseRow& row);

}  // namespace volumark::html
