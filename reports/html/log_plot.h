// What the log-log plots share: the drawing's size, axes with ticks and titles, lines, and points that keys can reach.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reports/html/log_axis.h"
#include "reports/html/model.h"

namespace volumark::html {

inline constexpr double kPlotWidth = 640, kPlotHeight = 400;

struct PlotAxes {
  LogAxis x, y;
  double x_unit = 1;  // ticks show the value times this: 1e3 for milliseconds
  std::string x_title, y_title;
  std::span<const double> targets;  // dotted lines across
};

LogAxis plot_x_axis(double lo, double hi);  // positive values
LogAxis plot_y_axis(double lo, double hi);
std::string plot_frame(const PlotAxes& axes);

std::string plot_line(const PlotAxes& axes, const std::vector<std::pair<double, double>>& values,
                      const std::string& classes);
// Words at places of a plot: beside the place, where no earlier word of this plot is; left out where all is taken.
class PlotLabels {
 public:
  explicit PlotLabels(const PlotAxes& axes) : axes_(axes) {}
  std::string put(double x, double y, const std::string& text);

 private:
  struct Box {
    double x, y, width;
    std::string text;
  };
  const PlotAxes& axes_;
  std::vector<Box> taken_;
};

struct PlotPoint {
  double x = 0, y = 0;
  double x_lo = 0, x_hi = 0, y_lo = 0, y_hi = 0;  // intervals, drawn as bars
  std::string classes, label;                     // label: what it says under the pointer and to readers
  std::string data;                               // attributes, escaped
};
std::string plot_point(const PlotAxes& axes, const Row& row, const PlotPoint& point);

// <li> of a legend: marker of a row, with its line if wanted, and what it stands for.
std::string legend_entry(const Row& row, const std::string& name, const std::string& letter, bool line);

}  // namespace volumark::html
