#include "reports/html/effect_rows.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/html/format.h"

namespace volumark::html {

std::vector<std::string> effect_backends(const Results& results) {
  std::vector<std::string> out;
  for (const EffectRow& row : results.effects)
    if (std::find(out.begin(), out.end(), row.key.backend) == out.end()) out.push_back(row.key.backend);
  return out;
}

std::vector<const EffectRow*> one_row_an_effect(const Results& results) {
  std::vector<const EffectRow*> out;
  for (const EffectRow& row : results.effects) {
    const auto same = std::find_if(out.begin(), out.end(), [&](const EffectRow* other) {
      return other->key == row.key && other->effect == row.effect;
    });
    if (same == out.end())
      out.push_back(&row);
    else if (row.mode == "leave_one_out")
      *same = &row;
  }
  return out;
}

std::string stats_text(const Stats& stats) { return stats.count > 0 ? milliseconds(stats.median) : "-"; }

bool is_ignored(const Results& results, const EffectRow& row) {
  return std::any_of(results.results.begin(), results.results.end(), [&](const Result& cell) {
    return cell.key.experiment == row.key.experiment && cell.key.scene == row.key.scene &&
           cell.key.method == row.key.method && cell.key.backend == row.key.backend &&
           std::find(cell.ignored_effects.begin(), cell.ignored_effects.end(), row.effect) !=
               cell.ignored_effects.end();
  });
}

std::string change_text(const Results& results, const EffectRow& row) {
  if (is_ignored(results, row)) return "ignored";
  if (row.with.count == 0 || row.without.count == 0 || !(row.without.median > 0)) return "-";
  if (!row.time_differs) return "within noise";
  return fmt::format("{:+.0f} %", 100 * (row.with.median / row.without.median - 1));
}

std::string instructions_text(const EffectRow& row) {
  if (row.instructions_with == 0 && row.instructions_without == 0) return "-";
  return fmt::format("{} / {}", row.instructions_with, row.instructions_without);
}

}  // namespace volumark::html
