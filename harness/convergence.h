// Orders of convergence from finished cells: error (RMSE, worst view) along each series' quality axis.
#pragma once

#include "harness/experiment.h"
#include "reports/results.h"

namespace volumark {

// Fills results.convergence, and order.fitted of the cells. A verdict is pass or fail only on scenes that the
// experiment names in expect_order_on, for methods that state an order; a fit passes where it is within 0.25 of the
// expected order.
void fit_convergence(Results& results, const std::vector<Experiment>& experiments);

inline constexpr double kOrderTolerance = 0.25;

}  // namespace volumark
