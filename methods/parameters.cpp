#include "methods/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace volumark {
namespace {

template <class T>
const T& value_of(const Values& values, const ParameterInfo& info) {
  const auto found = values.find(info.name);
  if (found == values.end()) throw ParameterError(fmt::format("parameter {} has no value", info.name));
  const T* value = std::get_if<T>(&found->second);
  if (value == nullptr) throw ParameterError(fmt::format("parameter {} has a value of the wrong type", info.name));
  return *value;
}

const ParameterInfo& find_parameter(std::span<const ParameterInfo> parameters, const std::string& name) {
  std::vector<std::string> names;
  for (const ParameterInfo& info : parameters) {
    if (info.name == name) return info;
    names.push_back(info.name);
  }
  throw ParameterError(fmt::format("unknown parameter \"{}\"{}; known: {}", name, did_you_mean(name, names),
                                   names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

std::string with_unit(const ParameterInfo& info, double value) {
  return info.unit.empty() ? fmt::format("{}", value) : fmt::format("{} {}", value, info.unit);
}

// For messages: never throws, whatever bytes a string holds.
std::string dump(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

const char* type_name(const ParameterInfo& info) {
  constexpr const char* kNames[] = {"true or false", "a whole number", "a number", "one of its choices"};
  return kNames[info.default_value.index()];
}

[[noreturn]] void wrong_type(const ParameterInfo& info, const std::string& found) {
  throw ParameterError(fmt::format("parameter {}: expected {}, found {}", info.name, type_name(info), found));
}

void check_range(const ParameterInfo& info, double value) {
  // Written so that a NaN is out of range.
  if (value >= info.lo && value <= info.hi) return;
  throw ParameterError(fmt::format("parameter {}: {} is out of range, expected {} to {}", info.name, value, info.lo,
                                   with_unit(info, info.hi)));
}

void check_choice(const ParameterInfo& info, const std::string& value) {
  if (std::find(info.choices.begin(), info.choices.end(), value) != info.choices.end()) return;
  throw ParameterError(fmt::format("parameter {}: unknown value \"{}\"{}; expected one of: {}", info.name, value,
                                   did_you_mean(value, info.choices), fmt::join(info.choices, ", ")));
}

template <class T>
void set_ideal(ParameterInfo& info, const std::optional<Ideal<T>>& ideal) {
  if (!ideal) return;
  info.ideal = ideal->value;
  info.aspect = ideal->aspect;
}

// A double that is a whole number in the range of int64_t: 2^63 itself is not.
bool is_whole(double value) { return value == std::floor(value) && value >= -0x1p63 && value < 0x1p63; }

}  // namespace

Number::Number(Spec spec)
    : info_{spec.name, spec.unit, spec.doc, spec.def, spec.lo, spec.hi, {}, !spec.sweep.empty(), spec.sweep, {}, {}} {
  set_ideal(info_, spec.ideal);
}
double Number::operator()(const Values& values) const { return value_of<double>(values, info_); }

Integer::Integer(Spec spec)
    : info_{spec.name,
            spec.unit,
            spec.doc,
            spec.def,
            static_cast<double>(spec.lo),
            static_cast<double>(spec.hi),
            {},
            !spec.sweep.empty(),
            spec.sweep,
            {},
            {}} {
  set_ideal(info_, spec.ideal);
}
int64_t Integer::operator()(const Values& values) const { return value_of<int64_t>(values, info_); }

Flag::Flag(const char* name, const char* doc, bool def, std::optional<Ideal<bool>> ideal)
    : info_{name, "", doc, def, 0, 0, {}, false, {}, {}, {}} {
  set_ideal(info_, ideal);
}
bool Flag::operator()(const Values& values) const { return value_of<bool>(values, info_); }

Choice::Choice(const char* name, const char* doc, std::vector<std::string> choices, const char* def,
               std::optional<Ideal<const char*>> ideal)
    : info_{name, "", doc, std::string(def), 0, 0, std::move(choices), false, {}, {}, {}} {
  if (!ideal) return;
  info_.ideal = std::string(ideal->value);
  info_.aspect = ideal->aspect;
}
const std::string& Choice::operator()(const Values& values) const { return value_of<std::string>(values, info_); }
size_t Choice::index(const Values& values) const {
  const std::string& value = (*this)(values);
  check_choice(info_, value);
  return static_cast<size_t>(std::find(info_.choices.begin(), info_.choices.end(), value) - info_.choices.begin());
}

Values default_values(std::span<const ParameterInfo> parameters) {
  Values values;
  for (const ParameterInfo& info : parameters) values[info.name] = info.default_value;
  return values;
}

void set_value(std::span<const ParameterInfo> parameters, Values& values, const std::string& name,
               const std::string& text) {
  const ParameterInfo& info = find_parameter(parameters, name);
  if (std::holds_alternative<std::string>(info.default_value)) {
    set_value(parameters, values, name, nlohmann::json(text));
    return;
  }
  // Numbers and flags are written as in JSON; a leading point is allowed.
  const std::string written = !text.empty() && text.front() == '.' ? "0" + text : text;
  const auto parsed = nlohmann::json::parse(written, nullptr, false);
  if (parsed.is_discarded()) wrong_type(info, fmt::format("\"{}\"", text));
  set_value(parameters, values, name, parsed);
}

void set_value(std::span<const ParameterInfo> parameters, Values& values, const std::string& name,
               const nlohmann::json& value) {
  const ParameterInfo& info = find_parameter(parameters, name);
  if (std::holds_alternative<bool>(info.default_value)) {
    if (!value.is_boolean()) wrong_type(info, dump(value));
    values[name] = value.get<bool>();
  } else if (std::holds_alternative<int64_t>(info.default_value)) {
    if (!value.is_number() || !is_whole(value.get<double>())) wrong_type(info, dump(value));
    check_range(info, value.get<double>());
    values[name] = static_cast<int64_t>(value.get<double>());
  } else if (std::holds_alternative<double>(info.default_value)) {
    if (!value.is_number()) wrong_type(info, dump(value));
    check_range(info, value.get<double>());
    values[name] = value.get<double>();
  } else {
    if (!value.is_string()) wrong_type(info, dump(value));
    check_choice(info, value.get<std::string>());
    values[name] = value.get<std::string>();
  }
}

std::string to_string(const Value& value) {
  return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

}  // namespace volumark
