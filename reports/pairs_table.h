// Method against method, as plain text for a terminal. Made from the results alone.
#pragma once

#include <string>

#include "reports/results.h"

namespace volumark {

// A row a pair: how far the two pictures are apart, and which is closer to the reference, and which is faster, where
// that can be told. Empty where no methods were compared.
std::string pairs_text(const Results& results);

}  // namespace volumark
