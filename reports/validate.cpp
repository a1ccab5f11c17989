// The schema, and what a schema cannot say: samples agree with their statistics, no cell twice, every null explained.
#include <nlohmann/json.hpp>
#include <set>

#include "reports/json_schema.h"

namespace volumark {
namespace {

using Json = nlohmann::json;

void check_nulls(const Json& node, const std::string& inner, const std::string& outer, const Json& nulls,
                 std::vector<SchemaFault>& faults) {
  if (node.is_null() && !nulls.contains(inner)) faults.push_back({outer + inner, "null without a reason in 'nulls'"});
  if (node.is_array())
    for (size_t i = 0; i < node.size(); ++i)
      check_nulls(node[i], inner + "/" + std::to_string(i), outer, nulls, faults);
  if (node.is_object())
    for (const auto& [key, child] : node.items())
      check_nulls(child, (Json::json_pointer(inner) / key).to_string(), outer, nulls, faults);
}

void check_metric(const Json& metric, const std::string& at, std::vector<SchemaFault>& faults) {
  const size_t samples = metric["samples"].size();
  if (metric["views"].size() != samples)
    faults.push_back({at + "/views", "expected one view a sample: " + std::to_string(samples) + ", found " +
                                         std::to_string(metric["views"].size())});
  if (metric["stats"]["count"] != samples)
    faults.push_back({at + "/stats/count", "expected the number of samples, " + std::to_string(samples) + ", found " +
                                               metric["stats"]["count"].dump()});
}

bool points_to_null(const Json& json, const std::string& pointer) {
  try {
    return json.at(Json::json_pointer(pointer)).is_null();
  } catch (const Json::exception&) {  // no pointer at all, or to nothing
    return false;
  }
}

// `owner` holds `nulls`; `part` is what they speak of.
void check_all_nulls(const Json& owner, const Json& part, const std::string& at, std::vector<SchemaFault>& faults) {
  const Json nulls = owner.value("nulls", Json::object());
  check_nulls(part, "", at, nulls, faults);
  for (const auto& [pointer, unused] : nulls.items())
    if (!points_to_null(part, pointer)) faults.push_back({at + "/nulls", "'" + pointer + "' does not point to a null"});
}

void check_result(const Json& result, const std::string& at, std::vector<SchemaFault>& faults) {
  check_all_nulls(result, result, at, faults);
  const auto metrics = result.find("metrics");
  if (metrics == result.end()) return;
  check_metric((*metrics)["frame_wall"], at + "/metrics/frame_wall", faults);
  check_metric((*metrics)["frame_cpu"], at + "/metrics/frame_cpu", faults);
  for (const auto& [zone, metric] : (*metrics)["zones"].items())
    check_metric(metric, at + "/metrics/zones/" + zone, faults);
}

}  // namespace

std::vector<SchemaFault> validate_results(const Json& json) {
  static const Json schema = Json::parse(results_schema_text());
  std::vector<SchemaFault> faults = validate_json(schema, json);
  if (!faults.empty()) return faults;  // the checks below rely on the form
  Json rest = json;
  rest.erase("results");  // each explains its own
  check_all_nulls(json, rest, "", faults);
  std::set<std::string> seen;
  for (size_t i = 0; i < json["results"].size(); ++i) {
    const std::string at = "/results/" + std::to_string(i);
    check_result(json["results"][i], at, faults);
    if (!seen.insert(json["results"][i]["key"].dump()).second)
      faults.push_back({at + "/key", "a second result with this key"});
  }
  return faults;
}

}  // namespace volumark
