// The same cell on several backends: every picture with that of the first backend that drew, so that a difference
// between two others shows as well.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/plan.h"
#include "reports/results.h"
#include "scenes/image.h"

namespace volumark {

// Whether the group's pictures can be held to a limit. Targets with few bits round at every blend, each driver in its
// own way: no limit between backends holds there.
bool compares_backends(const Group& group);

// One row a view and further backend. `images`: of each cell of the group the pictures by view, empty where it was not
// drawn; only cells of `variant` are compared. The limit is the experiment's (Experiment::parity).
std::vector<ParityRow> backend_parity(const Group& group, const std::string& variant,
                                      const std::vector<std::map<int, Image>>& images);

}  // namespace volumark
