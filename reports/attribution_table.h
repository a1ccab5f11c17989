// Where errors come from, as plain text for a terminal. Made from the results alone.
#pragma once

#include <string>

#include "reports/results.h"

namespace volumark {

// Of few cells a row for every part that was made ideal; of many a row a cell with its largest parts. Then what holds
// errors where they stop falling. Empty where no error was attributed.
std::string attribution_text(const Results& results);

}  // namespace volumark
