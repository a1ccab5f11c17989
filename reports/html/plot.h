// Error against time, log-log, as an SVG element: the front of each method and backend as a line, every cell as a
// point with its intervals, dominated ones faded. Backends differ by colour and marker shape, methods by dash and
// filling.
#pragma once

#include <string>

#include "reports/html/model.h"

namespace volumark::html {

struct PlotMetric {
  const char* key;    // of error_value
  const char* title;  // "RMSE"
  std::span<const double> targets;
};

// Empty where no cell has both a time and an error.
std::string cost_plot(const Model& model, const Block& block, const PlotMetric& metric);
std::string plot_legend(const Model& model, const Block& block);

}  // namespace volumark::html
