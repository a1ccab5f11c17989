#include "scenes/json_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "scenes/errors.h"
#include "scenes/nearest.h"

namespace volumark {
namespace {

using nlohmann::json;

std::string position_text(std::string_view text, size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  return fmt::format("{}:{}", line, before.size() - line_start + 1);
}

// Ours, thrown out of the parser's callback.
struct Refused {
  std::string message;
};

template <class Names>
std::string join(const Names& names) {
  std::string text;
  for (const char* name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

}  // namespace

json parse_json(std::string_view text, const std::string& path) {
  std::vector<std::set<std::string>> open;  // keys seen so far in each object that is open
  const auto callback = [&](int depth, json::parse_event_t event, json& value) {
    if (depth > 32) throw Refused{"nested deeper than 32 levels"};
    if (event == json::parse_event_t::object_start) open.emplace_back();
    if (event == json::parse_event_t::object_end) open.pop_back();
    if (event == json::parse_event_t::key && !open.back().insert(value.get<std::string>()).second) {
      throw Refused{fmt::format("key \"{}\" appears twice in one object", value.get<std::string>())};
    }
    return true;
  };
  try {
    return json::parse(text, callback);
  } catch (const Refused& refused) {
    throw SceneError(fmt::format("{}: {}", path, refused.message));
  } catch (const json::parse_error& error) {
    // The library's text: "[json.exception...] parse error at line L, column C: what"; the position is made here.
    std::string what = error.what();
    const size_t start = what.find("syntax error");
    if (start != std::string::npos) what = what.substr(start);
    throw SceneError(fmt::format("{}:{}: {}", path, position_text(text, error.byte > 0 ? error.byte - 1 : 0), what));
  } catch (const json::out_of_range& error) {
    const std::string what = error.what();  // "... number overflow parsing 'NUMBER'"
    const size_t open_quote = what.find('\''), close_quote = what.rfind('\'');
    size_t byte = 0;
    if (open_quote != std::string::npos && close_quote > open_quote) {
      byte = text.find(what.substr(open_quote + 1, close_quote - open_quote - 1));
    }
    throw SceneError(fmt::format("{}:{}: a number is too large for double precision", path, position_text(text, byte)));
  }
}

void JsonNode::fail(const std::string& message) const {
  throw SceneError(fmt::format("{}: {}: {}", *file_, pointer_.empty() ? "/" : pointer_, message));
}

std::string JsonNode::found() const {
  if (value_->is_object()) return "an object";
  if (value_->is_array()) return fmt::format("an array of {}", value_->size());
  std::string text = value_->dump();
  if (text.size() > 60) text = text.substr(0, 60) + "...";
  return text;
}

double JsonNode::number(double lo, double hi, bool above) const {
  const bool bounded = lo > -std::numeric_limits<double>::max() || hi < std::numeric_limits<double>::max();
  const auto expected = [&] {
    std::string text = "expected a number";
    if (lo > -std::numeric_limits<double>::max()) text += fmt::format(" {} {}", above ? ">" : ">=", lo);
    if (hi < std::numeric_limits<double>::max()) {
      text += fmt::format("{} <= {}", lo > -std::numeric_limits<double>::max() ? " and" : "", hi);
    }
    return text;
  };
  if (!value_->is_number()) fail(fmt::format("{}, found {}", expected(), found()));
  const double value = value_->get<double>();
  if (bounded && !(value >= lo && value <= hi && (!above || value > lo))) {
    fail(fmt::format("{}, found {}", expected(), found()));
  }
  return value;
}

int JsonNode::integer(int lo, int hi) const {
  if (!value_->is_number_integer() || value_->get<double>() < lo || value_->get<double>() > hi) {
    fail(fmt::format("expected a whole number from {} to {}, found {}", lo, hi, found()));
  }
  return value_->get<int>();
}

bool JsonNode::boolean() const {
  if (!value_->is_boolean()) fail("expected true or false, found " + found());
  return value_->get<bool>();
}

std::string JsonNode::string(bool may_be_empty) const {
  if (!value_->is_string() || (!may_be_empty && value_->get_ref<const std::string&>().empty())) {
    fail("expected a text, found " + found());
  }
  return value_->get<std::string>();
}

std::string JsonNode::one_of(std::initializer_list<const char*> names) const {
  const std::string written = value_->is_string() ? value_->get<std::string>() : std::string();
  if (std::find(names.begin(), names.end(), written) == names.end()) {
    fail(fmt::format("expected one of {}, found {}{}", join(names), found(),
                     did_you_mean(written, std::vector<std::string>(names.begin(), names.end()))));
  }
  return written;
}

glm::dvec3 JsonNode::vec3(double lo, double hi) const {
  if (!value_->is_array() || value_->size() != 3) fail("expected an array of 3 numbers, found " + found());
  const std::vector<JsonNode> parts = array();
  return {parts[0].number(lo, hi), parts[1].number(lo, hi), parts[2].number(lo, hi)};
}

glm::dvec3 JsonNode::direction() const {
  const glm::dvec3 v = vec3(-1e100, 1e100);
  const double length = glm::length(v);
  if (!(length > 1e-100)) fail("expected a direction that is not zero");
  return v / length;
}

std::vector<JsonNode> JsonNode::array(size_t least, size_t most) const {
  if (!value_->is_array()) fail("expected an array, found " + found());
  if (value_->size() < least || value_->size() > most) {
    fail(fmt::format("expected {} to {} entries, found {}", least, most, value_->size()));
  }
  std::vector<JsonNode> nodes;
  for (size_t i = 0; i < value_->size(); ++i)
    nodes.emplace_back((*value_)[i], fmt::format("{}/{}", pointer_, i), *file_);
  return nodes;
}

JsonObject::JsonObject(const JsonNode& node, std::initializer_list<const char*> keys)
    : JsonObject(node, std::span<const char* const>(keys.begin(), keys.size())) {}

JsonObject::JsonObject(const JsonNode& node, std::span<const char* const> keys) : node_(node) {
  if (!node.value_->is_object())
    node.fail(fmt::format("expected an object with {}, found {}", join(keys), node.found()));
  for (const auto& [key, value] : node.value_->items()) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    node.fail(fmt::format("unknown key \"{}\"{}; allowed: {}", key,
                          did_you_mean(key, std::vector<std::string>(keys.begin(), keys.end())), join(keys)));
  }
}

JsonNode JsonObject::at(const char* key) const {
  if (!has(key)) fail(fmt::format("missing key \"{}\"", key));
  return {(*node_.value_)[key], node_.pointer_ + "/" + key, *node_.file_};
}

std::optional<JsonNode> JsonObject::find(const char* key) const {
  return has(key) ? std::optional<JsonNode>(at(key)) : std::nullopt;
}

double JsonObject::number_or(const char* key, double fallback, double lo, double hi, bool above) const {
  return has(key) ? at(key).number(lo, hi, above) : fallback;
}

std::string JsonObject::exactly_one(std::initializer_list<const char*> keys) const {
  std::string which;
  for (const char* key : keys) {
    if (!has(key)) continue;
    if (!which.empty()) fail(fmt::format("\"{}\" and \"{}\" exclude each other", which, key));
    which = key;
  }
  if (which.empty()) fail(fmt::format("expected one of the keys {}", join(keys)));
  return which;
}

}  // namespace volumark
