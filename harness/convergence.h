// Orders of convergence from finished cells: error (RMSE, worst view) along each series' quality axis: in its
// values, or in 1 / value where the method's sweep rises (slices in percent).
#pragma once

#include "harness/experiment.h"
#include "reports/results.h"

namespace volumark {

// Fills results.convergence, and order.fitted of the cells. A verdict other than "not stated" is given only on scenes
// that the experiment names in expect_order_on, for methods that state an order: a fit passes where it is at most 0.25
// below the expected order (one that is more than 0.25 above it says so in its reason); without a fit the series is
// "not resolved", or "at the bound" where all its errors are within three of the reference's bounds.
void fit_convergence(Results& results, const std::vector<Experiment>& experiments);

inline constexpr double kOrderTolerance = 0.25;
inline constexpr double kNoiseBounds = 3;  // nearer to the reference's bound nothing is told from the bound itself
// A series of at least three values that must show its order and does not.
bool is_bad_news(const Convergence& row);

}  // namespace volumark
