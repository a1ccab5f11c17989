// Several runs as one, for a report: accuracy, effects and hard cases are often measured one after another, and the
// questions belong on one page.
// Cells, rows and descriptions of all are kept; what describes the run itself (commit, machine, load) is the first
// one's, and every difference is said in a note.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "reports/results.h"

namespace volumark {

struct MergedResults {
  Results results;                 // image paths are relative to `folder`
  std::filesystem::path folder;    // the nearest that holds them all
  std::vector<std::string> notes;  // what the reader must know: other commits, other machines
};

// `paths`: files or folders, as read_results takes them; one stays as it is. Hard cases and motions of the camera are
// those of the first that has them. Throws ResultsError: unreadable, or a cell that two of them hold.
MergedResults merge_results(std::span<const std::filesystem::path> paths);

}  // namespace volumark
