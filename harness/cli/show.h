// Results on the terminal.
#pragma once

#include <filesystem>

#include "reports/results.h"

#ifdef VM_HAS_TABLES
#include "reports/tables.h"
#endif

namespace volumark::cli {

void show_results(const Results& results, const std::filesystem::path& folder);

}  // namespace volumark::cli
