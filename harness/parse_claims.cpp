#include "harness/parse_claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include "reports/measures.h"
#include "scenes/errors.h"
#include "scenes/nearest.h"
#include "scenes/scene_io.h"

namespace volumark {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Whether the method draws what the scene shows; the planner leaves out a pair that does not. A scene that cannot be
// read is reported there, and taken for any.
bool draws(const Method& method, const std::string& scene) {
  try {
    return !display_reason(method, load_scene(scene));
  } catch (const SceneError&) {
    return true;
  }
}

// The cells of the experiment on one backend.
std::vector<CellKey> all_keys(const Experiment& experiment) {
  std::vector<CellKey> out;
  for (const std::string& scene : experiment.scenes)
    for (const ExperimentMethod& method : experiment.methods) {
      if (!draws(*method.method, scene)) continue;
      CellKey key{experiment.name,
                  std::filesystem::path(scene).stem().string(),
                  method.method->info().name,
                  experiment.backends.front(),
                  method.values,
                  ""};
      if (method.sweep.empty()) out.push_back(key);
      for (const double value : method.sweep) {
        set_value(method.method->info().parameters, key.params, method.quality_axis, nlohmann::json(value));
        out.push_back(key);
      }
    }
  return out;
}

class ClaimParser {
 public:
  explicit ClaimParser(const Experiment& experiment) : experiment_(experiment), keys_(all_keys(experiment)) {}

  PaperSpec paper_cell(const JsonNode& node) const;
  ClaimSpec claim(const JsonNode& node) const;

 private:
  CellSelector selector(const JsonNode& node) const;
  void parse_params(const JsonNode& node, CellSelector& out) const;
  void parse_limits(const JsonObject& object, const JsonNode& node, ClaimSpec& out) const;
  void check_pairs(const JsonNode& node, const ClaimSpec& spec) const;
  void check_fit(const JsonNode& node, const ClaimSpec& spec) const;
  std::vector<const CellKey*> chosen(const CellSelector& selector) const;

  const Experiment& experiment_;
  std::vector<CellKey> keys_;
};

void must_be_one_of(const JsonNode& node, const std::string& name, const char* what,
                    const std::set<std::string>& known) {
  if (known.contains(name)) return;
  const std::vector<std::string> names(known.begin(), known.end());
  node.fail(fmt::format("{} \"{}\" is not in this experiment{}; it has: {}", what, name, did_you_mean(name, names),
                        fmt::join(names, ", ")));
}

std::string measure_of(const JsonNode& node) {
  const std::string measure = node.string();
  if (const std::string fault = measure_fault(measure); !fault.empty()) node.fail(fault);
  return measure;
}

std::vector<const CellKey*> ClaimParser::chosen(const CellSelector& selector) const {
  std::vector<const CellKey*> out;
  for (const CellKey& key : keys_)
    if (matches(selector, key)) out.push_back(&key);
  return out;
}

void ClaimParser::parse_params(const JsonNode& node, CellSelector& out) const {
  if (!node.json().is_object()) node.fail("expected an object: parameter name -> value");
  if (out.method.empty()) node.fail("parameters are of a method: name it, since the experiment has several");
  const auto& parameters = find_method(out.method).info().parameters;
  Values values = default_values(parameters);
  for (const auto& [name, value] : node.json().items()) try {
      set_value(parameters, values, name, value);
      out.params[name] = values.at(name);
    } catch (const ParameterError& error) {
      JsonNode(value, node.pointer() + "/" + name, node.file()).fail(error.what());
    }
}

CellSelector ClaimParser::selector(const JsonNode& node) const {
  const JsonObject object(node, {"scene", "method", "params", "measure"});
  std::set<std::string> scenes, methods;
  for (const CellKey& key : keys_) {
    scenes.insert(key.scene);
    methods.insert(key.method);
  }
  CellSelector out;
  if (const auto scene = object.find("scene")) {
    const auto names = scene->json().is_array() ? scene->array(1) : std::vector<JsonNode>{*scene};
    for (const JsonNode& one : names) {
      must_be_one_of(one, one.string(), "scene", scenes);
      out.scenes.push_back(one.string());
    }
  }
  if (const auto method = object.find("method")) {
    must_be_one_of(*method, method->string(), "method", methods);
    out.method = method->string();
  } else if (methods.size() == 1) {
    out.method = *methods.begin();
  }
  if (const auto params = object.find("params")) parse_params(*params, out);
  if (const auto measure = object.find("measure")) out.measure = measure_of(*measure);
  if (chosen(out).empty()) node.fail("chooses no cell of this experiment");
  return out;
}

PaperSpec ClaimParser::paper_cell(const JsonNode& node) const {
  const JsonObject object(node, {"where", "table", "cell", "unit", "measure", "published"});
  PaperSpec out;
  out.where = selector(object.at("where"));
  if (!out.where.measure.empty()) object.at("where").fail("the measure stands beside \"where\", not in it");
  out.table = object.at("table").string();
  out.cell = object.at("cell").string();
  out.unit = object.at("unit").string();
  out.measure = "frame_wall";
  if (const auto measure = object.find("measure")) out.measure = measure_of(*measure);
  out.published = object.has("published") ? object.at("published").number() : kNaN;
  return out;
}

// What a ratio or a shape must lie within: "within": [lo, hi], one of which may be null; or "expected" and a relative
// "tolerance".
void ClaimParser::parse_limits(const JsonObject& object, const JsonNode& node, ClaimSpec& out) const {
  out.expected = kNaN;
  if (const auto expected = object.find("expected")) out.expected = expected->number();
  const auto within = object.find("within");
  const auto tolerance = object.find("tolerance");
  if (tolerance && !object.has("expected"))
    tolerance->fail("a tolerance is relative to \"expected\", which is missing");
  const bool limited = out.rule == ClaimRule::Ratio || out.rule == ClaimRule::Shape;
  if (!limited) {
    if (within) within->fail(fmt::format("the rule {} has no limits", to_string(out.rule)));
    if (tolerance) tolerance->fail(fmt::format("the rule {} has no tolerance", to_string(out.rule)));
    if (out.rule == ClaimRule::Exact && !object.has("expected")) node.fail("the rule exact needs \"expected\"");
    return;
  }
  if (within.has_value() == tolerance.has_value())
    node.fail("needs either \"within\": [lo, hi], or \"expected\" with \"tolerance\"");
  if (within) {
    const auto ends = within->array(2, 2);
    if (!ends[0].json().is_null()) out.limit_lo = ends[0].number();
    if (!ends[1].json().is_null()) out.limit_hi = ends[1].number();
    if (!out.limit_lo && !out.limit_hi) within->fail("one end at least must be a number");
    if (out.limit_lo && out.limit_hi && *out.limit_lo > *out.limit_hi) within->fail("the ends are in the wrong order");
    return;
  }
  const double wide = std::abs(out.expected) * tolerance->number(0, 10);
  out.limit_lo = out.expected - wide;
  out.limit_hi = out.expected + wide;
}

void ClaimParser::check_pairs(const JsonNode& node, const ClaimSpec& spec) const {
  for (const CellKey* key : chosen(spec.of)) {
    const CellKey* other = partner(*key, spec.of, *spec.against, keys_);
    if (other == nullptr)
      node.fail(
          fmt::format("for {} {} the second selector chooses no cell of its scene, or several: name more of the "
                      "parameters",
                      key->scene, key->method));
    if (other == key) node.fail(fmt::format("holds {} {} against itself", key->scene, key->method));
  }
}

void ClaimParser::check_fit(const JsonNode& node, const ClaimSpec& spec) const {
  std::map<std::pair<std::string, Params>, int> series;
  for (const CellKey* key : chosen(spec.of)) {
    Params others = key->params;
    const auto over = others.find(spec.over);
    if (over == others.end() || std::holds_alternative<bool>(over->second) ||
        std::holds_alternative<std::string>(over->second))
      node.fail(fmt::format("\"over\": {} has no numeric parameter \"{}\"", key->method, spec.over));
    others.erase(over);
    ++series[{key->scene, others}];
  }
  for (const auto& [name, count] : series)
    if (count < 3)
      node.fail(fmt::format("\"over\": an exponent needs three values of {} at least, {} has {}", spec.over, name.first,
                            count));
}

ClaimRule rule_of(const JsonNode& node) {
  const std::string name = node.one_of({"exact", "ratio", "order", "shape", "absolute"});
  for (const ClaimRule rule : {ClaimRule::Exact, ClaimRule::Ratio, ClaimRule::Order, ClaimRule::Shape})
    if (name == to_string(rule)) return rule;
  return ClaimRule::Absolute;
}

ClaimSpec ClaimParser::claim(const JsonNode& node) const {
  const JsonObject object(node, {"id", "text", "rule", "measure", "per", "of", "numerator", "denominator", "less",
                                 "more", "over", "expected", "tolerance", "within", "not_comparable"});
  ClaimSpec out;
  out.id = object.at("id").string();
  out.text = object.at("text").string();
  out.rule = rule_of(object.at("rule"));
  out.measure = measure_of(object.at("measure"));
  if (const auto per = object.find("per")) out.per = measure_of(*per);
  const bool order = out.rule == ClaimRule::Order;
  const bool two =
      order || out.rule == ClaimRule::Ratio || (out.rule == ClaimRule::Absolute && object.has("numerator"));
  for (const char* key : {"of", "numerator", "denominator", "less", "more"}) {
    const std::string name = key;
    const bool mine = order ? name == "less" || name == "more"
                      : two ? name == "numerator" || name == "denominator"
                            : name == "of";
    if (!mine && object.has(key)) object.at(key).fail(fmt::format("not of the rule {}", to_string(out.rule)));
  }
  out.of = selector(object.at(order ? "less" : two ? "numerator" : "of"));
  if (two) out.against = selector(object.at(order ? "more" : "denominator"));
  out.cells = chosen(out.of).size();
  parse_limits(object, node, out);
  if (const auto over = object.find("over")) {
    if (out.rule != ClaimRule::Shape) over->fail("an exponent is a shape");
    out.over = over->string();
    check_fit(node, out);
  }
  if (two) check_pairs(node, out);
  if (const auto excused = object.find("not_comparable")) {
    if (!excused->json().is_object()) excused->fail("expected an object: backend -> why");
    for (const auto& [name, why] : excused->json().items()) {
      const JsonNode child(why, excused->pointer() + "/" + name, excused->file());
      must_be_one_of(child, name, "backend", {experiment_.backends.begin(), experiment_.backends.end()});
      out.not_comparable[name] = child.string();
    }
  }
  return out;
}

}  // namespace

Claims parse_claims(const JsonObject& object, const Experiment& experiment) {
  Claims out;
  const ClaimParser parser(experiment);
  if (const auto paper = object.find("paper")) {
    const JsonObject of_paper(*paper, {"key", "cells"});
    out.paper = of_paper.at("key").string();
    if (const auto cells = of_paper.find("cells"))
      for (const JsonNode& one : cells->array(1)) out.cells.push_back(parser.paper_cell(one));
  }
  const auto claims = object.find("claims");
  if (!claims) return out;
  if (out.paper.empty()) claims->fail("claims are of a paper: \"paper\" is missing");
  for (const JsonNode& one : claims->array(1)) {
    out.claims.push_back(parser.claim(one));
    const std::string& id = out.claims.back().id;
    const auto same = [&](const ClaimSpec& spec) { return spec.id == id; };
    if (std::count_if(out.claims.begin(), out.claims.end(), same) > 1)
      one.fail(fmt::format("the id \"{}\" is there twice", id));
  }
  return out;
}

}  // namespace volumark
