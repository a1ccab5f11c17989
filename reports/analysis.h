// What follows from the cells of a results file, for tables and report: what accuracy costs in time.
// Only outcomes ok and wrong_image have both a time and an error; a cell whose error is below its reference's bound
// counts with the bound. Views that show nothing have no say in errors (there every method is right), and a cell
// without any other is never ranked. Nor is one with effects switched against its scene's list: it has another picture.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/results.h"

namespace volumark {

// One cell as a point of error against time.
struct CostPoint {
  double time = 0, time_lo = 0, time_hi = 0;  // seconds a frame: Stats::median and its 95 % interval
  double error = 0;                           // >= 0, of the worst view
  // The range of the error over the cell's views, widened by what the reference leaves open: from the least of a view's
  // error less its reference's bound to the largest error plus bound. The bound counts for rmse, max and mae, which it
  // limits (they are norms of the difference); it is 0 for all other metrics. Not a confidence interval: views are
  // chosen, not drawn.
  double error_lo = 0, error_hi = 0;
  size_t result = 0;  // index into Results::results
};

// The error of a cell that a plot or a gate is about: "rmse", "max", "mae", "flip_mean", "flip_p99", "bias" (largest
// magnitude), "ciede2000_p99", "dssim" (1 - SSIM). Throws ResultsError for another name.
double error_value(const ErrorMetrics& errors, const std::string& metric);

// Whether the cell's error may stand beside those of others: it was drawn with every effect of its scene, it has an
// error, and every pixel of it is finite (figures leave pixels out that are not).
bool error_counts(const Result& result);

// The reference of one of its views shows the background alone.
bool a_view_shows_nothing(const Result& result);

// The point of one cell (frame_wall, or frame_cpu; worst view's error); nothing where it has no time or no error, or is
// not ranked.
std::optional<CostPoint> cost_point(const Results& results, size_t index, const std::string& error_metric,
                                    bool cpu_time = false);

// Indices of the points that no other point beats in both time and error, by rising time.
std::vector<size_t> pareto_front(std::span<const CostPoint> points);

// What nothing beats among the cells of one scene: of one method on one backend, of one method on all backends, of all
// methods on one backend, or of all. Software and hardware are never in one front.
struct Front {
  std::string method, backend;  // empty: over all of them
  bool software = true;
  std::vector<CostPoint> points;  // by rising time
};
// All four kinds, in that order; one entry for each method and backend that has a point.
std::vector<Front> fronts(const Results& results, const std::string& experiment, const std::string& scene,
                          const std::string& error_metric);

struct TimeToError {
  std::optional<double> seconds;  // absent: not reached
  bool interpolated = false;  // between two measured cells; otherwise it is a measured cell's time (a faster setting
                              // was not tried: the true time may be less)
  // The two neighbours on the front between which it lies, as indices into Results::results; the same cell twice where
  // it was measured. Without meaning where it is not reached.
  size_t coarse = 0, fine = 0;
  double best_error = 0, best_seconds = 0;  // the smallest error of all points, and its time
  size_t best = 0;                          // index into Results::results
};
// The least time at which `target` is reached: straight lines between neighbours of the front in log(time),
// log(error). No points: nothing reached, best_error is infinite.
TimeToError time_to_error(std::span<const CostPoint> points, double target);

inline constexpr double kErrorTargets[] = {1e-2, 3e-3, 1e-3, 3e-4};  // RMSE
inline constexpr double kFlipTargets[] = {0.1, 0.05, 0.02};          // FLIP, 99th percentile

}  // namespace volumark
