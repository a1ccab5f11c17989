// The rows that say what effects cost, put into order and words for the first screen and the details.
#pragma once

#include <string>
#include <vector>

#include "reports/results.h"

namespace volumark::html {

std::vector<std::string> effect_backends(const Results& results);  // in order of appearance

// For each scene, method, backend and effect one row: what the effect costs in the scene as it is (leave_one_out), or
// else alone.
std::vector<const EffectRow*> one_row_an_effect(const Results& results);

std::string stats_text(const Stats& stats);  // median in ms, or "-"
// The method left the effect out (--ignore-effects): with and without are the same picture.
bool is_ignored(const Results& results, const EffectRow& row);
std::string change_text(const Results& results, const EffectRow& row);  // "+22 %", "within noise", "ignored"
std::string instructions_text(const EffectRow& row);                    // "412 / 388", or "-"

}  // namespace volumark::html
