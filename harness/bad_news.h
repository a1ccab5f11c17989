// What makes a finished run bad news: exit code 1, each with a line that says what and where.
#pragma once

#include <string>
#include <vector>

#include "reports/results.h"

namespace volumark {

// Cells that failed, timed out or are wrong; backends that disagree; orders that were missed; failed self tests.
std::vector<std::string> bad_news_of(const Results& results);

}  // namespace volumark
