#include "reports/pairs_table.h"

#include <fmt/format.h>

#include "reports/series_name.h"
#include "reports/text_table.h"

namespace volumark {
namespace {

std::string name_of(const PairRow& row, const std::string& verdict) {
  return verdict == "a" ? row.a.method : verdict == "b" ? row.b.method : verdict;
}

}  // namespace

std::string pairs_text(const Results& results) {
  if (results.pairs.empty()) return {};
  std::vector<TextRow> rows = {{"scene", "backend", "a", "b", "closer", "faster", "rmse", "max", "flip p99"}};
  for (const PairRow& row : results.pairs)
    rows.push_back({row.a.scene, row.a.backend, row.a.method + series_suffix(results, row.a),
                    row.b.method + series_suffix(results, row.b), name_of(row, row.error_verdict),
                    name_of(row, row.time_verdict), fmt::format("{:.2e}", row.rmse), fmt::format("{:.2e}", row.max),
                    fmt::format("{:.3f}", row.flip_p99)});
  return "\nMethod against method, each at its finest: the two pictures with each other (rmse, max, flip p99), and "
         "which is\n"
         "closer to the reference, which faster, where the intervals part\n\n" +
         text_table(rows, 6);
}

}  // namespace volumark
