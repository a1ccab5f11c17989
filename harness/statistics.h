// Order statistics of timing samples, bootstrap intervals and the fitted order of convergence. Deterministic: the same
// samples and seed give the same figures.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reports/results.h"

namespace volumark {

// Linear interpolation between order statistics (R type 7), p in [0, 1]. Throws std::invalid_argument for no samples.
double percentile(std::vector<double> samples, double p);
double median(std::vector<double> samples);

// The figure of a cell: the mean over the strata (its views) of each stratum's median. `strata`: empty, or one a
// sample; of one stratum it is the plain median. Throws std::invalid_argument for no samples, or not one stratum a
// sample.
double typical(std::span<const double> samples, std::span<const int64_t> strata = {});

struct Interval {
  double lo = 0, hi = 0;
};
// 95 % percentile-bootstrap interval of typical(): samples are drawn anew within each stratum only, since which views
// were measured is not chance. Throws as typical().
Interval bootstrap_typical(std::span<const double> samples, std::span<const int64_t> strata = {}, int resamples = 400,
                           uint64_t seed = 1);

// All of Stats: median is typical(), with its interval; zero count for no samples.
Stats stats_of(std::span<const double> samples, std::span<const int64_t> strata = {}, uint64_t seed = 1);

struct OrderFit {
  int points = 0;                    // that the line was fitted through; 0: fewer than 3 usable ones
  double order = 0, lo = 0, hi = 0;  // slope of log(error) over log(step), and its 95 % interval
  double floor = 0;  // smallest error, where the error stops falling before the finest step; 0: it never stops
};
// error ~ step^order; `steps` falls from coarse to fine. Fitted through the longest stretch of at least three points
// whose local slopes are at least 0.25 and agree within half an order (of equals the finest), among those before the
// error stops falling for good (slopes below 0.25 up to the finest step) or reaches three times `noise` (the
// reference's bound). A plateau among coarse steps alone is no floor: behind it the error falls.
OrderFit fit_order(std::span<const double> steps, std::span<const double> errors, double noise);
// value ~ step^order through all points; none (points: 0) for fewer than three or a number that is not above 0.
OrderFit fit_power(std::span<const double> steps, std::span<const double> values);

}  // namespace volumark
