// A small results file with every kind of entry in it.
#pragma once

#include "reports/results.h"

namespace volumark {

Results sample_results();

}  // namespace volumark
