// Whether an unfinished run can be gone on with: figures of one file are comparable, or it is refused.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/runner.h"

namespace volumark {

// Of the command line and of the experiments, what figures and outcomes depend on, as it is kept in RunInfo::device:
// the options of the backends, and how each experiment samples its cells and what it refuses.
std::map<std::string, std::string> deciding_options(const RunOptions& options,
                                                    const std::vector<Experiment>& experiments);

// What figures depend on beyond the cells themselves, where it is not what it was: "commit: abc, now def; threads: 2,
// now 0". Empty where nothing differs.
std::string resume_differences(const Results& earlier, const RunOptions& options,
                               const std::vector<Experiment>& experiments);

// The command line that goes on with an interrupted run.
std::string resume_command(std::vector<std::string> argv);

}  // namespace volumark
