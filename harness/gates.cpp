#include "harness/gates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "reports/analysis.h"

namespace volumark {
namespace {

// A NaN is worse than any number.
void keep_worst(double& worst, double value) {
  worst = std::isnan(worst) || std::isnan(value) ? NAN : std::max(worst, value);
}
void keep_least(double& worst, double value) {
  worst = std::isnan(worst) || std::isnan(value) ? NAN : std::min(worst, value);
}

using Member = double ErrorMetrics::*;
constexpr Member kMoreIsWorse[] = {
    &ErrorMetrics::mae,           &ErrorMetrics::rmse,      &ErrorMetrics::p50,
    &ErrorMetrics::p95,           &ErrorMetrics::p99,       &ErrorMetrics::over_1_255,
    &ErrorMetrics::flip_mean,     &ErrorMetrics::flip_p99,  &ErrorMetrics::ciede2000_mean,
    &ErrorMetrics::ciede2000_p99, &ErrorMetrics::alpha_mae, &ErrorMetrics::alpha_rmse,
    &ErrorMetrics::alpha_max};
constexpr Member kLessIsWorse[] = {&ErrorMetrics::psnr, &ErrorMetrics::ssim};

void worsen(ErrorMetrics& worst, const ErrorMetrics& view) {
  for (const Member member : kMoreIsWorse) keep_worst(worst.*member, view.*member);
  for (const Member member : kLessIsWorse) keep_least(worst.*member, view.*member);
  if (view.max > worst.max) {
    worst.max = view.max;
    worst.max_x = view.max_x;
    worst.max_y = view.max_y;
  }
  for (size_t c = 0; c < 3; ++c)
    if (std::abs(view.bias[c]) > std::abs(worst.bias[c])) worst.bias[c] = view.bias[c];
}

// Into `worst` and, over the views that have the region, `mean`.
void regions_over_views(const std::vector<ErrorMetrics>& views, CellError& out) {
  out.worst.regions.clear();
  std::map<std::string, double> count;
  for (const ErrorMetrics& view : views)
    for (const auto& [name, error] : view.regions) {
      RegionError &worst = out.worst.regions[name], &mean = out.mean.regions[name];
      const double share = 1 / ++count[name];
      for (const auto member : {&RegionError::rmse, &RegionError::max, &RegionError::mae}) {
        keep_worst(worst.*member, error.*member);
        mean.*member += share * (error.*member - mean.*member);
      }
      worst.pixels += error.pixels;
      mean.pixels += error.pixels;
    }
}

}  // namespace

ErrorMetrics error_metrics(const Errors& errors) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  ErrorMetrics out;
  out.pixels = errors.pixels;
  out.non_finite = errors.non_finite;
  out.mae = errors.mae;
  out.rmse = errors.rmse;
  out.max = errors.max;
  out.max_x = errors.max_x;
  out.max_y = errors.max_y;
  out.psnr = errors.psnr.value_or(std::numeric_limits<double>::infinity());
  out.bias = errors.bias;
  out.p50 = errors.p50;
  out.p95 = errors.p95;
  out.p99 = errors.p99;
  out.over_1_255 = errors.over_1_255;
  out.ssim = errors.ssim.value_or(none);
  out.flip_mean = errors.flip_mean.value_or(none);
  out.flip_p99 = errors.flip_p99.value_or(none);
  out.ciede2000_mean = errors.ciede2000_mean.value_or(none);
  out.ciede2000_p99 = errors.ciede2000_p99.value_or(none);
  out.alpha_mae = errors.alpha_mae;
  out.alpha_rmse = errors.alpha_rmse;
  out.alpha_max = errors.alpha_max;
  return out;
}

CellError over_views(const std::vector<ErrorMetrics>& views) {
  if (views.empty()) throw std::invalid_argument("errors of no view");
  CellError out{views.front(), ErrorMetrics{}};
  out.mean.ssim = 0;
  const double share = 1 / static_cast<double>(views.size());
  for (const ErrorMetrics& view : views) {
    if (&view != &views.front()) {
      out.worst.pixels += view.pixels;
      out.worst.non_finite += view.non_finite;
      worsen(out.worst, view);
    }
    for (const Member member : kMoreIsWorse) out.mean.*member += share * (view.*member);
    for (const Member member : kLessIsWorse) out.mean.*member += share * (view.*member);
    out.mean.max += share * view.max;
    for (size_t c = 0; c < 3; ++c) out.mean.bias[c] += share * view.bias[c];
  }
  out.mean.pixels = out.worst.pixels;
  out.mean.non_finite = out.worst.non_finite;
  regions_over_views(views, out);
  return out;
}

std::optional<std::string> wrong_image_reason(const ErrorMetrics& worst, const std::map<std::string, double>& limits) {
  if (worst.non_finite > 0) return fmt::format("{} pixels are NaN or infinite", worst.non_finite);
  for (const char* metric : {"bias", "rmse", "max", "flip_p99"}) {
    const auto limit = limits.find(metric);
    if (limit == limits.end()) continue;
    const double value = error_value(worst, metric);
    if (!(value <= limit->second))
      return fmt::format("{} is {:.3g}, above its limit {:g}", metric, value, limit->second);
  }
  return std::nullopt;
}

}  // namespace volumark
