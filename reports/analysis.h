// What follows from the cells of a results file, for tables and report: what accuracy costs in time.
// Only outcomes ok and wrong_image have both a time and an error; a cell whose error is below its reference's bound
// counts with the bound.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/results.h"

namespace volumark {

// One cell as a point of error against time.
struct CostPoint {
  double time = 0, time_lo = 0, time_hi = 0;  // seconds a frame: median and its interval
  double error = 0;                           // >= 0
  size_t result = 0;                          // index into Results::results
};

// The error of a cell that a plot or a gate is about: "rmse", "max", "mae", "flip_mean", "flip_p99", "bias" (largest
// magnitude), "ciede2000_p99", "dssim" (1 - SSIM). Throws ResultsError for another name.
double error_value(const ErrorMetrics& errors, const std::string& metric);

// The point of one cell (frame_wall, or frame_cpu; worst view's error); nothing where it has no time or no error.
std::optional<CostPoint> cost_point(const Results& results, size_t index, const std::string& error_metric,
                                    bool cpu_time = false);

// Indices of the points that no other point beats in both time and error, by rising time.
std::vector<size_t> pareto_front(std::span<const CostPoint> points);

struct TimeToError {
  std::optional<double> seconds;  // absent: not reached
  bool interpolated = false;  // between two measured cells; otherwise it is a measured cell's time (a faster setting
                              // was not tried: the true time may be less)
  double best_error = 0, best_seconds = 0;  // the smallest error of all points, and its time
};
// The least time at which `target` is reached: straight lines between neighbours of the front in log(time),
// log(error). No points: nothing reached, best_error is infinite.
TimeToError time_to_error(std::span<const CostPoint> points, double target);

inline constexpr double kErrorTargets[] = {1e-2, 3e-3, 1e-3, 3e-4};

}  // namespace volumark
