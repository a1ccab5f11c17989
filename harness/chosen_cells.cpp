#include "harness/chosen_cells.h"

#include <algorithm>
#include <map>

#include "reports/analysis.h"

namespace volumark {
namespace {

int off_defaults(const Group& group, const std::string& apart) {
  const Values defaults = default_values(group.method->info().parameters);
  return static_cast<int>(std::count_if(defaults.begin(), defaults.end(), [&](const auto& entry) {
    return entry.first != apart && group.values.at(entry.first) != entry.second;
  }));
}

// The last of the least, by method and backend, in the order of the plan.
template <class Cost, class Accept>
std::vector<PlannedCell> least_of_each(std::span<const Group> groups, const Cost& cost, const Accept& accept) {
  std::vector<PlannedCell> out;
  std::vector<int> costs;
  for (const Group& group : groups)
    for (const Cell& cell : group.cells) {
      if (!cell.key.variant.empty() || !accept(cell)) continue;
      const int here = cost(group);
      const auto found = std::find_if(out.begin(), out.end(), [&](const PlannedCell& other) {
        return other.group->method == group.method && other.cell->backend == cell.backend;
      });
      if (found == out.end()) {
        out.push_back({&group, &cell});
        costs.push_back(here);
        continue;
      }
      int& least = costs[static_cast<size_t>(found - out.begin())];
      if (here > least) continue;
      *found = {&group, &cell};
      least = here;
    }
  return out;
}

}  // namespace

const Result* find_result(const Results& results, const CellKey& key) {
  const auto found =
      std::find_if(results.results.begin(), results.results.end(), [&](const Result& r) { return r.key == key; });
  return found == results.results.end() ? nullptr : &*found;
}

std::vector<PlannedCell> usual_cells(std::span<const Group> groups, const Results& results) {
  return least_of_each(
      groups, [](const Group& group) { return off_defaults(group, ""); },
      [&](const Cell& cell) {
        const Result* result = find_result(results, cell.key);
        return result != nullptr && error_counts(*result) && result->metrics;
      });
}

std::vector<PlannedCell> finest_cells(std::span<const Group> groups) {
  return least_of_each(
      groups, [](const Group& group) { return off_defaults(group, group.quality ? group.quality->parameter : ""); },
      [](const Cell&) { return true; });
}

}  // namespace volumark
