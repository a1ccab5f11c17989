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

std::optional<CostPoint> cost_point(const Results& results, size_t index, const std::string& error_metric,
                                    bool cpu_time) {
  const Result& result = results.results[index];
  if (result.outcome != Outcome::Ok && result.outcome != Outcome::WrongImage) return std::nullopt;
  if (!result.metrics || !result.error) return std::nullopt;
  const Stats& stats = cpu_time ? result.metrics->frame_cpu.stats : result.metrics->frame_wall.stats;
  const double error = error_value(result.error->worst, error_metric);
  if (stats.count == 0 || !(stats.median > 0) || !std::isfinite(error)) return std::nullopt;
  double bound = 0;  // RMSE and the like cannot be told apart below the largest pixel bound
  for (const ViewResult& view : result.views)
    if (view.reference) bound = std::max(bound, view.reference->bound);
  const bool on_pixels = error_metric == "rmse" || error_metric == "max" || error_metric == "mae";
  return CostPoint{stats.median, stats.median_lo, stats.median_hi, on_pixels ? std::max(error, bound) : error, index};
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

TimeToError time_to_error(std::span<const CostPoint> points, double target) {
  TimeToError out;
  out.best_error = std::numeric_limits<double>::infinity();
  const std::vector<size_t> front = pareto_front(points);
  if (front.empty()) return out;
  out.best_error = points[front.back()].error;
  out.best_seconds = points[front.back()].time;
  const auto reached = std::find_if(front.begin(), front.end(), [&](size_t i) { return points[i].error <= target; });
  if (reached == front.end()) return out;
  const CostPoint& fine = points[*reached];
  out.seconds = fine.time;
  if (reached == front.begin() || fine.error == target) return out;
  const CostPoint& coarse = points[*(reached - 1)];
  if (!(fine.error > 0) || !(target > 0)) return out;  // no logarithm: the measured cell stands
  const double along = std::log(coarse.error / target) / std::log(coarse.error / fine.error);
  out.seconds = std::exp(std::log(coarse.time) + along * std::log(fine.time / coarse.time));
  out.interpolated = true;
  return out;
}

}  // namespace volumark
