// The cells of one scene that are looked at closer once all are measured: one a method and backend.
#pragma once

#include <span>
#include <vector>

#include "harness/plan.h"

namespace volumark {

struct PlannedCell {
  const Group* group = nullptr;
  const Cell* cell = nullptr;
};

// The result of a key; null where there is none.
const Result* find_result(const Results& results, const CellKey& key);

// `groups`: of one scene and experiment, in the order of the plan (coarse to fine).
// Of each method and backend the cell with the fewest parameters off their defaults, of equals the finest; only cells
// that have a time and an error.
std::vector<PlannedCell> usual_cells(std::span<const Group> groups, const Results& results);

// Of each method and backend the finest cell; of several sweeps the one with the fewest parameters off their defaults,
// the quality axis apart.
std::vector<PlannedCell> finest_cells(std::span<const Group> groups);

}  // namespace volumark
