// Method against method: the finest pictures of two methods with each other, on one scene and backend. A verdict is
// given only where the intervals part: for the error, RMSE against the reference +- (its bound + repeat noise); for the
// time, the bootstrap interval of the median. So a method at the reference's bound is never ranked below another there.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "harness/cell.h"
#include "harness/chosen_cells.h"

namespace volumark {

// A measured cell with its pictures, by view.
struct DrawnCell {
  PlannedCell planned;
  std::map<int, Image> pictures;
  double noise = 0;  // largest difference of a second drawing
};

// The largest difference of any channel between `drawn` and the same view drawn again on a Device of its own: 0 where
// the backend repeats itself, infinity where a pixel is not finite. The first view that shows something. Throws
// Interrupted, and what drawing throws.
double repeat_noise(const DrawnCell& drawn, const SceneContext& context, const CellOptions& options);

// `results` hold both cells, with times and errors.
PairRow compare_methods(const DrawnCell& a, const DrawnCell& b, const SceneContext& context, const Results& results);

// Two of finest_cells() that `results` measured and have no row for.
std::vector<std::pair<PlannedCell, PlannedCell>> pairs_to_compare(std::span<const Group> groups,
                                                                  const Results& results);

}  // namespace volumark
