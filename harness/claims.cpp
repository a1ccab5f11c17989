#include "harness/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "harness/statistics.h"
#include "reports/measures.h"

namespace volumark {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Why a claim cannot be judged on these results.
struct NotComparable {
  std::string why;
};

std::string short_name(const CellKey& key, const CellSelector& selector) {
  std::string out = key.scene + " " + key.method;
  for (const auto& [name, unused] : selector.params) {
    const auto found = key.params.find(name);
    if (found == key.params.end()) continue;
    out += " " + name + "=";
    std::visit([&](const auto& value) { out += fmt::format("{}", value); }, found->second);
  }
  return out;
}

// What one claim needs of the results, on one backend.
class Judge {
 public:
  Judge(const ClaimSpec& spec, const std::string& experiment, const std::string& backend, const Results& results)
      : spec_(spec), backend_(backend) {
    for (const Result& result : results.results)
      if (result.key.experiment == experiment && result.key.backend == backend) {
        cells_.push_back(&result);
        keys_.push_back(result.key);
      }
  }

  // Sets measured, its interval and the cells; throws NotComparable.
  void measure(Claim& claim) const;
  // Each cell of `of`, by name.
  std::vector<std::pair<std::string, Measured>> cells() const;
  // Of order: whether every pair stands as claimed. Fills the claim as measure() does.
  void compare(Claim& claim) const;

 private:
  std::vector<const Result*> chosen(const CellSelector& selector) const;
  Measured value_of(const Result& result, const CellSelector& selector) const;
  Measured figure(const Result& result, const CellSelector& selector, const std::string& name) const;
  const Result& partner_of(const Result& result) const;
  Measured exponent() const;

  const ClaimSpec& spec_;
  std::string backend_;
  std::vector<const Result*> cells_;
  std::vector<CellKey> keys_;
};

std::vector<const Result*> Judge::chosen(const CellSelector& selector) const {
  std::vector<const Result*> out;
  std::copy_if(cells_.begin(), cells_.end(), std::back_inserter(out),
               [&](const Result* result) { return matches(selector, result->key); });
  if (out.empty()) throw NotComparable{"its cells are not in these results"};
  if (&selector == &spec_.of && out.size() < spec_.cells)
    throw NotComparable{
        fmt::format("{} of its {} cells are not in these results", spec_.cells - out.size(), spec_.cells)};
  return out;
}

Measured Judge::figure(const Result& result, const CellSelector& selector, const std::string& name) const {
  const std::string cell = short_name(result.key, selector);
  if (result.outcome != Outcome::Ok && result.outcome != Outcome::WrongImage)
    throw NotComparable{fmt::format("{} is {}: {}", cell, to_string(result.outcome), result.reason)};
  if (!result.ignored_effects.empty())
    throw NotComparable{fmt::format("{} was drawn without {}", cell, fmt::join(result.ignored_effects, ", "))};
  const std::optional<Measured> found = measured(result, name);
  if (!found) throw NotComparable{fmt::format("{} has no {}", cell, name)};
  return *found;
}

Measured quotient(const Measured& a, const Measured& b, const std::string& what) {
  if (!(b.lo > 0)) throw NotComparable{"division by " + what + ", whose interval holds 0"};
  return {a.value / b.value, a.lo / b.hi, a.hi / b.lo};
}

Measured Judge::value_of(const Result& result, const CellSelector& selector) const {
  const Measured value = figure(result, selector, selector.measure.empty() ? spec_.measure : selector.measure);
  return spec_.per.empty() ? value : quotient(value, figure(result, selector, spec_.per), spec_.per);
}

const Result& Judge::partner_of(const Result& result) const {
  const CellKey* found = partner(result.key, spec_.of, *spec_.against, keys_);
  if (found == nullptr)
    throw NotComparable{short_name(result.key, spec_.of) + ": the cell to hold it against is not in these results"};
  return *cells_[static_cast<size_t>(found - keys_.data())];
}

double number_of(const ParamValue& value) {
  if (const auto* whole = std::get_if<int64_t>(&value)) return static_cast<double>(*whole);
  const auto* real = std::get_if<double>(&value);
  return real == nullptr ? kNaN : *real;
}

// One fit for each series (scene and all other parameters); of several the means of the exponents and their limits.
Measured Judge::exponent() const {
  std::map<std::pair<std::string, Params>, std::pair<std::vector<double>, std::vector<double>>> series;
  for (const Result* result : chosen(spec_.of)) {
    Params others = result->key.params;
    const auto over = others.find(spec_.over);
    if (over == others.end()) throw NotComparable{result->key.method + " has no parameter " + spec_.over};
    const double x = number_of(over->second);
    others.erase(over);
    auto& [steps, values] = series[{result->key.scene, others}];
    steps.push_back(x);
    values.push_back(value_of(*result, spec_.of).value);
  }
  Measured out{0, 0, 0};
  const auto count = static_cast<double>(series.size());
  for (const auto& [name, points] : series) {
    const OrderFit fit = fit_power(points.first, points.second);
    if (fit.points == 0) throw NotComparable{name.first + ": fewer than three points above 0 to fit"};
    out.value += fit.order / count;
    out.lo += fit.lo / count;
    out.hi += fit.hi / count;
  }
  return out;
}

std::vector<std::pair<std::string, Measured>> Judge::cells() const {
  std::vector<std::pair<std::string, Measured>> out;
  for (const Result* result : chosen(spec_.of))
    out.emplace_back(short_name(result->key, spec_.of), value_of(*result, spec_.of));
  return out;
}

void put(Claim& claim, const Measured& measured) {
  claim.measured = measured.value;
  claim.measured_lo = measured.lo;
  claim.measured_hi = measured.hi;
}

void Judge::measure(Claim& claim) const {
  const std::vector<const Result*> first = chosen(spec_.of);
  for (const Result* result : first) claim.cells.push_back(result->key);
  if (!spec_.over.empty()) return put(claim, exponent());
  std::vector<Measured> values;
  for (const Result* result : first) {
    Measured value = value_of(*result, spec_.of);
    if (spec_.against) {
      const Result& other = partner_of(*result);
      claim.cells.push_back(other.key);
      value = quotient(value, value_of(other, *spec_.against), short_name(other.key, *spec_.against));
    }
    values.push_back(value);
  }
  if (values.size() == 1) return put(claim, values.front());
  if (spec_.rule == ClaimRule::Exact) {  // every cell must be it: the one that is farthest off speaks for all
    return put(claim, *std::max_element(values.begin(), values.end(), [&](const Measured& a, const Measured& b) {
                 return std::abs(a.value - spec_.expected) < std::abs(b.value - spec_.expected);
               }));
  }
  if (!spec_.against && std::any_of(values.begin(), values.end(), [](const Measured& v) { return !(v.lo > 0); })) {
    put(claim, *std::max_element(values.begin(), values.end(),
                                 [](const Measured& a, const Measured& b) { return a.value < b.value; }));
    claim.reason = fmt::format("largest of {} cells", values.size());  // a 0 has no geometric mean
    return;
  }
  // The ends of the interval are combined as if all were at their ends at once: never too narrow.
  Measured mean{0, 0, 0};
  const auto count = static_cast<double>(values.size());
  for (const Measured& value : values) {
    if (!(value.lo > 0)) throw NotComparable{"a value's interval holds 0: no geometric mean"};
    mean.value += std::log(value.value) / count;
    mean.lo += std::log(value.lo) / count;
    mean.hi += std::log(value.hi) / count;
  }
  put(claim, {std::exp(mean.value), std::exp(mean.lo), std::exp(mean.hi)});
  claim.reason = fmt::format("geometric mean over {} {}", values.size(), spec_.against ? "pairs" : "cells");
}

void Judge::compare(Claim& claim) const {
  try {
    measure(claim);                 // the ratio, for the reader
  } catch (const NotComparable&) {  // no ratio to a 0: the order can stand all the same
  }
  claim.reason.clear();
  claim.cells.clear();
  size_t pairs = 0, apart = 0;
  std::string reversed, touching;
  for (const Result* result : chosen(spec_.of)) {
    const Result& other = partner_of(*result);
    claim.cells.insert(claim.cells.end(), {result->key, other.key});
    const Measured less = value_of(*result, spec_.of), more = value_of(other, *spec_.against);
    ++pairs;
    const std::string name = short_name(result->key, spec_.of);
    if (less.hi < more.lo)
      ++apart;
    else if (less.lo > more.hi)
      reversed += (reversed.empty() ? "" : ", ") + name;
    else
      touching += (touching.empty() ? "" : ", ") + name;
  }
  claim.verdict = !reversed.empty() ? "fails" : !touching.empty() ? "unknown" : "holds";
  claim.reason = fmt::format("{} of {} pairs stand as claimed", apart, pairs);
  if (!reversed.empty()) claim.reason += "; the other way round: " + reversed;
  if (!touching.empty()) claim.reason += "; intervals touch: " + touching;
}

std::string limits_text(const ClaimSpec& spec) {
  if (!spec.limit_lo) return fmt::format("at most {:.4g}", *spec.limit_hi);
  if (!spec.limit_hi) return fmt::format("at least {:.4g}", *spec.limit_lo);
  return fmt::format("{:.4g}..{:.4g}", *spec.limit_lo, *spec.limit_hi);
}

void decide(const ClaimSpec& spec, Claim& claim) {
  const std::string how = claim.reason.empty() ? "" : "; " + claim.reason;
  if (spec.rule == ClaimRule::Exact) {
    const double rounding = 1e-12 * std::max(1.0, std::abs(spec.expected));
    claim.verdict = std::abs(claim.measured - spec.expected) <= rounding ? "holds" : "fails";
    claim.reason = fmt::format("{:.12g}, must be {:.12g}", claim.measured, spec.expected);
    return;
  }
  const double lo = spec.limit_lo.value_or(-std::numeric_limits<double>::infinity());
  const double hi = spec.limit_hi.value_or(std::numeric_limits<double>::infinity());
  const std::string interval = claim.measured_lo == claim.measured_hi
                                   ? fmt::format("{:.4g}", claim.measured)
                                   : fmt::format("{:.4g}..{:.4g}", claim.measured_lo, claim.measured_hi);
  const std::string limits = limits_text(spec);
  if (claim.measured_lo >= lo && claim.measured_hi <= hi) {
    claim.verdict = "holds";
    claim.reason = fmt::format("{}, as it must be: {}{}", interval, limits, how);
  } else if (claim.measured_hi < lo || claim.measured_lo > hi) {
    claim.verdict = "fails";
    claim.reason = fmt::format("{}, must be {}{}", interval, limits, how);
  } else {
    claim.verdict = "unknown";
    claim.reason = fmt::format("the interval {} straddles a limit ({}): cannot be decided{}", interval, limits, how);
  }
}

// Cells apart, each within the limits or not: no mean may hide one of them.
void decide_each(const ClaimSpec& spec, const std::vector<std::pair<std::string, Measured>>& cells, Claim& claim) {
  std::string outside, straddling;
  const auto add = [](std::string& list, const std::string& name) { list += (list.empty() ? "" : "; ") + name; };
  for (const auto& [name, value] : cells) {
    Claim one;
    put(one, value);
    decide(spec, one);
    if (one.verdict == "fails") add(outside, name + ": " + one.reason);
    if (one.verdict == "unknown") add(straddling, name + ": " + one.reason);
  }
  claim.verdict = !outside.empty() ? "fails" : !straddling.empty() ? "unknown" : "holds";
  const std::string mean = claim.reason;
  claim.reason = !outside.empty() ? outside
                 : !straddling.empty()
                     ? straddling
                     : "each is as it must be: " + limits_text(spec) + (mean.empty() ? "" : "; " + mean);
}

std::string measure_text(const ClaimSpec& spec) {
  std::string out = spec.of.measure.empty() ? spec.measure : spec.of.measure;
  if (!spec.per.empty()) out += " per " + spec.per;
  if (!spec.over.empty()) out = "exponent of " + out + " over " + spec.over;
  if (spec.against) {
    out += spec.rule == ClaimRule::Order ? ", less / more" : ", ratio";
    if (!spec.against->measure.empty() && spec.against->measure != spec.measure) out += " to " + spec.against->measure;
  }
  return out;
}

}  // namespace

const char* to_string(ClaimRule rule) {
  constexpr const char* kNames[] = {"exact", "ratio", "order", "shape", "absolute"};
  return kNames[static_cast<size_t>(rule)];
}

bool matches(const CellSelector& selector, const CellKey& key) {
  if (!key.variant.empty()) return false;
  if (!selector.method.empty() && selector.method != key.method) return false;
  if (!selector.scenes.empty() &&
      std::find(selector.scenes.begin(), selector.scenes.end(), key.scene) == selector.scenes.end())
    return false;
  return std::all_of(selector.params.begin(), selector.params.end(), [&](const auto& wanted) {
    const auto found = key.params.find(wanted.first);
    return found != key.params.end() && found->second == wanted.second;
  });
}

const CellKey* partner(const CellKey& cell, const CellSelector& of, const CellSelector& against,
                       const std::vector<CellKey>& keys) {
  // Each of them names its one scene: an isosurface against the same data shown directly.
  const bool across = of.scenes.size() == 1 && against.scenes.size() == 1;
  const auto agrees = [&](const CellKey& key) {
    if (key.method != cell.method) return true;
    return std::all_of(cell.params.begin(), cell.params.end(), [&](const auto& param) {
      if (of.params.contains(param.first) || against.params.contains(param.first)) return true;
      const auto found = key.params.find(param.first);
      return found != key.params.end() && found->second == param.second;
    });
  };
  const CellKey* out = nullptr;
  for (const CellKey& key : keys) {
    if ((!across && key.scene != cell.scene) || key.backend != cell.backend) continue;
    if (!matches(against, key) || !agrees(key)) continue;
    if (out != nullptr) return nullptr;
    out = &key;
  }
  return out;
}

Claim judge(const ClaimSpec& spec, const std::string& paper, const std::string& experiment, const std::string& backend,
            const Results& results) {
  Claim claim{spec.id, spec.text, to_string(spec.rule), "unknown", "", kNaN, spec.expected};
  claim.paper = paper;
  claim.experiment = experiment;
  claim.backend = backend;
  claim.measure = measure_text(spec);
  claim.limit_lo = spec.limit_lo;
  claim.limit_hi = spec.limit_hi;
  claim.measured_lo = claim.measured_hi = kNaN;
  const auto excused = spec.not_comparable.find(backend);
  try {
    const Judge judge(spec, experiment, backend, results);
    if (spec.rule == ClaimRule::Order) {
      judge.compare(claim);
    } else {
      judge.measure(claim);
      const bool each = spec.rule == ClaimRule::Shape && spec.over.empty() && claim.cells.size() > 1;
      if (each) decide_each(spec, judge.cells(), claim);
      if (!each && spec.rule != ClaimRule::Absolute) decide(spec, claim);
    }
    if (spec.rule == ClaimRule::Absolute) {
      claim.verdict = "not_judged";
      claim.reason = "shown, not judged" + (claim.reason.empty() ? "" : "; " + claim.reason);
    } else if (excused != spec.not_comparable.end()) {
      claim.verdict = "unknown";
      claim.reason = excused->second;
    }
  } catch (const NotComparable& found) {
    claim.verdict = "unknown";
    claim.reason = found.why;
  }
  return claim;
}

void judge_claims(Results& results, const Claims& claims, const std::string& experiment,
                  const std::vector<std::string>& backends) {
  for (Result& result : results.results) {
    if (result.key.experiment != experiment) continue;
    result.paper.reset();
    for (const PaperSpec& spec : claims.cells)
      if (matches(spec.where, result.key))
        result.paper =
            PaperCell{claims.paper, spec.table, spec.cell, spec.unit, "absolute", spec.published, spec.measure};
  }
  std::erase_if(results.claims, [&](const Claim& old) { return old.experiment == experiment; });
  for (const ClaimSpec& spec : claims.claims)
    for (const std::string& backend : backends)
      results.claims.push_back(judge(spec, claims.paper, experiment, backend, results));
}

}  // namespace volumark
