// An experiment spelt out: the cells in the order in which they run. Cells of a group are measured in turns, and their
// images are compared with each other.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "harness/experiment.h"
#include "harness/sweep.h"
#include "reports/results.h"

namespace volumark {

struct Cell {
  CellKey key;
  std::string backend;
  std::string command;  // runs this cell alone
};

// Cells of a group differ in the backend and, where the experiment switches effects, in the variant of the scene.
struct Group {
  const Experiment* experiment = nullptr;  // outlives the plan
  std::string scene;                       // as the experiment names it
  const Method* method = nullptr;
  Values values;
  std::optional<Quality> quality;
  bool finest = false;          // the last value of its sweep
  bool ignore_effects = false;  // leave out what the method cannot simulate
  std::vector<Cell> cells;
};

// What is left of the experiments; empty vectors filter nothing.
struct CellFilter {
  std::vector<std::string> scenes, methods, backends;
  std::vector<std::pair<std::string, std::string>> only;  // parameter = value, as on the command line
  std::vector<std::string> variants;                      // of experiments that switch effects, as in CellKey
};

// Scene by scene, method, quality value, backend, variant. An experiment pairs its methods with those of its scenes
// whose display they draw (MethodInfo::displays). `sweeps` are those that were applied to the experiments: the
// cells' commands name them. Throws SceneError where a filter names what no experiment has, where no method draws what
// the chosen scenes show, and for more than kMostCells cells.
std::vector<Group> plan_cells(const std::vector<Experiment>& experiments, const CellFilter& filter,
                              const std::vector<Sweep>& sweeps = {});

// A word of a command line, in quotes where a shell needs them.
std::string shell_quoted(const std::string& word);

}  // namespace volumark
