// Where the error of a cell comes from: the same picture again with one parameter made ideal (ParameterInfo::ideal) at
// a time, and once with all of them, each against the reference. Knows parameters by what they declare, no method by
// name. All figures of an attribution are of one view: the one in which the cell's own RMSE is largest.
#pragma once

#include <span>
#include <string>

#include "harness/cell.h"
#include "harness/chosen_cells.h"

namespace volumark {

// `results` hold the cell, and whatever else of the run needs not be drawn again. A part that cannot be drawn
// (unsupported, out of memory, out of time, a driver's failure) has NaN for its figures and says why in its note.
// Throws Interrupted, and std::invalid_argument for a cell without an error.
Attribution attribute(const PlannedCell& cell, const SceneContext& context, const CellOptions& options,
                      const Results& results);

// Of the groups of one scene and experiment, the cells whose attribution `results` lack: the usual ones, and the finest
// of each series whose error stops falling (results.convergence).
std::vector<PlannedCell> cells_to_attribute(std::span<const Group> groups, const Results& results);

// Fills floor_reason of every series that has a floor and an attribution of its finest cell.
void explain_floors(Results& results);

}  // namespace volumark
