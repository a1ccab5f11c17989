#include "reports/analysis.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace volumark {

double error_value(const ErrorMetrics& errors, const std::string& metric) {
  if (metric == "rmse") return errors.rmse;
  if (metric == "max") return errors.max;
  if (metric == "mae") return errors.mae;
  if (metric == "flip_mean") return errors.flip_mean;
  if (metric == "flip_p99") return errors.flip_p99;
  if (metric == "ciede2000_p99") return errors.ciede2000_p99;
  if (metric == "dssim") return 1 - errors.ssim;
  if (metric == "bias") return std::max({std::abs(errors.bias[0]), std::abs(errors.bias[1]), std::abs(errors.bias[2])});
  throw ResultsError("unknown error metric '" + metric + "'");
}

bool a_view_shows_nothing(const Result& result) {
  return std::any_of(result.views.begin(), result.views.end(),
                     [](const ViewResult& view) { return view.shows_nothing; });
}

bool error_counts(const Result& result) {
  const bool drawn = result.outcome == Outcome::Ok || result.outcome == Outcome::WrongImage;
  return drawn && result.error && result.error->worst.non_finite == 0 && result.ignored_effects.empty();
}

namespace {

bool is_ranked(const Result& result) {
  return error_counts(result) && result.metrics && result.key.variant.empty() &&
         !std::all_of(result.views.begin(), result.views.end(),
                      [](const ViewResult& view) { return view.shows_nothing; });
}

}  // namespace

std::optional<CostPoint> cost_point(const Results& results, size_t index, const std::string& error_metric,
                                    bool cpu_time) {
  const Result& result = results.results[index];
  if (!is_ranked(result)) return std::nullopt;
  const Stats& stats = cpu_time ? result.metrics->frame_cpu.stats : result.metrics->frame_wall.stats;
  const double error = error_value(result.error->worst, error_metric);
  if (stats.count == 0 || !(stats.median > 0) || !std::isfinite(error)) return std::nullopt;
  // RMSE and the like cannot be told apart below the largest pixel bound.
  const bool on_pixels = error_metric == "rmse" || error_metric == "max" || error_metric == "mae";
  double largest_bound = 0, lo = error, hi = error;
  for (const ViewResult& view : result.views) {
    if (view.shows_nothing) continue;
    const double bound = on_pixels && view.reference ? view.reference->bound : 0;
    largest_bound = std::max(largest_bound, bound);
    const double of_view = view.error ? error_value(*view.error, error_metric) : error;
    if (!std::isfinite(of_view)) continue;
    lo = std::min(lo, std::max(0.0, of_view - bound));
    hi = std::max(hi, of_view + bound);
  }
  const double counted = std::max(error, largest_bound);
  return CostPoint{stats.median, stats.median_lo, stats.median_hi, counted, lo, std::max(hi, counted), index};
}

std::vector<size_t> pareto_front(std::span<const CostPoint> points) {
  std::vector<size_t> order(points.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    if (points[a].time != points[b].time) return points[a].time < points[b].time;
    if (points[a].error != points[b].error) return points[a].error < points[b].error;
    return a < b;
  });
  std::vector<size_t> front;
  for (const size_t i : order)
    if (front.empty() || points[i].error < points[front.back()].error) front.push_back(i);
  return front;
}

std::vector<Front> fronts(const Results& results, const std::string& experiment, const std::string& scene,
                          const std::string& error_metric) {
  std::vector<Front> out;
  const auto of = [&](const std::string& method, const std::string& backend, bool software) -> Front& {
    for (Front& front : out)
      if (front.method == method && front.backend == backend && front.software == software) return front;
    return out.emplace_back(Front{method, backend, software, {}});
  };
  for (const int kind : {0, 1, 2, 3})
    for (size_t i = 0; i < results.results.size(); ++i) {
      const CellKey& key = results.results[i].key;
      if (key.experiment != experiment || key.scene != scene) continue;
      const auto point = cost_point(results, i, error_metric);
      if (!point) continue;
      const bool hardware =
          std::any_of(results.backends.begin(), results.backends.end(),
                      [&](const BackendResultInfo& info) { return info.id == key.backend && !info.software; });
      of(kind == 0 || kind == 1 ? key.method : "", kind == 0 || kind == 2 ? key.backend : "", !hardware)
          .points.push_back(*point);
    }
  for (Front& front : out) {
    std::vector<CostPoint> kept;
    for (const size_t i : pareto_front(front.points)) kept.push_back(front.points[i]);
    front.points = std::move(kept);
  }
  return out;
}

TimeToError time_to_error(std::span<const CostPoint> points, double target) {
  TimeToError out;
  out.best_error = std::numeric_limits<double>::infinity();
  const std::vector<size_t> front = pareto_front(points);
  if (front.empty()) return out;
  const CostPoint& best = points[front.back()];
  out.best_error = best.error;
  out.best_seconds = best.time;
  out.best = best.result;
  const auto reached = std::find_if(front.begin(), front.end(), [&](size_t i) { return points[i].error <= target; });
  if (reached == front.end()) return out;
  const CostPoint& fine = points[*reached];
  out.seconds = fine.time;
  out.coarse = out.fine = fine.result;
  if (reached == front.begin() || fine.error == target) return out;
  const CostPoint& coarse = points[*(reached - 1)];
  if (!(fine.error > 0) || !(target > 0)) return out;  // no logarithm: the measured cell stands
  const double along = std::log(coarse.error / target) / std::log(coarse.error / fine.error);
  out.seconds = std::exp(std::log(coarse.time) + along * std::log(fine.time / coarse.time));
  out.interpolated = true;
  out.coarse = coarse.result;
  return out;
}

}  // namespace volumark
