// What is made of a scene's cells once all are measured, while its data and references are at hand: attribution of
// errors, and method against method. Results that an earlier process left are kept.
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>

#include "harness/attribution.h"
#include "harness/pairs.h"
#include "harness/progress.h"

namespace volumark {

class FollowUp {
 public:
  // Of the groups of one scene and experiment. All arguments outlive it.
  FollowUp(std::span<const Group> groups, const std::vector<Experiment>& experiments, Results& results);

  // Nothing is left to do for the cells that `results` have.
  bool complete() const;
  // A cell was measured: what was said of an earlier measurement goes, and its pictures are kept where they are needed.
  void measured(const Cell& cell, const std::map<int, Image>& pictures);
  // Fills results.attribution and results.pairs. Throws Interrupted alone; what was finished by then is kept.
  void run(const SceneContext& context, const CellOptions& options, Progress& progress);

 private:
  void attribute_cells(const SceneContext& context, const CellOptions& options, Progress& progress);
  void compare_pairs(const SceneContext& context, const CellOptions& options, Progress& progress);
  DrawnCell& drawn(const PlannedCell& cell, const SceneContext& context, const CellOptions& options,
                   Progress& progress);

  std::span<const Group> groups_;
  const std::vector<Experiment>& experiments_;
  Results& results_;
  const Experiment& experiment_;
  std::set<const Cell*> finest_;  // whose pictures are needed
  std::map<const Cell*, std::map<int, Image>> pictures_;
  std::map<const Cell*, DrawnCell> drawn_;
};

}  // namespace volumark
