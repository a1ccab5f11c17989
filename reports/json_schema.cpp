#include "reports/json_schema.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

namespace volumark {
namespace {

using Json = nlohmann::json;

const std::set<std::string, std::less<>> kKnownKeywords = {"$schema",
                                                           "$id",
                                                           "$defs",
                                                           "$ref",
                                                           "title",
                                                           "description",
                                                           "type",
                                                           "enum",
                                                           "const",
                                                           "properties",
                                                           "required",
                                                           "additionalProperties",
                                                           "propertyNames",
                                                           "items",
                                                           "minItems",
                                                           "maxItems",
                                                           "minimum",
                                                           "maximum",
                                                           "exclusiveMinimum",
                                                           "minLength",
                                                           "pattern",
                                                           "if",
                                                           "then",
                                                           "else",
                                                           "allOf",
                                                           "anyOf"};

std::string shorten(const Json& value) {
  std::string text = value.dump();
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

bool has_type(const Json& value, const std::string& type) {
  if (type == "integer")
    return value.is_number_integer() ||
           (value.is_number_float() && std::floor(value.get<double>()) == value.get<double>());
  if (type == "number") return value.is_number();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "null") return value.is_null();
  if (type == "array") return value.is_array();
  if (type == "object") return value.is_object();
  throw std::invalid_argument("schema: unknown type '" + type + "'");
}

size_t code_points(const std::string& text) {
  size_t count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xc0U) != 0x80U;
  return count;
}

class Validator {
 public:
  explicit Validator(const Json& root) : root_(root) {}

  void check(const Json& schema, const Json& value, const std::string& at) {
    if (schema.is_boolean()) {
      if (!schema.get<bool>()) fault(at, "is not allowed here");
      return;
    }
    for (const auto& [keyword, unused] : schema.items())
      if (!kKnownKeywords.contains(keyword)) throw std::invalid_argument("schema: unknown keyword '" + keyword + "'");
    if (const auto ref = schema.find("$ref"); ref != schema.end())
      check(root_.at(Json::json_pointer(ref->get<std::string>().substr(1))), value, at);
    check_any_type(schema, value, at);
    if (value.is_object()) check_object(schema, value, at);
    if (value.is_array()) check_array(schema, value, at);
    if (value.is_number()) check_number(schema, value, at);
    if (value.is_string()) check_string(schema, value, at);
    check_combined(schema, value, at);
  }

  std::vector<SchemaFault> faults;

 private:
  void fault(const std::string& at, const std::string& message) { faults.push_back({at.empty() ? "/" : at, message}); }

  bool holds(const Json& schema, const Json& value) {
    Validator other(root_);
    other.check(schema, value, "");
    return other.faults.empty();
  }

  void check_any_type(const Json& schema, const Json& value, const std::string& at) {
    if (const auto type = schema.find("type"); type != schema.end()) {
      bool fits = false;
      std::string wanted;
      for (const Json& one : type->is_array() ? *type : Json::array({*type})) {
        fits = fits || has_type(value, one.get<std::string>());
        wanted += (wanted.empty() ? "" : " or ") + one.get<std::string>();
      }
      if (!fits) fault(at, "expected " + wanted + ", found " + shorten(value));
    }
    if (const auto allowed = schema.find("enum"); allowed != schema.end())
      if (std::find(allowed->begin(), allowed->end(), value) == allowed->end())
        fault(at, shorten(value) + " is none of " + allowed->dump());
    if (const auto constant = schema.find("const"); constant != schema.end() && *constant != value)
      fault(at, "expected " + shorten(*constant) + ", found " + shorten(value));
  }

  void check_object(const Json& schema, const Json& value, const std::string& at) {
    if (const auto required = schema.find("required"); required != schema.end())
      for (const Json& key : *required)
        if (!value.contains(key.get<std::string>())) fault(at, "key '" + key.get<std::string>() + "' is missing");
    const auto properties = schema.find("properties");
    const auto additional = schema.find("additionalProperties");
    const auto names = schema.find("propertyNames");
    for (const auto& [key, child] : value.items()) {
      const std::string where = (Json::json_pointer(at) / key).to_string();
      if (names != schema.end()) check(*names, key, where);
      if (properties != schema.end() && properties->contains(key)) {
        check((*properties)[key], child, where);
      } else if (additional != schema.end()) {
        if (additional->is_boolean() && !additional->get<bool>())
          fault(where, "unknown key '" + key + "'");
        else
          check(*additional, child, where);
      }
    }
  }

  void check_array(const Json& schema, const Json& value, const std::string& at) {
    if (const auto least = schema.find("minItems"); least != schema.end() && value.size() < least->get<size_t>())
      fault(at, "expected at least " + least->dump() + " elements, found " + std::to_string(value.size()));
    if (const auto most = schema.find("maxItems"); most != schema.end() && value.size() > most->get<size_t>())
      fault(at, "expected at most " + most->dump() + " elements, found " + std::to_string(value.size()));
    if (const auto items = schema.find("items"); items != schema.end())
      for (size_t i = 0; i < value.size(); ++i) check(*items, value[i], at + "/" + std::to_string(i));
  }

  void check_number(const Json& schema, const Json& value, const std::string& at) {
    const double number = value.get<double>();
    if (const auto least = schema.find("minimum"); least != schema.end() && !(number >= least->get<double>()))
      fault(at, shorten(value) + " is below " + least->dump());
    if (const auto most = schema.find("maximum"); most != schema.end() && !(number <= most->get<double>()))
      fault(at, shorten(value) + " is above " + most->dump());
    if (const auto least = schema.find("exclusiveMinimum"); least != schema.end() && !(number > least->get<double>()))
      fault(at, shorten(value) + " is not above " + least->dump());
  }

  void check_string(const Json& schema, const Json& value, const std::string& at) {
    const auto& text = value.get_ref<const std::string&>();
    if (const auto least = schema.find("minLength"); least != schema.end() && code_points(text) < least->get<size_t>())
      fault(at, least->get<size_t>() == 1 ? "is empty" : "is shorter than " + least->dump());
    if (const auto pattern = schema.find("pattern"); pattern != schema.end()) {
      const auto& expression = pattern->get_ref<const std::string&>();
      if (!std::regex_search(text, std::regex(expression, std::regex::ECMAScript)))
        fault(at, shorten(value) + " does not match " + expression);
    }
  }

  void check_combined(const Json& schema, const Json& value, const std::string& at) {
    if (const auto condition = schema.find("if"); condition != schema.end()) {
      const auto branch = schema.find(holds(*condition, value) ? "then" : "else");
      if (branch != schema.end()) check(*branch, value, at);
    }
    if (const auto all = schema.find("allOf"); all != schema.end())
      for (const Json& one : *all) check(one, value, at);
    if (const auto any = schema.find("anyOf"); any != schema.end())
      if (std::none_of(any->begin(), any->end(), [&](const Json& one) { return holds(one, value); }))
        fault(at, shorten(value) + " fits none of the alternatives");
  }

  const Json& root_;
};

}  // namespace

std::vector<SchemaFault> validate_json(const Json& schema, const Json& value) {
  Validator validator(schema);
  validator.check(schema, value, "");
  return std::move(validator.faults);
}

}  // namespace volumark
