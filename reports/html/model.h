// The results in the order in which the report shows them: a block for each experiment and scene, in it a row for each
// method and backend. Cells of different experiments never share a row: their image sizes may differ.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis.h"
#include "reports/results.h"

namespace volumark::html {

struct Row {
  std::string method, backend;
  size_t method_index = 0, backend_index = 0;  // in order of appearance in the report: dash, shape and colour
  std::vector<size_t> cells;                   // indices into Results::results
};

struct Block {
  std::string experiment, scene, id;      // id: of the section in the page
  const SceneResultInfo* info = nullptr;  // null where the file says nothing of the scene
  std::vector<size_t> cells;
  std::vector<Row> rows;
};

class Model {
 public:
  explicit Model(const Results& results);  // outlives the model
  Model(const Model&) = delete;

  const Results& results;
  std::vector<Block> blocks;
  std::vector<std::string> methods, backends;  // in order of appearance
  std::vector<std::string> settings;           // of each cell: its quality value and what else varies, "step 0.5"

  // "Engine block", with the experiment where there are several.
  std::string title(const Block& block) const;
  // Of a backend that the file does not describe (it could not be opened) nothing is said.
  bool is_software(const std::string& backend) const;
  std::vector<CostPoint> points(const Row& row, const std::string& error_metric) const;
};

}  // namespace volumark::html
