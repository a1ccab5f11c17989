#include "harness/pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/frame.h"
#include "harness/metrics/metrics.h"
#include "harness/statistics.h"
#include "reports/analysis.h"

namespace volumark {
namespace {

double largest_difference(const Image& a, const Image& b) {
  double worst = 0;
  for (size_t i = 0; i < a.rgba.size(); ++i) {
    const double d = std::abs(static_cast<double>(a.rgba[i]) - static_cast<double>(b.rgba[i]));
    worst = std::isfinite(d) ? std::max(worst, d) : std::numeric_limits<double>::infinity();
  }
  return worst;
}

// Of fewer samples a view the interval of the median is no interval.
constexpr int64_t kLeastSamples = 3;

bool timed_well(const Result& result) {
  return result.metrics->frame_wall.stats.count >= kLeastSamples * static_cast<int64_t>(result.views.size());
}

// "a" or "b", whichever interval lies lower; "indistinguishable" where they touch.
std::string lower_of(const Interval& a, const Interval& b) {
  return a.hi < b.lo ? "a" : b.hi < a.lo ? "b" : "indistinguishable";
}

Interval error_interval(const Result& result, double bound, double noise) {
  const double error = result.error->worst.rmse, width = bound + noise;
  return {error - width, error + width};
}

Interval time_interval(const Result& result) {
  const Stats& stats = result.metrics->frame_wall.stats;
  return {stats.median_lo, stats.median_hi};
}

double largest_bound(const SceneContext& context) {
  double bound = 0;
  for (const auto& [view, info] : context.reference_infos) bound = std::max(bound, info.bound);
  return bound;
}

std::string reason_of(const Result& a, const Result& b, const PairRow& row) {
  const auto error = [&](const Result& result, double noise) {
    const double rmse = result.error->worst.rmse;
    return rmse <= row.bound ? fmt::format("{} is at the reference's bound", result.key.method)
                             : fmt::format("{} rmse {:.3g} +- {:.2g}", result.key.method, rmse, row.bound + noise);
  };
  const auto time = [](const Result& result) {
    const Stats& stats = result.metrics->frame_wall.stats;
    return fmt::format("{:.3g} ms [{:.3g}, {:.3g}]", 1e3 * stats.median, 1e3 * stats.median_lo, 1e3 * stats.median_hi);
  };
  return fmt::format("{}, {}; {} against {}", error(a, row.noise_a), error(b, row.noise_b), time(a), time(b));
}

bool measured(const Results& results, const CellKey& key) {
  const Result* result = find_result(results, key);
  return result != nullptr && error_counts(*result) && result->metrics && result->metrics->frame_wall.stats.count > 0;
}

}  // namespace

double repeat_noise(const DrawnCell& drawn, const SceneContext& context, const CellOptions& options) {
  for (const auto& [index, picture] : drawn.pictures) {
    const auto regions = context.regions.find(index);
    if (regions != context.regions.end() && regions->second.shows_nothing) continue;
    if (options.stop != nullptr && options.stop->load()) throw Interrupted{};
    Device device = make_device(drawn.planned.cell->backend, options.device);
    FrameSource source(context.scene, *drawn.planned.group->method, drawn.planned.group->values, device, context.width,
                       context.height);
    source.frame(context.scene.views[static_cast<size_t>(index)]);
    return largest_difference(picture, source.read_back());
  }
  return 0;
}

PairRow compare_methods(const DrawnCell& a, const DrawnCell& b, const SceneContext& context, const Results& results) {
  PairRow row;
  row.a = a.planned.cell->key;
  row.b = b.planned.cell->key;
  row.noise_a = a.noise;
  row.noise_b = b.noise;
  row.bound = largest_bound(context);
  CompareOptions options;
  options.background = context.scene.background;
  bool first = true;
  for (const auto& [view, picture] : a.pictures) {
    const auto other = b.pictures.find(view);
    if (other == b.pictures.end()) continue;
    const Errors errors = compare_images(picture, other->second, options);
    if (first || errors.rmse > row.rmse) row.view = view;
    first = false;
    row.rmse = std::max(row.rmse, errors.rmse);
    row.max = std::max(row.max, errors.max);
    row.flip_p99 = std::max(row.flip_p99, errors.flip_p99.value_or(0));
  }
  const Result &result_a = *find_result(results, row.a), &result_b = *find_result(results, row.b);
  row.error_verdict =
      lower_of(error_interval(result_a, row.bound, row.noise_a), error_interval(result_b, row.bound, row.noise_b));
  row.time_verdict = "indistinguishable";
  row.reason = reason_of(result_a, result_b, row);
  if (timed_well(result_a) && timed_well(result_b))
    row.time_verdict = lower_of(time_interval(result_a), time_interval(result_b));
  else
    row.reason += fmt::format("; times of fewer than {} samples a view are not told apart", kLeastSamples);
  return row;
}

std::vector<std::pair<PlannedCell, PlannedCell>> pairs_to_compare(std::span<const Group> groups,
                                                                  const Results& results) {
  std::vector<std::pair<PlannedCell, PlannedCell>> out;
  const std::vector<PlannedCell> cells = finest_cells(groups);
  for (size_t i = 0; i < cells.size(); ++i)
    for (size_t k = i + 1; k < cells.size(); ++k) {
      const CellKey &a = cells[i].cell->key, &b = cells[k].cell->key;
      if (a.backend != b.backend || !measured(results, a) || !measured(results, b)) continue;
      if (std::none_of(results.pairs.begin(), results.pairs.end(),
                       [&](const PairRow& row) { return row.a == a && row.b == b; }))
        out.emplace_back(cells[i], cells[k]);
    }
  return out;
}

}  // namespace volumark
