// Published figures beside ours, and the verdicts on a paper's claims, as plain text.
#pragma once

#include <string>
#include <vector>

#include "reports/results.h"

namespace volumark {

// "reproduced", "not reproduced", "not comparable here", "not judged" for a claim's verdict.
std::string verdict_words(const std::string& verdict);

// "1.2 (1.1..1.3)" of a claim; "-" where nothing was measured.
std::string measured_text(const Claim& claim);

// Keys of the papers that published cells or claims are of, as first met.
std::vector<std::string> papers_of(const Results& results);

// A cell's figure in the paper's unit; NaN where it has none.
double our_figure(const Result& result);

// A part for each paper: published cells (published, ours, ratio), then claims with verdict and reason. Empty where the
// results are of no paper.
std::string papers_text(const Results& results);

}  // namespace volumark
