#include "reports/html/model.h"

#include <algorithm>
#include <set>
#include <tuple>

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

Row& find_row(Block& block, const CellKey& key, const std::string& setting) {
  for (Row& row : block.rows)
    if (row.method == key.method && row.backend == key.backend && row.setting == setting) return row;
  Row row;
  row.method = key.method;
  row.backend = key.backend;
  row.setting = setting;
  block.rows.push_back(std::move(row));
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

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

// What varies beside the quality axis.
std::string setting_of(const Result& cell, const std::set<std::string>& shown) {
  std::vector<std::string> out;
  for (const std::string& name : shown) {
    const auto value = cell.key.params.find(name);
    if (value == cell.key.params.end() || (cell.quality && cell.quality->parameter == name)) continue;
    out.push_back(name + " " + to_text(value->second));
  }
  if (!cell.ignored_effects.empty()) out.push_back("ignores " + joined(cell.ignored_effects));
  return joined(out);
}

std::string settings_of(const Results& results, const Result& cell, const std::set<std::string>& shown) {
  std::vector<std::string> out;
  if (cell.quality) {
    const std::string unit = unit_of(results, cell.key.method, cell.quality->parameter);
    out.push_back(cell.quality->parameter + " " + compact(cell.quality->value) + (unit.empty() ? "" : " " + unit));
  }
  if (const std::string setting = setting_of(cell, shown); !setting.empty()) out.push_back(setting);
  if (!cell.key.variant.empty())
    out.push_back(cell.key.variant == "none" ? std::string("no effect") : cell.key.variant);
  return joined(out);
}

}  // namespace

Model::Model(const Results& given) : results(given) {
  for (size_t i = 0; i < results.results.size(); ++i) {
    const CellKey& key = results.results[i].key;
    html::block_of(blocks, results, key).cells.push_back(i);
    index_of(methods, key.method);
    index_of(backends, key.backend);
  }
  settings.resize(results.results.size());
  for (Block& block : blocks) fill_rows(block);
  std::stable_sort(blocks.begin(), blocks.end(), [](const Block& a, const Block& b) { return a.real && !b.real; });
}

void Model::fill_rows(Block& block) {
  std::map<std::string, std::set<std::string>> shown;
  for (const size_t i : block.cells) {
    const Result& cell = results.results[i];
    if (!shown.contains(cell.key.method)) shown[cell.key.method] = varying(results, block, cell.key.method);
    settings[i] = settings_of(results, cell, shown[cell.key.method]);
    if (!cell.key.variant.empty()) continue;
    const std::string setting = setting_of(cell, shown[cell.key.method]);
    Row& row = find_row(block, cell.key, setting);
    row.cells.push_back(i);
    row.ranked = cell.ignored_effects.empty();
    row.method_index = index_of(methods, cell.key.method);
    row.backend_index = index_of(backends, cell.key.backend);
    row.setting_index = index_of(block.settings, setting);
  }
  std::stable_sort(block.rows.begin(), block.rows.end(), [](const Row& a, const Row& b) {
    return std::tuple(a.method_index, a.backend_index, a.setting_index) <
           std::tuple(b.method_index, b.backend_index, b.setting_index);
  });
  block.real = block.info != nullptr && !block.info->origin.empty() && block.info->origin != "procedural";
  block.swept =
      std::any_of(block.rows.begin(), block.rows.end(), [&](const Row& row) { return points(row, "rmse").size() > 1; });
}

std::string Block::letter(const Row& row) const {
  if (settings.size() < 2 || row.setting.empty()) return "";
  const auto before = settings.begin() + static_cast<std::ptrdiff_t>(row.setting_index);
  const auto index = std::count_if(settings.begin(), before, [](const std::string& name) { return !name.empty(); });
  std::string out(1, static_cast<char>('a' + index % 26));
  if (index >= 26) out += std::to_string(index / 26);
  return out;
}

std::vector<const Block*> Model::accuracy_blocks() const {
  std::vector<const Block*> swept, all;
  for (const Block& block : blocks) {
    all.push_back(&block);
    if (block.swept) swept.push_back(&block);
  }
  return swept.empty() ? all : swept;
}

const Block* Model::block_of(const CellKey& key) const {
  for (const Block& block : blocks)
    if (block.experiment == key.experiment && block.scene == key.scene) return &block;
  return nullptr;
}

const Row* Model::row_of(const Block& block, const CellKey& key) const {
  for (const Row& row : block.rows) {
    if (row.method != key.method || row.backend != key.backend) continue;
    const Result& cell = results.results[row.cells.front()];
    const std::string axis = cell.quality ? cell.quality->parameter : "";
    const bool same = std::all_of(key.params.begin(), key.params.end(), [&](const auto& param) {
      const auto mine = cell.key.params.find(param.first);
      return param.first == axis || (mine != cell.key.params.end() && mine->second == param.second);
    });
    if (same) return &row;
  }
  return nullptr;
}

std::string Model::name(const Block& block, const Row& row) const {
  return row.method + " on " + row.backend +
         (block.settings.size() > 1 && !row.setting.empty() ? ", " + row.setting : "");
}

bool shows_nothing(const Result& result) {
  return !result.views.empty() && std::all_of(result.views.begin(), result.views.end(),
                                              [](const ViewResult& view) { return view.shows_nothing; });
}

std::string Model::title(const Block& block) const {
  std::string out = block.info != nullptr && !block.info->title.empty() ? block.info->title : block.scene;
  const bool several = std::any_of(blocks.begin(), blocks.end(), [&](const Block& other) {
    return other.scene == block.scene && other.experiment != block.experiment;
  });
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
