// Values of one parameter that a run is given on top of what its experiments say: `--sweep name=a,b,c`.
// Of the quality axis they take the place of the experiment's own, coarse to fine; of any other parameter each value
// makes a series of its own, the product with what is there. Everything is checked before any work.
#pragma once

#include <string>
#include <vector>

#include "harness/experiment.h"

namespace volumark {

// More cells than this are a slip of the pen, not a plan.
inline constexpr size_t kMostCells = 20000;

struct Sweep {
  std::string parameter;
  std::vector<std::string> values;  // as written, ranges spelt out
};

// "name=a,b,c". Each of a, b, c is a value or a range of numbers: "4..0.25*0.5" multiplies from 4 until 0.25 is passed
// (4, 2, 1, 0.5, 0.25), "1..3+0.5" adds. Throws ParameterError: no name, no value, an empty or endless range, the same
// value twice.
Sweep parse_sweep(const std::string& text);
std::string to_string(const Sweep& sweep);  // "name=a,b,c": parses to the same sweep

// Changes the experiments' methods that are among `methods` (empty: all) and have the parameter; the others stay as
// they are. Entries that become equal are one. An experiment's finest_limits are of its own values and go. Returns
// remarks for the user (values that were put into order). Throws ParameterError: a parameter that none of the methods
// has, a value that it cannot have, a parameter that is swept twice, more than kMostCells entries.
std::vector<std::string> apply_sweeps(std::vector<Experiment>& experiments, const std::vector<Sweep>& sweeps,
                                      const std::vector<std::string>& methods);

}  // namespace volumark
