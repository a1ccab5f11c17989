// What effects cost, as plain text: one row for each scene, method, backend and effect.
#pragma once

#include <string>

#include "reports/results.h"

namespace volumark {

// Empty where the run switched no effects. Starts and ends with a newline.
std::string effects_table(const Results& results);

}  // namespace volumark
