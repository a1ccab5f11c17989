// Typed parameters of a method. One object declares a parameter (name, unit, doc, default, range) and reads it.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "scenes/nearest.h"

namespace volumark {

using Value = std::variant<bool, int64_t, double, std::string>;
using Values = std::map<std::string, Value, std::less<>>;  // complete: every parameter of the method has its value

// A usage error: unknown name (with the nearest one), wrong type, out of range.
class ParameterError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// What the command line, the docs and the results need to know of a parameter.
struct ParameterInfo {
  std::string name, unit, doc;
  Value default_value;
  double lo = 0, hi = 0;             // numbers: inclusive range
  std::vector<std::string> choices;  // strings: the allowed values
  bool quality_axis = false;         // what buys accuracy with time; at most one a method
  std::vector<double> sweep;         // quality axis: values from coarse to fine
  // Where an error comes from: the value at which this parameter adds none that matters, and what it stands for
  // ("step", "target format", "volume texture", ...). None: the parameter does not bear on the error.
  std::optional<Value> ideal;
  std::string aspect;
};

// What error attribution makes of a parameter (ParameterInfo::ideal and aspect).
template <class T>
struct Ideal {
  T value;
  const char* aspect;
};

class Number {
 public:
  struct Spec {
    const char* name;
    const char* unit;
    const char* doc;
    double def, lo, hi;
    std::vector<double> sweep = {};  // not empty: this is the quality axis
    std::optional<Ideal<double>> ideal = {};
  };
  explicit Number(Spec spec);
  double operator()(const Values& values) const;
  const ParameterInfo& info() const { return info_; }

 private:
  ParameterInfo info_;
};

class Integer {
 public:
  struct Spec {
    const char* name;
    const char* unit;
    const char* doc;
    int64_t def, lo, hi;
    std::vector<double> sweep = {};
    std::optional<Ideal<int64_t>> ideal = {};
  };
  explicit Integer(Spec spec);
  int64_t operator()(const Values& values) const;
  const ParameterInfo& info() const { return info_; }

 private:
  ParameterInfo info_;
};

class Flag {
 public:
  Flag(const char* name, const char* doc, bool def, std::optional<Ideal<bool>> ideal = {});
  bool operator()(const Values& values) const;
  const ParameterInfo& info() const { return info_; }

 private:
  ParameterInfo info_;
};

class Choice {
 public:
  Choice(const char* name, const char* doc, std::vector<std::string> choices, const char* def,
         std::optional<Ideal<const char*>> ideal = {});
  const std::string& operator()(const Values& values) const;
  size_t index(const Values& values) const;  // position in `choices`
  const ParameterInfo& info() const { return info_; }

 private:
  ParameterInfo info_;
};

Values default_values(std::span<const ParameterInfo> parameters);
// Parses and checks `text` (as given to --set name=text) into values; throws ParameterError.
void set_value(std::span<const ParameterInfo> parameters, Values& values, const std::string& name,
               const std::string& text);
void set_value(std::span<const ParameterInfo> parameters, Values& values, const std::string& name,
               const nlohmann::json& value);
std::string to_string(const Value& value);

}  // namespace volumark
