// The results in the order in which the report shows them: a block for each experiment and scene (scenes of real data
// first), in it a row for each method, backend and setting. Cells of different experiments never share a row: their
// image sizes may differ. A cell of an effect's variant is another picture: it belongs to its block, but to no row.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis.h"
#include "reports/results.h"

namespace volumark::html {

struct Row {
  std::string method, backend;
  std::string setting;  // what varies beside the quality axis, "target_format rgba8"; empty: nothing
  bool ranked = true;   // false: effects of the scene were left out, so it draws another picture
  size_t method_index = 0, backend_index = 0;  // in order of appearance in the report: dash, shape and colour
  size_t setting_index = 0;                    // into Block::settings
  std::vector<size_t> cells;                   // indices into Results::results
};

struct Block {
  std::string experiment, scene, id;      // id: of the section in the page
  const SceneResultInfo* info = nullptr;  // null where the file says nothing of the scene
  std::vector<size_t> cells;
  std::vector<Row> rows;
  std::vector<std::string> settings;  // of its rows, each once
  bool real = false;                  // data from outside, not computed from a formula
  bool swept = false;                 // some row has several points: it can say what accuracy costs

  // "" where all rows have one setting; else "a", "b", ...: what tells the lines of a plot apart.
  std::string letter(const Row& row) const;
};

class Model {
 public:
  explicit Model(const Results& results);  // outlives the model
  Model(const Model&) = delete;

  const Results& results;
  std::vector<Block> blocks;
  std::vector<std::string> methods, backends;  // in order of appearance
  std::vector<std::string> settings;           // of each cell: its quality value and what else varies, "step 0.5"

  // The blocks that say what accuracy costs: those that sweep an axis; all where none does.
  std::vector<const Block*> accuracy_blocks() const;
  const Block* block_of(const CellKey& key) const;
  // The row whose cells have the parameters of `key`, whatever the value on the quality axis; null: none.
  const Row* row_of(const Block& block, const CellKey& key) const;
  // "raycast on gl", with the setting where the block has several.
  std::string name(const Block& block, const Row& row) const;

  // "Engine block", with the experiment where there are several.
  std::string title(const Block& block) const;
  // Of a backend that the file does not describe (it could not be opened) nothing is said.
  bool is_software(const std::string& backend) const;
  std::vector<CostPoint> points(const Row& row, const std::string& error_metric) const;

 private:
  void fill_rows(Block& block);
};

// Every view of it shows nothing but the background: there is nothing to be right or wrong about.
bool shows_nothing(const Result& result);

}  // namespace volumark::html
