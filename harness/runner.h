// Runs experiments into a folder: every cell of the plan, results on disk after each, resumable after any kill.
#pragma once

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/cell.h"
#include "harness/plan.h"
#include "harness/sweep.h"
#include "scenes/scene_io.h"

namespace volumark {

struct RunOptions {
  std::vector<std::string> experiments;  // names or paths
  std::vector<Sweep> sweeps;
  CellFilter filter;
  std::filesystem::path out;
  std::filesystem::path cache;  // of references
  bool resume = false;
  bool overwrite = false;       // a run in `out` may be replaced
  bool images = true;           // false: keep none, whatever the experiments say
  bool references = true;       // false: times alone, no errors
  bool ignore_effects = false;  // leave out of each cell the effects that its method cannot simulate
  DataOptions data;
  CellOptions cell;
  std::vector<std::string> argv;
  std::FILE* progress = stdout;
};

struct RunOutcome {
  Results results;
  bool interrupted = false;
  int skipped = 0;  // cells that an earlier process had measured
  // Failed, timed out or wrong cells, backends that disagree, orders that were missed, failed self tests.
  std::vector<std::string> bad_news;
};

// Throws SceneError for an experiment that cannot be used, FolderError and ResultsError for the folder; all before any
// work, except a disk that fills up on the way.
RunOutcome run_experiments(const RunOptions& options);

}  // namespace volumark
