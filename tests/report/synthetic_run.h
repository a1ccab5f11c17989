// A made-up run for tests of the report: the pictures are drawn from formulas, their errors are measured for real, the
// times are invented. It holds one of everything that a results file can hold, names that must be escaped, and one
// hardware backend. Never shown as a result: its run id and title say what it is.
#pragma once

#include <filesystem>

#include "reports/results.h"

namespace volumark::report_test {

// Writes the pictures below `folder`.
Results synthetic_run(const std::filesystem::path& folder);

}  // namespace volumark::report_test
