// How a series of cells is called in tables: its method, and what tells it from the other series of that method.
#pragma once

#include <string>

#include "reports/results.h"

namespace volumark {

// " end_slabs=full target_format=rgba8 (only lighting)": the parameters in which the series of this experiment and
// method differ, less those with the value that more than half of the cells have, and less the quality axis; then the
// variant. Empty for the usual series. `key` may lack parameters (as in Convergence).
std::string series_suffix(const Results& results, const CellKey& key);

}  // namespace volumark
