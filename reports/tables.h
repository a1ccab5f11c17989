// Results as plain text for a terminal: what accuracy costs first, then what went wrong. Made from the results alone.
#pragma once

#include <string>

#include "reports/results.h"

namespace volumark {

// Time to reach each RMSE (scene, method, backend), orders of convergence, agreement of backends, outcomes that are not
// ok. Software backends are marked with a star. Ends with a newline.
std::string tables_text(const Results& results);

// "12.3 ms"; three significant digits.
std::string seconds_text(double seconds);

}  // namespace volumark
