// Which cells to run: a JSON file, parsed as strictly as a scene (docs/experiments.md describes it). Every name and
// value in it is checked when it is parsed, before any work.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/claims.h"
#include "methods/method.h"

namespace volumark {

// One method with some of its parameters set; `sweep` then runs over its quality axis, coarse to fine.
struct ExperimentMethod {
  const Method* method = nullptr;
  Values values;              // complete; of the quality axis the default
  std::string quality_axis;   // empty: the method has none
  std::vector<double> sweep;  // of the quality axis; empty: its value in `values` alone
};

struct Experiment {
  std::string name, title, description, path;
  std::vector<std::string> scenes;  // names or paths
  std::vector<ExperimentMethod> methods;
  std::vector<std::string> backends;
  // Views of each scene: these indices (those a scene has), or, where empty, `view_count` of them, evenly spread (0:
  // all).
  std::vector<int> views;
  int view_count = 0;
  std::optional<int> width, height;  // instead of the scene's own
  // Sampling of a cell: passes over its views until the interval of the median is narrower than `precision` (relative)
  // or `budget` seconds are spent, but at least `least` and at most `most` passes.
  int least = 3, most = 200;
  double budget = 1, precision = 0.02;
  double timeout = 60;                                            // seconds that a cell may take in all
  enum class Images { None, First, All } images = Images::First;  // which views' pictures are kept
  double reference_tolerance = 1e-6;
  double reference_budget = 1800;  // seconds that the references of one scene may be expected to take
  bool references = true;          // false: times and counters alone (also run --no-reference)
  // Metric -> worst allowed value, over the views of a cell: rmse, max, bias, flip_p99; `finest` gates only the finest
  // value of each sweep. A cell above is wrong_image.
  std::map<std::string, double> limits, finest_limits;
  double parity = 0;       // largest difference between backends in interior pixels; 0: not compared
  bool attribute = false;  // re-run cells with one parameter made ideal at a time: Results::attribution
  bool pairs = false;      // compare the methods' finest pictures with each other: Results::pairs
  bool effects = false;    // each cell also with the scene's effects off, alone and left out: Results::effects
  // Scenes with fields so smooth that the methods' expected order of convergence must show.
  std::vector<std::string> expect_order_on;
  Claims claims;  // of a paper, about these cells
};

// `path` is used in messages, and its stem must be the experiment's name. Throws SceneError.
Experiment parse_experiment(std::string_view text, const std::string& path);

// A shipped experiment by name, or a file (anything with a '/' or ending in .json). Throws SceneError.
Experiment load_experiment(const std::string& name_or_path);

struct ExperimentEntry {
  std::string name, title, path;
};
std::vector<ExperimentEntry> list_experiments();  // shipped ones, by name

// The views of a scene with `count` views that the experiment asks for.
std::vector<int> chosen_views(const Experiment& experiment, int count);

}  // namespace volumark
