#include "harness/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "scenes/nearest.h"

namespace volumark {
namespace {

constexpr size_t kMostValues = 1000;  // of one sweep

[[noreturn]] void fail(const std::string& sweep, const std::string& message) {
  throw ParameterError(fmt::format("--sweep {}: {}", sweep, message));
}

double number_in(const std::string& text, const std::string& sweep) {
  try {
    size_t used = 0;
    const double value = std::stod(text, &used);
    if (used == text.size() && std::isfinite(value)) return value;
  } catch (const std::exception&) {  // said below
  }
  fail(sweep, fmt::format("\"{}\" is no number; a range is FROM..TO*FACTOR or FROM..TO+STEP", text));
}

// 0.30000000000000004 is 0.3.
std::string rounded(double value) { return fmt::format("{}", std::stod(fmt::format("{:.12g}", value))); }

// "4..0.25*0.5" or "1..3+0.5".
std::vector<std::string> spelt_out(const std::string& range, const std::string& sweep) {
  const size_t dots = range.find("..");
  const std::string rest = range.substr(dots + 2);
  const size_t sign = rest.find_first_of("*+", 1);
  if (sign == std::string::npos)
    fail(sweep, fmt::format("\"{}\" has no step; a range is FROM..TO*FACTOR or FROM..TO+STEP", range));
  const double from = number_in(range.substr(0, dots), sweep);
  const double to = number_in(rest.substr(0, sign), sweep);
  const double by = number_in(rest.substr(sign + 1), sweep);
  const bool factor = rest[sign] == '*';
  const auto at = [&](size_t k) {
    const auto n = static_cast<double>(k);
    return factor ? from * std::pow(by, n) : from + by * n;
  };
  if (factor && (!(by > 0) || from == 0))
    fail(sweep, fmt::format("\"{}\": the factor and the start must not be 0", range));
  const bool rising = at(1) > at(0);
  if (at(1) == at(0)) fail(sweep, fmt::format("the range \"{}\" never ends", range));
  const double slack = 1e-9 * std::max(std::abs(from), std::abs(to));  // the end belongs to the range
  std::vector<std::string> out;
  for (size_t k = 0; rising ? at(k) <= to + slack : at(k) >= to - slack; ++k) {
    if (k == kMostValues) fail(sweep, fmt::format("the range \"{}\" has more than {} values", range, kMostValues));
    out.push_back(rounded(at(k)));
  }
  if (out.empty() || (out.size() == 1 && from != to))
    fail(sweep, fmt::format("the range \"{}\" is empty: its step leads away from {} or beyond it", range, to));
  return out;
}

const ParameterInfo* parameter_of(const Method& method, const std::string& name) {
  for (const ParameterInfo& info : method.info().parameters)
    if (info.name == name) return &info;
  return nullptr;
}

bool chosen(const std::vector<std::string>& methods, const ExperimentMethod& entry) {
  return methods.empty() || std::find(methods.begin(), methods.end(), entry.method->info().name) != methods.end();
}

double as_double(const Value& value) {
  if (const auto* whole = std::get_if<int64_t>(&value)) return static_cast<double>(*whole);
  return std::get<double>(value);
}

// Typed values, in the order written.
std::vector<Value> typed_values(const Method& method, const Sweep& sweep) {
  std::vector<Value> out;
  for (const std::string& text : sweep.values) {
    Values values;
    try {
      set_value(method.info().parameters, values, sweep.parameter, text);
    } catch (const ParameterError& error) {
      fail(to_string(sweep), fmt::format("{} (of {})", error.what(), method.info().name));
    }
    const Value& value = values.at(sweep.parameter);
    if (std::find(out.begin(), out.end(), value) != out.end())
      fail(to_string(sweep), fmt::format("the value {} is named twice", text));
    out.push_back(value);
  }
  return out;
}

void replace_quality(ExperimentMethod& entry, const ParameterInfo& axis, const std::vector<Value>& values,
                     std::set<std::string>& remarks) {
  entry.sweep.clear();
  for (const Value& value : values) entry.sweep.push_back(as_double(value));
  const std::vector<double> written = entry.sweep;
  std::sort(entry.sweep.begin(), entry.sweep.end());
  if (axis.sweep.size() < 2 || axis.sweep.front() > axis.sweep.back())
    std::reverse(entry.sweep.begin(), entry.sweep.end());
  if (entry.sweep != written)
    remarks.insert(fmt::format("{} {}: put into order, coarse to fine: {}", entry.method->info().name, axis.name,
                               fmt::join(entry.sweep, ", ")));
}

bool same_entry(const ExperimentMethod& a, const ExperimentMethod& b) {
  return a.method == b.method && a.values == b.values && a.sweep == b.sweep;
}

void apply(Experiment& experiment, const Sweep& sweep, const std::vector<std::string>& methods,
           std::set<std::string>& remarks) {
  std::vector<ExperimentMethod> out;
  const auto add = [&](ExperimentMethod entry) {
    if (std::none_of(out.begin(), out.end(), [&](const auto& other) { return same_entry(entry, other); }))
      out.push_back(std::move(entry));
    if (out.size() > kMostCells)
      throw ParameterError(fmt::format("the sweeps make more than {} series; sweep fewer values", kMostCells));
  };
  for (const ExperimentMethod& entry : experiment.methods) {
    const ParameterInfo* info = chosen(methods, entry) ? parameter_of(*entry.method, sweep.parameter) : nullptr;
    if (info == nullptr) {
      add(entry);
      continue;
    }
    const std::vector<Value> values = typed_values(*entry.method, sweep);
    ExperimentMethod changed = entry;
    if (info->name == entry.quality_axis) {
      changed.values[info->name] = info->default_value;
      replace_quality(changed, *info, values, remarks);
      add(changed);
      continue;
    }
    for (const Value& value : values) {
      changed.values[info->name] = value;
      add(changed);
    }
  }
  experiment.methods = std::move(out);
}

void check_known(const std::vector<Experiment>& experiments, const Sweep& sweep,
                 const std::vector<std::string>& methods) {
  std::set<std::string> names;
  for (const Experiment& experiment : experiments)
    for (const ExperimentMethod& entry : experiment.methods)
      if (chosen(methods, entry))
        for (const ParameterInfo& info : entry.method->info().parameters) names.insert(info.name);
  if (names.contains(sweep.parameter)) return;
  const std::vector<std::string> known(names.begin(), names.end());
  fail(to_string(sweep), fmt::format("none of the chosen methods has a parameter \"{}\"{}; they have: {}",
                                     sweep.parameter, did_you_mean(sweep.parameter, known), fmt::join(known, ", ")));
}

}  // namespace

std::string to_string(const Sweep& sweep) {
  return fmt::format("{}={}", sweep.parameter, fmt::join(sweep.values, ","));
}

Sweep parse_sweep(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) fail(text, "expected NAME=VALUE,VALUE,... or NAME=FROM..TO*FACTOR");
  Sweep sweep{text.substr(0, equals), {}};
  for (size_t begin = equals + 1; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const std::string one = text.substr(begin, end - begin);
    begin = end + 1;
    if (one.empty()) fail(text, "expected a value before and after each comma, found none");
    const std::vector<std::string> values =
        one.find("..") == std::string::npos ? std::vector<std::string>{one} : spelt_out(one, text);
    for (const std::string& value : values) {
      if (std::find(sweep.values.begin(), sweep.values.end(), value) != sweep.values.end())
        fail(text, fmt::format("the value {} is named twice", value));
      sweep.values.push_back(value);
    }
  }
  if (sweep.values.size() > kMostValues) fail(sweep.parameter, fmt::format("more than {} values", kMostValues));
  return sweep;
}

std::vector<std::string> apply_sweeps(std::vector<Experiment>& experiments, const std::vector<Sweep>& sweeps,
                                      const std::vector<std::string>& methods) {
  std::set<std::string> remarks, seen;
  for (const Sweep& sweep : sweeps) {
    if (!seen.insert(sweep.parameter).second) fail(to_string(sweep), "this parameter is swept twice");
    check_known(experiments, sweep, methods);
    for (Experiment& experiment : experiments) {
      apply(experiment, sweep, methods, remarks);
      experiment.finest_limits.clear();
    }
  }
  return {remarks.begin(), remarks.end()};
}

}  // namespace volumark
