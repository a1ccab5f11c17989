#include "harness/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "harness/effect_variants.h"
#include "harness/paths.h"
#include "harness/run_folder.h"
#include "scenes/errors.h"
#include "scenes/nearest.h"
#include "scenes/scene_io.h"

namespace volumark {
namespace {

bool passes(const std::vector<std::string>& wanted, const std::string& name) {
  return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
}

std::string scene_name(const std::string& name_or_path) { return std::filesystem::path(name_or_path).stem().string(); }

// A filter that names nothing in the experiments is a mistake, not an empty run.
void check_filter(const std::vector<std::string>& wanted, const std::set<std::string>& there, const char* what) {
  const std::vector<std::string> names(there.begin(), there.end());
  for (const std::string& name : wanted)
    if (!there.contains(name))
      throw SceneError(fmt::format("{} \"{}\" is not in the experiment{}; it has: {}", what, name,
                                   did_you_mean(name, names), fmt::join(names, ", ")));
}

void check_filters(const std::vector<Experiment>& experiments, const CellFilter& filter) {
  std::set<std::string> scenes, methods, backends, parameters;
  for (const Experiment& experiment : experiments) {
    for (const std::string& scene : experiment.scenes) scenes.insert(scene_name(scene));
    backends.insert(experiment.backends.begin(), experiment.backends.end());
    for (const ExperimentMethod& method : experiment.methods) {
      methods.insert(method.method->info().name);
      for (const auto& [name, unused] : method.values) parameters.insert(name);
    }
  }
  check_filter(filter.scenes, scenes, "scene");
  check_filter(filter.methods, methods, "method");
  std::vector<std::string> names;
  for (const auto& [name, unused] : filter.only) names.push_back(name);
  check_filter(names, parameters, "parameter");
}

bool same_value(const Value& value, const std::string& text) {
  if (to_string(value) == text) return true;
  try {  // 0.50 and 0.5
    size_t used = 0;
    const double number = std::stod(text, &used);
    if (used != text.size()) return false;
    if (const auto* real = std::get_if<double>(&value)) return *real == number;
    if (const auto* whole = std::get_if<int64_t>(&value)) return static_cast<double>(*whole) == number;
  } catch (const std::exception&) {  // no number
  }
  return false;
}

bool passes(const CellFilter& filter, const Values& values) {
  return std::all_of(filter.only.begin(), filter.only.end(), [&](const auto& wanted) {
    const auto found = values.find(wanted.first);
    return found != values.end() && same_value(found->second, wanted.second);
  });
}

double number_of(const Value& value) {
  if (const auto* whole = std::get_if<int64_t>(&value)) return static_cast<double>(*whole);
  const auto* real = std::get_if<double>(&value);
  return real == nullptr ? 0 : *real;
}

// Parameters in which the cells of one method differ.
std::set<std::string> telling_apart(const Experiment& experiment, const std::string& method) {
  std::map<std::string, std::set<std::string>> seen;
  for (const ExperimentMethod& entry : experiment.methods) {
    if (entry.method->info().name != method) continue;
    for (const auto& [name, value] : entry.values)
      if (entry.quality_axis != name || entry.sweep.empty()) seen[name].insert(to_string(value));
    for (const double value : entry.sweep) seen[entry.quality_axis].insert(fmt::format("{}", value));
  }
  std::set<std::string> out;
  for (const auto& [name, values] : seen)
    if (values.size() > 1) out.insert(name);
  return out;
}

std::string command_of(const Experiment& experiment, const CellKey& key, const std::set<std::string>& telling,
                       const std::vector<Sweep>& sweeps) {
  const bool shipped = std::filesystem::path(experiment.path).parent_path() == experiment_directory();
  std::string out = fmt::format("volumark run {} --scene {} --method {} --backend {}",
                                shell_quoted(shipped ? experiment.name : experiment.path), shell_quoted(key.scene),
                                key.method, key.backend);
  const auto is_swept = [&](const std::string& name) {
    return std::any_of(sweeps.begin(), sweeps.end(), [&](const Sweep& sweep) { return sweep.parameter == name; });
  };
  for (const auto& [name, value] : key.params)
    if (is_swept(name)) out += " --sweep " + shell_quoted(name + "=" + to_string(value));
  // Beyond that, only what tells this cell from the others of its method.
  for (const auto& [name, value] : key.params)
    if (telling.contains(name) && !is_swept(name)) out += " --only " + shell_quoted(name + "=" + to_string(value));
  if (experiment.effects) out += " --variant " + shell_quoted(variant_word(key.variant));
  // A folder of its own: the results that name this command stay.
  return out + " --overwrite --out out/again";
}

// The variants of a scene that are left of those that the experiment asks for.
std::vector<std::string> chosen_variants(const Experiment& experiment, const Scene& scene, const CellFilter& filter) {
  if (!experiment.effects) return {""};
  const std::vector<std::string> effects = effect_names(scene.effects);
  if (filter.variants.empty()) return effect_variants(effects);
  std::set<std::string> wanted;
  for (const std::string& variant : filter.variants) try {
      wanted.insert(canonical_variant(effects, variant));
    } catch (const std::invalid_argument&) {  // of another scene: check_variants
    }
  std::vector<std::string> out;
  for (const std::string& variant : effect_variants(effects))
    if (wanted.contains(variant)) out.push_back(variant);
  return out;
}

// A variant that no chosen scene has is a mistake.
void check_variants(const std::vector<Experiment>& experiments, const CellFilter& filter) {
  for (const std::string& variant : filter.variants) {
    std::set<std::string> there;
    bool found = false;
    for (const Experiment& experiment : experiments) {
      if (!experiment.effects) continue;
      for (const std::string& scene : experiment.scenes) {
        if (!passes(filter.scenes, scene_name(scene))) continue;
        const std::vector<std::string> effects = effect_names(load_scene(scene).effects);
        for (const std::string& known : effect_variants(effects)) there.insert(variant_word(known));
        try {
          canonical_variant(effects, variant);
          found = true;
        } catch (const std::invalid_argument&) {  // perhaps of the next scene
        }
      }
    }
    if (there.empty()) throw SceneError("--variant: the experiment switches no effects (\"effects\": true)");
    if (!found)
      throw SceneError(fmt::format("variant \"{}\" is of no scene that was chosen; they have: {}",
                                   variant_word(variant), fmt::join(there, ", ")));
  }
}

Group make_group(const Experiment& experiment, const std::string& scene, const ExperimentMethod& method,
                 const Values& values, const CellFilter& filter, const std::vector<std::string>& variants) {
  Group group;
  group.experiment = &experiment;
  group.scene = scene;
  group.method = method.method;
  group.values = values;
  if (!method.quality_axis.empty())
    group.quality = Quality{method.quality_axis, number_of(values.find(method.quality_axis)->second)};
  for (const std::string& backend : experiment.backends) {
    if (!passes(filter.backends, backend)) continue;
    for (const std::string& variant : variants) {
      Cell cell;
      cell.backend = backend;
      cell.key = {experiment.name, scene_name(scene), method.method->info().name, backend, values, variant};
      group.cells.push_back(std::move(cell));
    }
  }
  return group;
}

void set_commands(std::vector<Group>& groups, const std::vector<Sweep>& sweeps) {
  std::map<std::pair<const Experiment*, std::string>, std::set<std::string>> telling;
  for (Group& group : groups) {
    const std::string& method = group.method->info().name;
    const auto [found, added] = telling.try_emplace({group.experiment, method});
    if (added) found->second = telling_apart(*group.experiment, method);
    for (Cell& cell : group.cells) cell.command = command_of(*group.experiment, cell.key, found->second, sweeps);
  }
}

// One key, one series: the same cell twice would be two results with one name.
void check_unique(const std::vector<Group>& groups) {
  std::set<std::string> seen;
  for (const Group& group : groups)
    for (const Cell& cell : group.cells)
      if (!seen.insert(key_text(cell.key)).second)
        throw SceneError(fmt::format("{}: two cells have the same scene, method, backend and parameters: {}",
                                     group.experiment->path, cell.command));
}

}  // namespace

std::string shell_quoted(const std::string& word) {
  if (!word.empty() &&
      word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=+:,") ==
          std::string::npos)
    return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::vector<Group> plan_cells(const std::vector<Experiment>& experiments, const CellFilter& filter,
                              const std::vector<Sweep>& sweeps) {
  check_filters(experiments, filter);
  check_variants(experiments, filter);
  size_t cells = 0;
  std::vector<Group> groups;
  std::string left_out;
  for (const Experiment& experiment : experiments)
    for (const std::string& scene : experiment.scenes) {
      if (!passes(filter.scenes, scene_name(scene))) continue;
      const Scene parsed = load_scene(scene);
      const std::vector<std::string> variants = chosen_variants(experiment, parsed, filter);
      for (const ExperimentMethod& method : experiment.methods) {
        if (!passes(filter.methods, method.method->info().name)) continue;
        if (const auto reason = display_reason(*method.method, parsed)) {
          left_out = scene_name(scene) + ": " + *reason;
          continue;
        }
        const std::vector<double> sweep =
            method.sweep.empty() ? std::vector<double>{std::nan("")} : method.sweep;  // NaN: as it is
        for (const double quality : sweep) {
          Values values = method.values;
          if (!std::isnan(quality))
            set_value(method.method->info().parameters, values, method.quality_axis, nlohmann::json(quality));
          if (!passes(filter, values)) continue;
          Group group = make_group(experiment, scene, method, values, filter, variants);
          cells += group.cells.size();
          if (cells > kMostCells)
            throw SceneError(
                fmt::format("{}: more than {} cells; choose fewer with --scene, --method, --backend, --only "
                            "or fewer values of --sweep",
                            experiment.path, kMostCells));
          group.finest = std::isnan(quality) || quality == sweep.back();
          if (!group.cells.empty()) groups.push_back(std::move(group));
        }
      }
    }
  if (groups.empty() && !left_out.empty()) throw SceneError("nothing to run: " + left_out);
  set_commands(groups, sweeps);
  check_unique(groups);
  return groups;
}

}  // namespace volumark
