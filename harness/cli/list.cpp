// volumark list: what there is. Opens no driver unless asked to.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "harness/cli/commands.h"
#include "harness/environment.h"
#include "harness/experiment.h"
#include "scenes/nearest.h"

namespace volumark::cli {
namespace {

using Json = nlohmann::json;

struct ListOptions {
  std::string what;
  bool json = false, probe = false;
};

Json json_of(const Value& value) {
  return std::visit([](const auto& v) { return Json(v); }, value);
}

Json scenes_json() {
  Json out = Json::array();
  for (const SceneEntry& entry : list_scenes())
    out.push_back({{"name", entry.name}, {"title", entry.title}, {"path", entry.path}});
  return out;
}

Json parameter_json(const ParameterInfo& parameter) {
  Json out = {{"name", parameter.name},
              {"unit", parameter.unit},
              {"doc", parameter.doc},
              {"default", json_of(parameter.default_value)},
              {"quality_axis", parameter.quality_axis}};
  if (!parameter.choices.empty()) out["choices"] = parameter.choices;
  if (parameter.hi > parameter.lo) out["range"] = {parameter.lo, parameter.hi};
  if (!parameter.sweep.empty()) out["sweep"] = parameter.sweep;
  return out;
}

Json methods_json() {
  Json out = Json::array();
  for (const Method* method : method_list()) {
    const MethodInfo& info = method->info();
    Json parameters = Json::array();
    for (const ParameterInfo& parameter : info.parameters) parameters.push_back(parameter_json(parameter));
    out.push_back({{"name", info.name},
                   {"title", info.title},
                   {"paper", info.paper},
                   {"effects", info.effects},
                   {"parameters", parameters}});
  }
  out.push_back({{"name", "reference"},
                 {"title", "double precision, with its own error bound (volumark render only)"},
                 {"paper", ""},
                 {"effects", {"lighting", "clip_planes"}},
                 {"parameters", Json::array()}});
  return out;
}

// The vocabulary, and who simulates what.
Json effects_json() {
  Json out = Json::array();
  for (const EffectInfo& effect : effect_list()) {
    std::vector<std::string> methods;
    for (const Method* method : method_list()) {
      const std::vector<std::string>& simulated = method->info().effects;
      if (std::find(simulated.begin(), simulated.end(), effect.name) != simulated.end())
        methods.push_back(method->info().name);
    }
    out.push_back({{"name", effect.name}, {"title", effect.title}, {"methods", methods}});
  }
  return out;
}

Json backends_json(bool probe, const Globals& globals) {
  Json out = Json::array();
  for (const BackendEntry& entry : backend_list()) {
    Json row = {{"name", entry.id}, {"title", entry.title}};
    if (probe) try {
        const Device device = make_device(entry.id, globals.device);
        const BackendResultInfo info = backend_result_info(device.info());
        row["opens"] = true;
        row["api"] = info.api;
        row["renderer"] = info.renderer;
        row["version"] = info.version;
        row["driver"] = info.driver;
        row["threads"] = info.threads;
        row["software"] = info.software;
        row["capabilities"] = info.capabilities;
      } catch (const std::exception& error) {
        row["opens"] = false;
        row["reason"] = error.what();
      }
    out.push_back(row);
  }
  return out;
}

Json experiments_json() {
  Json out = Json::array();
  for (const ExperimentEntry& entry : list_experiments())
    out.push_back({{"name", entry.name}, {"title", entry.title}, {"path", entry.path}});
  return out;
}

std::string default_text(const Json& parameter) {
  const Json& value = parameter["default"];
  return value.is_string() ? value.get<std::string>() : value.dump();
}

void print_parameters(const Json& method) {
  for (const Json& parameter : method["parameters"]) {
    std::string line = fmt::format("      --set {}={}", parameter["name"].get<std::string>(), default_text(parameter));
    const std::string unit = parameter["unit"];
    if (!unit.empty()) line += " " + unit;
    if (parameter.contains("choices"))
      line += fmt::format("  [{}]", fmt::join(parameter["choices"].get<std::vector<std::string>>(), ", "));
    if (parameter.contains("range"))
      line += fmt::format("  [{:g} .. {:g}]", parameter["range"][0].get<double>(), parameter["range"][1].get<double>());
    if (parameter["quality_axis"].get<bool>()) line += "  (quality axis)";
    fmt::print("{}\n        {}\n", line, parameter["doc"].get<std::string>());
  }
}

void print_text(const std::string& heading, const Json& rows) {
  fmt::print("{}\n", heading);
  for (const Json& row : rows) {
    fmt::print("  {:<21} {}\n", row["name"].get<std::string>(), row["title"].get<std::string>());
    if (row.contains("parameters")) print_parameters(row);
    if (row.contains("methods")) {
      const auto methods = row["methods"].get<std::vector<std::string>>();
      fmt::print("  {:<21}   {}\n", "",
                 methods.empty() ? "no method simulates it" : fmt::format("simulated by {}", fmt::join(methods, ", ")));
    }
    if (row.contains("opens"))
      fmt::print("  {:<21}   {}\n", "",
                 row["opens"].get<bool>()
                     ? fmt::format("{}, {}, {}", row["api"].get<std::string>(), row["renderer"].get<std::string>(),
                                   row["version"].get<std::string>())
                     : "cannot be opened: " + row["reason"].get<std::string>());
  }
}

int list(const ListOptions& options, const Globals& globals) {
  static const std::vector<std::string> kinds = {"scenes", "methods", "effects", "backends", "experiments"};
  if (!options.what.empty() && std::find(kinds.begin(), kinds.end(), options.what) == kinds.end())
    throw UsageError(fmt::format("list {}: unknown kind{}; known: {}", options.what, did_you_mean(options.what, kinds),
                                 fmt::join(kinds, ", ")));
  Json all = Json::object();
  for (const std::string& kind : kinds) {
    if (!options.what.empty() && options.what != kind) continue;
    all[kind] = kind == "scenes"     ? scenes_json()
                : kind == "methods"  ? methods_json()
                : kind == "effects"  ? effects_json()
                : kind == "backends" ? backends_json(options.probe, globals)
                                     : experiments_json();
  }
  if (options.json) {
    fmt::print("{}\n", all.dump(2));
    return kOk;
  }
  for (const std::string& kind : kinds)
    if (all.contains(kind)) print_text(kind, all[kind]);
  return kOk;
}

}  // namespace

void add_list(CLI::App& app, const Globals& globals, Action& action) {
  auto options = std::make_shared<ListOptions>();
  CLI::App* command = app.add_subcommand("list", "Scenes, methods, effects, backends and experiments that there are");
  command->add_option("what", options->what, "scenes, methods, effects, backends or experiments (default: all)");
  command->add_flag("--json", options->json, "as JSON");
  command->add_flag("--probe", options->probe, "open each backend and say what it is");
  command->footer("Example: volumark list methods --json");
  command->callback([&globals, &action, options] { action = [&globals, options] { return list(*options, globals); }; });
}

}  // namespace volumark::cli
