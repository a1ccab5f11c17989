#include "reports/html/model.h"

#include <algorithm>
#include <set>

#include "reports/html/format.h"

namespace volumark::html {
namespace {

size_t index_of(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<size_t>(found - names.begin());
  names.push_back(name);
  return names.size() - 1;
}

Block& block_of(std::vector<Block>& blocks, const Results& results, const CellKey& key) {
  for (Block& block : blocks)
    if (block.experiment == key.experiment && block.scene == key.scene) return block;
  Block block;
  block.experiment = key.experiment;
  block.scene = key.scene;
  block.id = "scene-" + std::to_string(blocks.size());
  for (const SceneResultInfo& info : results.scenes)
    if (info.name == key.scene) block.info = &info;
  blocks.push_back(std::move(block));
  return blocks.back();
}

Row& row_of(Block& block, const CellKey& key) {
  for (Row& row : block.rows)
    if (row.method == key.method && row.backend == key.backend) return row;
  block.rows.push_back({key.method, key.backend, 0, 0, {}});
  return block.rows.back();
}

std::string unit_of(const Results& results, const std::string& method, const std::string& parameter) {
  for (const MethodResultInfo& info : results.methods)
    if (info.name == method)
      for (const ParameterResultInfo& described : info.parameters)
        if (described.name == parameter) return described.unit;
  return "";
}

// Parameters that take more than one value among the cells of a method in a block.
std::set<std::string> varying(const Results& results, const Block& block, const std::string& method) {
  std::map<std::string, std::set<std::string>> seen;
  for (const size_t cell : block.cells)
    if (results.results[cell].key.method == method)
      for (const auto& [name, value] : results.results[cell].key.params) seen[name].insert(to_text(value));
  std::set<std::string> out;
  for (const auto& [name, values] : seen)
    if (values.size() > 1) out.insert(name);
  return out;
}

std::string settings_of(const Results& results, const Result& cell, std::set<std::string> shown) {
  std::string out;
  if (cell.quality) {
    const std::string unit = unit_of(results, cell.key.method, cell.quality->parameter);
    out = cell.quality->parameter + " " + compact(cell.quality->value) + (unit.empty() ? "" : " " + unit);
    shown.erase(cell.quality->parameter);
  }
  for (const std::string& name : shown) {
    const auto value = cell.key.params.find(name);
    if (value != cell.key.params.end()) out += (out.empty() ? "" : ", ") + name + " " + to_text(value->second);
  }
  return out;
}

}  // namespace

Model::Model(const Results& given) : results(given) {
  for (size_t i = 0; i < results.results.size(); ++i) {
    const CellKey& key = results.results[i].key;
    Block& block = block_of(blocks, results, key);
    block.cells.push_back(i);
    Row& row = row_of(block, key);
    row.cells.push_back(i);
    row.method_index = index_of(methods, key.method);
    row.backend_index = index_of(backends, key.backend);
  }
  settings.resize(results.results.size());
  for (Block& block : blocks) {
    std::stable_sort(block.rows.begin(), block.rows.end(), [](const Row& a, const Row& b) {
      return std::pair(a.method_index, a.backend_index) < std::pair(b.method_index, b.backend_index);
    });
    std::map<std::string, std::set<std::string>> shown;
    for (const Row& row : block.rows)
      if (!shown.contains(row.method)) shown[row.method] = varying(results, block, row.method);
    for (const size_t cell : block.cells)
      settings[cell] = settings_of(results, results.results[cell], shown[results.results[cell].key.method]);
  }
}

std::string Model::title(const Block& block) const {
  std::string out = block.info != nullptr && !block.info->title.empty() ? block.info->title : block.scene;
  const bool several = std::any_of(blocks.begin(), blocks.end(),
                                   [&](const Block& other) { return other.experiment != block.experiment; });
  return several ? out + " (" + block.experiment + ")" : out;
}

bool Model::is_software(const std::string& backend) const {
  return std::any_of(results.backends.begin(), results.backends.end(),
                     [&](const BackendResultInfo& info) { return info.id == backend && info.software; });
}

std::vector<CostPoint> Model::points(const Row& row, const std::string& error_metric) const {
  std::vector<CostPoint> out;
  for (const size_t cell : row.cells)
    if (const auto point = cost_point(results, cell, error_metric)) out.push_back(*point);
  return out;
}

}  // namespace volumark::html
