// Claims of papers about cells of an experiment: data and a small fixed set of rules, no code per paper. Each claim is
// judged on every backend apart, so that software is never held against hardware.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/results.h"

namespace volumark {

// Cells of one experiment. An empty list or text chooses all; `params` names values, the others are free.
struct CellSelector {
  std::vector<std::string> scenes;
  std::string method;
  Params params;
  std::string measure;  // instead of the claim's own; empty: the claim's
};

enum class ClaimRule { Exact, Ratio, Order, Shape, Absolute };
const char* to_string(ClaimRule rule);  // exact, ratio, order, shape, absolute

// exact     of = expected, in every cell
// ratio     of / against within the limits; several pairs: geometric mean
// order     of < against, pair by pair
// shape     of, in every cell, within the limits; or the exponent of of ~ over^p, where `over` names a numeric
//           parameter
// absolute  of, or of / against: shown, never judged
struct ClaimSpec {
  std::string id, text;
  ClaimRule rule = ClaimRule::Exact;
  std::string measure, per;  // per: another measure of the same cell, that divides; empty: 1
  CellSelector of;
  std::optional<CellSelector> against;
  std::string over;
  double expected = 0;                                // NaN: not stated
  std::optional<double> limit_lo, limit_hi;           // what the value must lie within
  size_t cells = 0;                                   // that `of` chooses on each backend; fewer: the claim is unknown
  std::map<std::string, std::string> not_comparable;  // backend -> why nothing can be said there
};

// What the paper prints for the cells that `where` chooses.
struct PaperSpec {
  CellSelector where;
  std::string table, cell, unit, measure;
  double published = 0;  // NaN: a plot without numbers
};

struct Claims {
  std::string paper;  // key, "rezksalama2000"; empty where the experiment is of no paper
  std::vector<PaperSpec> cells;
  std::vector<ClaimSpec> claims;
};

// Not of variants, which draw another picture.
bool matches(const CellSelector& selector, const CellKey& key);

// The one cell of `against` that `cell` is held against: on the same backend, on the same scene unless each of the two
// selectors names one, and with the same value of each
// parameter that none of the two selectors names, where both are of one method. Null: none, or several.
const CellKey* partner(const CellKey& cell, const CellSelector& of, const CellSelector& against,
                       const std::vector<CellKey>& keys);

// One claim on one backend, from those of `results` that are of `experiment`. A cell that is missing or has no such
// figure makes it unknown, with the reason.
Claim judge(const ClaimSpec& spec, const std::string& paper, const std::string& experiment, const std::string& backend,
            const Results& results);

// Puts Result::paper and Results::claims of this experiment in place of what was there. `backends`: those to judge on.
void judge_claims(Results& results, const Claims& claims, const std::string& experiment,
                  const std::vector<std::string>& backends);

}  // namespace volumark
