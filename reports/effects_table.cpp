#include "reports/effects_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/tables.h"
#include "reports/text_table.h"

namespace volumark {
namespace {

std::string change(const EffectRow& row) {
  if (row.with.count == 0 || row.without.count == 0 || !(row.without.median > 0)) return "-";
  const std::string percent = fmt::format("{:+.1f} %", 100 * (row.with.median / row.without.median - 1));
  return row.time_differs ? percent : percent + " (noise)";
}

std::string instructions(const EffectRow& row) {
  if (row.instructions_with == 0) return "-";
  return fmt::format("{} / {}", row.instructions_with, row.instructions_without);
}

// The parameters in which rows of one scene, method, backend and effect differ.
std::string parameters(const Results& results, const EffectRow& row) {
  std::string out;
  for (const auto& [name, value] : row.key.params) {
    const bool varies = std::any_of(results.effects.begin(), results.effects.end(), [&, n = name](const auto& other) {
      const auto found = other.key.params.find(n);
      return other.key.experiment == row.key.experiment && other.key.method == row.key.method &&
             found != other.key.params.end() && found->second != row.key.params.at(n);
    });
    if (varies)
      out += fmt::format(" {}={}", name, std::visit([](const auto& v) { return fmt::format("{}", v); }, value));
  }
  return out;
}

}  // namespace

std::string effects_table(const Results& results) {
  if (results.effects.empty()) return {};
  std::vector<TextRow> rows = {{"scene", "method", "backend", "effect", "against", "with", "without", "change",
                                "instructions", "rmse", "flip p99"}};
  for (const EffectRow& row : results.effects)
    rows.push_back({row.key.scene, row.key.method + parameters(results, row), row.key.backend, row.effect,
                    row.mode == "single" ? "it alone, none" : "all, all but it", seconds_text(row.with.median),
                    seconds_text(row.without.median), change(row), instructions(row), fmt::format("{:.1e}", row.rmse),
                    fmt::format("{:.3f}", row.flip_p99)});
  return "\nWhat effects cost (time a frame and SPIR-V instructions, with / without; rmse and FLIP between the two "
         "pictures, worst\nview; noise: the intervals of the two times touch; the cpu backend runs twins of the GLSL "
         "that is counted)\n\n" +
         text_table(rows, 5);
}

}  // namespace volumark
