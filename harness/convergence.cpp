#include "harness/convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/run_folder.h"
#include "harness/statistics.h"
#include "methods/method.h"
#include "reports/analysis.h"

namespace volumark {
namespace {

struct Series {
  CellKey key;
  std::vector<Result*> cells;
};

std::vector<Series> series_of(Results& results) {
  std::vector<Series> out;
  for (Result& result : results.results) {
    if (!result.quality || !error_counts(result)) continue;
    CellKey key = result.key;
    key.params.erase(result.quality->parameter);
    auto found = std::find_if(out.begin(), out.end(), [&](const Series& series) { return series.key == key; });
    if (found == out.end()) {
      out.push_back({key, {}});
      found = out.end() - 1;
    }
    found->cells.push_back(&result);
  }
  return out;
}

bool order_expected(const std::vector<Experiment>& experiments, const CellKey& key) {
  for (const Experiment& experiment : experiments)
    if (experiment.name == key.experiment)
      for (const std::string& scene : experiment.expect_order_on)
        if (std::filesystem::path(scene).stem().string() == key.scene) return true;
  return false;
}

// Whether larger values are finer ones (slices in percent) and not coarser ones (a step): what the method's sweep says.
bool finer_upwards(const CellKey& key, const std::string& parameter) {
  for (const Method* method : method_list()) {
    if (method->info().name != key.method) continue;
    for (const ParameterInfo& info : method->info().parameters)
      if (info.name == parameter && info.sweep.size() > 1) return info.sweep.front() < info.sweep.back();
  }
  return false;
}

// Coarse first.
void sort_cells(std::vector<Result*>& cells, bool upwards) {
  std::sort(cells.begin(), cells.end(), [&](const Result* a, const Result* b) {
    return upwards ? a->quality->value < b->quality->value : a->quality->value > b->quality->value;
  });
}

void judge(Convergence& row, const OrderFit& fit, bool expected_here, double bound) {
  if (!(row.expected > 0) || !expected_here) {
    row.verdict = "not stated";
    row.reason = row.expected > 0 ? "the scene's field is not smooth" : "the method states no order here";
  } else if (std::all_of(row.errors.begin(), row.errors.end(), [&](double e) { return e <= kNoiseBounds * bound; })) {
    row.verdict = "at the bound";
    row.reason = fmt::format("every error is within {} bounds of the reference ({:.1e})", kNoiseBounds, bound);
  } else if (fit.points == 0) {
    row.verdict = "not resolved";
    row.reason = row.errors.size() < 3
                     ? "fewer than three values"
                     : "fewer than three values in a row between which the error falls steadily above "
                       "the reference's bound";
  } else if (fit.order >= row.expected - kOrderTolerance) {
    row.verdict = "pass";
    if (fit.order > row.expected + kOrderTolerance)
      row.reason = fmt::format(
          "faster than expected: fitted order {:.2f}, expected {:.2f}, more than {} above it (an error that changes "
          "its "
          "sign, or steps still too coarse)",
          fit.order, row.expected, kOrderTolerance);
  } else {
    row.verdict = "fail";
    row.reason =
        fmt::format("fitted order {:.2f}, expected {:.2f} within {}", fit.order, row.expected, kOrderTolerance);
  }
}

Convergence converge(const Series& series, bool upwards, bool expected_here) {
  Convergence row;
  row.key = series.key;
  row.parameter = series.cells.front()->quality->parameter;
  row.expected = series.cells.front()->order.expected;
  double bound = 0;
  std::vector<double> steps;
  for (const Result* cell : series.cells) {
    row.values.push_back(cell->quality->value);
    steps.push_back(upwards ? 1 / cell->quality->value : cell->quality->value);
    row.errors.push_back(cell->error->worst.rmse);
    for (const ViewResult& view : cell->views)
      if (view.reference) bound = std::max(bound, view.reference->bound);
  }
  const OrderFit fit = fit_order(steps, row.errors, bound);
  row.fitted_points = fit.points;
  row.fitted = fit.order;
  row.fitted_lo = fit.lo;
  row.fitted_hi = fit.hi;
  row.floor = fit.floor;
  judge(row, fit, expected_here, bound);
  return row;
}

}  // namespace

bool is_bad_news(const Convergence& row) {
  return row.verdict == "fail" || (row.verdict == "not resolved" && row.values.size() >= 3);
}

void fit_convergence(Results& results, const std::vector<Experiment>& experiments) {
  results.convergence.clear();
  for (Series& series : series_of(results)) {
    if (series.cells.size() < 2) continue;
    const bool upwards = finer_upwards(series.key, series.cells.front()->quality->parameter);
    sort_cells(series.cells, upwards);
    Convergence row = converge(series, upwards, order_expected(experiments, series.key));
    for (Result* cell : series.cells) {
      cell->order.fitted.reset();
      if (row.fitted_points > 0) cell->order.fitted = row.fitted;
    }
    results.convergence.push_back(std::move(row));
  }
}

}  // namespace volumark
