#include "harness/statistics.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>

namespace volumark {
namespace {

double sorted_percentile(const std::vector<double>& sorted, double p) {
  const double position = std::clamp(p, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<size_t>(position);
  const size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

double median_in_place(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

// Two-sided 97.5 % point of Student's t.
double student_t(int freedom) {
  constexpr double kTable[] = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228};
  return freedom <= 10 ? kTable[freedom - 1] : 1.96 + 2.4 / freedom;
}

}  // namespace

double percentile(std::vector<double> samples, double p) {
  if (samples.empty()) throw std::invalid_argument("percentile of no samples");
  std::sort(samples.begin(), samples.end());
  return sorted_percentile(samples, p);
}

double median(std::vector<double> samples) {
  if (samples.empty()) throw std::invalid_argument("median of no samples");
  return median_in_place(samples);
}

namespace {

std::vector<std::vector<double>> by_stratum(std::span<const double> samples, std::span<const int64_t> strata) {
  if (samples.empty()) throw std::invalid_argument("statistics of no samples");
  if (!strata.empty() && strata.size() != samples.size()) throw std::invalid_argument("one stratum a sample expected");
  std::map<int64_t, std::vector<double>> groups;
  for (size_t i = 0; i < samples.size(); ++i) groups[strata.empty() ? 0 : strata[i]].push_back(samples[i]);
  std::vector<std::vector<double>> out;
  for (auto& [unused, group] : groups) out.push_back(std::move(group));
  return out;
}

}  // namespace

double typical(std::span<const double> samples, std::span<const int64_t> strata) {
  std::vector<std::vector<double>> groups = by_stratum(samples, strata);
  double sum = 0;
  for (std::vector<double>& group : groups) sum += median_in_place(group);
  return sum / static_cast<double>(groups.size());
}

Interval bootstrap_typical(std::span<const double> samples, std::span<const int64_t> strata, int resamples,
                           uint64_t seed) {
  const std::vector<std::vector<double>> groups = by_stratum(samples, strata);
  std::mt19937_64 random(seed);
  std::vector<double> figures, drawn;
  for (int r = 0; r < resamples; ++r) {
    double sum = 0;
    for (const std::vector<double>& group : groups) {
      drawn.clear();
      for (size_t i = 0; i < group.size(); ++i) drawn.push_back(group[random() % group.size()]);
      sum += median_in_place(drawn);
    }
    figures.push_back(sum / static_cast<double>(groups.size()));
  }
  std::sort(figures.begin(), figures.end());
  return {sorted_percentile(figures, 0.025), sorted_percentile(figures, 0.975)};
}

Stats stats_of(std::span<const double> samples, std::span<const int64_t> strata, uint64_t seed) {
  Stats stats;
  stats.count = static_cast<int64_t>(samples.size());
  if (samples.empty()) return stats;
  std::vector<double> sorted(samples.begin(), samples.end());
  std::sort(sorted.begin(), sorted.end());
  stats.median = typical(samples, strata);
  stats.p5 = sorted_percentile(sorted, 0.05);
  stats.p95 = sorted_percentile(sorted, 0.95);
  stats.min = sorted.front();
  stats.max = sorted.back();
  for (const double value : sorted) stats.mean += value;
  stats.mean /= static_cast<double>(sorted.size());
  const Interval interval = bootstrap_typical(samples, strata, 400, seed);
  stats.median_lo = interval.lo;
  stats.median_hi = interval.hi;
  return stats;
}

namespace {

// Below this local slope the error does not fall.
constexpr double kFalls = 0.25;

// The longest stretch of at least three points whose local slopes all fall and agree within half an order; of equals
// the finest.
struct Stretch {
  size_t begin = 0, end = 0;  // points [begin, end)
};
Stretch steady_stretch(const std::vector<double>& slopes) {
  Stretch best;
  for (size_t begin = 0; begin < slopes.size(); ++begin) {
    double lo = slopes[begin], hi = slopes[begin];
    for (size_t end = begin + 1; end < slopes.size(); ++end) {
      lo = std::min(lo, slopes[end]);
      hi = std::max(hi, slopes[end]);
      if (lo < kFalls || hi - lo > 0.5) break;
      if (end + 2 - begin >= best.end - best.begin) best = {begin, end + 2};
    }
  }
  return best;
}

// Least squares of log(error) over log(step).
void fit_line(std::span<const double> steps, std::span<const double> errors, OrderFit& fit) {
  const auto n = static_cast<double>(steps.size());
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0, residual = 0;
  for (size_t i = 0; i < steps.size(); ++i) {
    mean_x += std::log(steps[i]) / n;
    mean_y += std::log(errors[i]) / n;
  }
  for (size_t i = 0; i < steps.size(); ++i) {
    const double x = std::log(steps[i]) - mean_x;
    xx += x * x;
    xy += x * (std::log(errors[i]) - mean_y);
  }
  fit.points = static_cast<int>(steps.size());
  fit.order = xy / xx;
  for (size_t i = 0; i < steps.size(); ++i) {
    const double r = std::log(errors[i]) - mean_y - fit.order * (std::log(steps[i]) - mean_x);
    residual += r * r;
  }
  const double half = student_t(fit.points - 2) * std::sqrt(residual / (n - 2) / xx);
  fit.lo = fit.order - half;
  fit.hi = fit.order + half;
}

}  // namespace

OrderFit fit_order(std::span<const double> steps, std::span<const double> errors, double noise) {
  if (steps.size() != errors.size()) throw std::invalid_argument("one error a step expected");
  OrderFit fit;
  // Usable: what lies above three bounds of the reference, less a plateau at its fine end. Where the error stands still
  // among coarse steps only, they are too coarse to see anything: no floor.
  size_t usable = 0;
  while (usable < errors.size() && std::isfinite(errors[usable]) && errors[usable] > 3 * noise && errors[usable] > 0)
    ++usable;
  std::vector<double> slopes;
  for (size_t i = 1; i < usable; ++i)
    slopes.push_back(std::log(errors[i] / errors[i - 1]) / std::log(steps[i] / steps[i - 1]));
  while (!slopes.empty() && slopes.back() < kFalls) slopes.pop_back();
  usable = std::min(usable, slopes.size() + 1);
  const Stretch stretch = steady_stretch(slopes);
  const size_t count = stretch.end - stretch.begin;
  if (usable < errors.size() && usable > 0) fit.floor = *std::min_element(errors.begin(), errors.end());
  if (count >= 3) fit_line(steps.subspan(stretch.begin, count), errors.subspan(stretch.begin, count), fit);
  return fit;
}

OrderFit fit_power(std::span<const double> steps, std::span<const double> values) {
  OrderFit fit;
  const auto usable = [](double value) { return value > 0 && std::isfinite(value); };
  if (steps.size() >= 3 && std::all_of(steps.begin(), steps.end(), usable) &&
      std::all_of(values.begin(), values.end(), usable))
    fit_line(steps, values, fit);
  return fit;
}

}  // namespace volumark
