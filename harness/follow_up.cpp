#include "harness/follow_up.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/convergence.h"

namespace volumark {

FollowUp::FollowUp(std::span<const Group> groups, const std::vector<Experiment>& experiments, Results& results)
    : groups_(groups), experiments_(experiments), results_(results), experiment_(*groups.front().experiment) {
  if (!experiment_.pairs) return;
  for (const PlannedCell& planned : finest_cells(groups)) finest_.insert(planned.cell);
}

bool FollowUp::complete() const {
  return (!experiment_.attribute || cells_to_attribute(groups_, results_).empty()) &&
         (!experiment_.pairs || pairs_to_compare(groups_, results_).empty());
}

void FollowUp::measured(const Cell& cell, const std::map<int, Image>& pictures) {
  std::erase_if(results_.attribution, [&](const Attribution& entry) { return entry.key == cell.key; });
  std::erase_if(results_.pairs, [&](const PairRow& row) { return row.a == cell.key || row.b == cell.key; });
  if (finest_.contains(&cell)) pictures_[&cell] = pictures;
}

void FollowUp::run(const SceneContext& context, const CellOptions& options, Progress& progress) {
  if (experiment_.attribute) fit_convergence(results_, experiments_);  // tells where errors stop falling
  if (complete()) return;
  if (context.want_references) context.want_references();  // no cell may have drawn: all were measured before
  if (context.missing || context.broken) return;
  if (experiment_.pairs) compare_pairs(context, options, progress);
  if (experiment_.attribute) attribute_cells(context, options, progress);
}

void FollowUp::attribute_cells(const SceneContext& context, const CellOptions& options, Progress& progress) {
  for (const PlannedCell& planned : cells_to_attribute(groups_, results_)) {
    const Instant start = now();
    Attribution entry = attribute(planned, context, options, results_);
    const std::string first = entry.parts.empty() ? entry.note
                                                  : fmt::format("{} is worth {:.0f} %", entry.parts.front().aspect,
                                                                100 * entry.parts[0].worth);
    progress.line(fmt::format("attribution {} {} {}: rmse {:.2e}, {} ({})", entry.key.scene, entry.key.method,
                              entry.key.backend, entry.error, first, duration_text(since(start).wall)));
    results_.attribution.push_back(std::move(entry));
  }
}

DrawnCell& FollowUp::drawn(const PlannedCell& cell, const SceneContext& context, const CellOptions& options,
                           Progress& progress) {
  const auto known = drawn_.find(cell.cell);
  if (known != drawn_.end()) return known->second;
  DrawnCell& out = drawn_[cell.cell];
  out.planned = cell;
  const auto kept = pictures_.find(cell.cell);
  out.pictures = kept == pictures_.end() ? draw_cell(*cell.group, *cell.cell, context, options) : kept->second;
  try {
    out.noise = repeat_noise(out, context, options);
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {  // it was drawn once before
    progress.line(fmt::format("{} {}: cannot be drawn a second time: {}", cell.cell->key.method, cell.cell->backend,
                              error.what()));
    out.pictures.clear();
  }
  return out;
}

void FollowUp::compare_pairs(const SceneContext& context, const CellOptions& options, Progress& progress) {
  for (const auto& [a, b] : pairs_to_compare(groups_, results_)) {
    const DrawnCell &one = drawn(a, context, options, progress), &other = drawn(b, context, options, progress);
    if (!one.pictures.empty() && !other.pictures.empty())
      results_.pairs.push_back(compare_methods(one, other, context, results_));
  }
}

}  // namespace volumark
