#include "harness/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "harness/parse_claims.h"
#include "harness/paths.h"
#include "scenes/errors.h"
#include "scenes/json_reader.h"
#include "scenes/nearest.h"
#include "scenes/scene_io.h"

namespace volumark {
namespace {

namespace fs = std::filesystem;

constexpr const char* kGates[] = {"rmse", "max", "bias", "flip_p99"};

template <class Known>
void must_be_known(const JsonNode& node, const std::string& name, const char* what, const Known& known) {
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  const std::vector<std::string> names(known.begin(), known.end());
  node.fail(
      fmt::format("unknown {} \"{}\"{}; known: {}", what, name, did_you_mean(name, names), fmt::join(names, ", ")));
}

std::vector<std::string> unique_strings(const JsonNode& node, const char* what) {
  std::vector<std::string> out;
  for (const JsonNode& one : node.array(1)) {
    const std::string name = one.string();
    if (std::find(out.begin(), out.end(), name) != out.end())
      one.fail(fmt::format("{} \"{}\" is named twice", what, name));
    out.push_back(name);
  }
  return out;
}

bool is_path(const std::string& name) { return name.find('/') != std::string::npos || name.ends_with(".json"); }

std::vector<std::string> parse_scenes(const JsonNode& node) {
  std::vector<std::string> known;
  for (const SceneEntry& entry : list_scenes()) known.push_back(entry.name);
  std::vector<std::string> scenes = unique_strings(node, "scene");
  for (const JsonNode& one : node.array())
    if (!is_path(one.string())) must_be_known(one, one.string(), "scene", known);
  for (std::string& scene : scenes)  // beside the experiment's own file
    if (is_path(scene) && !fs::path(scene).is_absolute())
      scene = (fs::path(node.file()).parent_path() / scene).lexically_normal().string();
  return scenes;
}

std::vector<std::string> parse_backends(const JsonNode& node) {
  std::vector<std::string> known;
  for (const BackendEntry& entry : backend_list()) known.emplace_back(entry.id);
  std::vector<std::string> backends = unique_strings(node, "backend");
  for (const JsonNode& one : node.array()) must_be_known(one, one.string(), "backend", known);
  return backends;
}

void set_checked(const JsonNode& node, const MethodInfo& info, Values& values, const std::string& name) {
  try {
    set_value(info.parameters, values, name, node.json());
  } catch (const ParameterError& error) {
    node.fail(error.what());
  }
}

// "default": the method's own sweep; or values, which must be in the order of the method's own: coarse to fine.
std::vector<double> parse_sweep(const JsonNode& node, const MethodInfo& info, const ParameterInfo& axis,
                                Values values) {
  if (node.json().is_string()) {
    node.one_of({"default"});
    return axis.sweep;
  }
  std::vector<double> sweep;
  for (const JsonNode& one : node.array(1)) {
    set_checked(one, info, values, axis.name);
    sweep.push_back(one.number());
  }
  const bool falling = axis.sweep.size() < 2 || axis.sweep.front() > axis.sweep.back();
  for (size_t i = 1; i < sweep.size(); ++i)
    if (falling ? sweep[i] >= sweep[i - 1] : sweep[i] <= sweep[i - 1])
      node.fail(fmt::format("expected values of {} from coarse to fine ({}), found {} after {}", axis.name,
                            falling ? "falling" : "rising", sweep[i], sweep[i - 1]));
  return sweep;
}

ExperimentMethod parse_method(const JsonNode& node) {
  const JsonObject object(node, {"method", "set", "sweep"});
  ExperimentMethod out;
  try {
    out.method = &find_method(object.at("method").string());
  } catch (const ParameterError& error) {
    object.at("method").fail(error.what());
  }
  const MethodInfo& info = out.method->info();
  out.values = default_values(info.parameters);
  if (const auto set = object.find("set")) {
    if (!set->json().is_object()) set->fail("expected an object: parameter name -> value");
    for (const auto& [name, value] : set->json().items())
      set_checked(JsonNode(value, set->pointer() + "/" + name, set->file()), info, out.values, name);
  }
  const auto axis = std::find_if(info.parameters.begin(), info.parameters.end(),
                                 [](const ParameterInfo& parameter) { return parameter.quality_axis; });
  if (axis != info.parameters.end()) out.quality_axis = axis->name;
  if (const auto sweep = object.find("sweep")) {
    if (axis == info.parameters.end()) sweep->fail(info.name + " has no quality axis to sweep");
    out.sweep = parse_sweep(*sweep, info, *axis, out.values);
  }
  return out;
}

void parse_views(const JsonNode& node, Experiment& out) {
  if (node.is_number()) {
    out.view_count = node.integer(1, 1000);
    return;
  }
  if (node.json().is_string()) {
    node.one_of({"all"});
    return;
  }
  for (const JsonNode& one : node.array(1)) {
    const int view = one.integer(0, 999);
    if (std::find(out.views.begin(), out.views.end(), view) != out.views.end())
      one.fail(fmt::format("view {} is named twice", view));
    out.views.push_back(view);
  }
}

std::map<std::string, double> parse_limits(const JsonNode& node) {
  std::map<std::string, double> out;
  if (!node.json().is_object()) node.fail("expected an object: metric -> worst allowed value");
  for (const auto& [name, value] : node.json().items()) {
    const JsonNode child(value, node.pointer() + "/" + name, node.file());
    must_be_known(child, name, "metric", std::vector<std::string>(std::begin(kGates), std::end(kGates)));
    out[name] = child.number(0);
  }
  return out;
}

void parse_sampling(const JsonObject& object, Experiment& out) {
  if (const auto node = object.find("sampling")) {
    const JsonObject sampling(*node, {"least", "most", "budget", "precision", "timeout"});
    if (const auto least = sampling.find("least")) out.least = least->integer(1, 100000);
    if (const auto most = sampling.find("most")) out.most = most->integer(1, 100000);
    if (out.most < out.least) node->fail(fmt::format("most ({}) is below least ({})", out.most, out.least));
    out.budget = sampling.number_or("budget", out.budget, 0, 1e6);
    out.precision = sampling.number_or("precision", out.precision, 0, 1);
    out.timeout = sampling.number_or("timeout", out.timeout, 0, 1e6, true);
  }
}

}  // namespace

Experiment parse_experiment(std::string_view text, const std::string& path) {
  const nlohmann::json json = parse_json(text, path);
  const JsonNode root(json, "", path);
  const JsonObject object(root, {"name",
                                 "title",
                                 "description",
                                 "scenes",
                                 "methods",
                                 "backends",
                                 "views",
                                 "image_size",
                                 "sampling",
                                 "images",
                                 "references",
                                 "reference_tolerance",
                                 "reference_budget",
                                 "limits",
                                 "finest_limits",
                                 "parity",
                                 "attribute",
                                 "pairs",
                                 "effects",
                                 "expect_order_on",
                                 "paper",
                                 "claims"});
  Experiment out;
  out.path = path;
  out.name = object.at("name").string();
  if (out.name != fs::path(path).stem().string())
    object.at("name").fail(
        fmt::format("expected the file's name, \"{}\", found \"{}\"", fs::path(path).stem().string(), out.name));
  if (const auto title = object.find("title")) out.title = title->string();
  if (const auto description = object.find("description")) out.description = description->string(true);
  out.scenes = parse_scenes(object.at("scenes"));
  for (const JsonNode& one : object.at("methods").array(1)) out.methods.push_back(parse_method(one));
  out.backends = parse_backends(object.at("backends"));
  if (const auto views = object.find("views")) parse_views(*views, out);
  if (const auto size = object.find("image_size")) {
    const auto sides = size->array(2, 2);
    out.width = sides[0].integer(1, 16384);
    out.height = sides[1].integer(1, 16384);
  }
  parse_sampling(object, out);
  if (const auto images = object.find("images")) {
    const std::string which = images->one_of({"none", "first", "all"});
    out.images = which == "none"  ? Experiment::Images::None
                 : which == "all" ? Experiment::Images::All
                                  : Experiment::Images::First;
  }
  out.reference_tolerance = object.number_or("reference_tolerance", out.reference_tolerance, 0, 1, true);
  out.reference_budget = object.number_or("reference_budget", out.reference_budget, 0, 1e9);
  if (const auto limits = object.find("limits")) out.limits = parse_limits(*limits);
  if (const auto limits = object.find("finest_limits")) out.finest_limits = parse_limits(*limits);
  out.parity = object.number_or("parity", 0, 0, 1);
  if (const auto attribute = object.find("attribute")) out.attribute = attribute->boolean();
  if (const auto pairs = object.find("pairs")) out.pairs = pairs->boolean();
  if (const auto effects = object.find("effects")) out.effects = effects->boolean();
  if (const auto smooth = object.find("expect_order_on")) {
    out.expect_order_on = unique_strings(*smooth, "scene");
    for (const JsonNode& one : smooth->array())
      must_be_known(one, one.string(), "scene of this experiment", out.scenes);
  }
  if (const auto references = object.find("references")) {
    out.references = references->boolean();
    for (const char* needing : {"limits", "finest_limits", "attribute", "pairs", "expect_order_on"})
      if (!out.references && object.has(needing)) object.at(needing).fail("needs references, which are switched off");
  }
  out.claims = parse_claims(object, out);
  return out;
}

std::vector<ExperimentEntry> list_experiments() {
  std::vector<ExperimentEntry> out;
  std::error_code error;
  for (const auto& file : fs::directory_iterator(experiment_directory(), error)) {
    if (file.path().extension() != ".json") continue;
    ExperimentEntry entry{file.path().stem().string(), "", file.path().string()};
    std::ifstream stream(file.path());
    const auto json = nlohmann::json::parse(stream, nullptr, false);
    if (json.is_object() && json.contains("title") && json["title"].is_string()) entry.title = json["title"];
    out.push_back(std::move(entry));
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return out;
}

Experiment load_experiment(const std::string& name_or_path) {
  std::string path = name_or_path;
  if (!is_path(name_or_path)) {
    std::vector<std::string> names;
    for (const ExperimentEntry& entry : list_experiments()) {
      names.push_back(entry.name);
      if (entry.name == name_or_path) path = entry.path;
    }
    if (std::find(names.begin(), names.end(), name_or_path) == names.end())
      throw SceneError(fmt::format("unknown experiment \"{}\"{}; known: {}", name_or_path,
                                   did_you_mean(name_or_path, names), fmt::join(names, ", ")));
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw SceneError(path + ": cannot be read: no such file, or no permission");
  return parse_experiment(std::string(std::istreambuf_iterator<char>(stream), {}), path);
}

std::vector<int> chosen_views(const Experiment& experiment, int count) {
  std::vector<int> out;
  if (!experiment.views.empty()) {
    for (const int view : experiment.views)
      if (view < count) out.push_back(view);
    return out;
  }
  const int wanted = experiment.view_count == 0 ? count : std::min(experiment.view_count, count);
  for (int i = 0; i < wanted; ++i) out.push_back(i * count / wanted);
  return out;
}

}  // namespace volumark
