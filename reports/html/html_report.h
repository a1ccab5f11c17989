// One HTML file of a run that needs nothing else: no network, no other file, no server. Tables and plots are text and
// SVG in it (they print, and are there without scripts); the scripts add the comparison of pictures, sorting, details.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/results.h"

namespace volumark {

// `results_dir`: where the pictures' paths start. A picture that is missing is a note in the report, not an error.
// `notes`: sentences for the top of the page (several runs in one report). Throws ResultsError where `out` cannot be
// written; the old file then stays.
void write_html_report(const Results& results, const std::filesystem::path& results_dir,
                       const std::filesystem::path& out, const std::vector<std::string>& notes = {});

}  // namespace volumark
