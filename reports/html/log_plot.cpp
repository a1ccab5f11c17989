#include "reports/html/log_plot.h"

#include <fmt/format.h>

#include "reports/html/format.h"
#include "reports/html/marker.h"

namespace volumark::html {
namespace {

constexpr double kLeft = 64, kRight = 14, kTop = 12, kBottom = 48;

std::string x_ticks(const PlotAxes& axes) {
  std::string out;
  for (const LogAxis::Tick& tick : axes.x.ticks()) {
    const double x = axes.x.pixel(tick.value);
    out += fmt::format("<line class=\"{}\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{}\" y2=\"{}\"/>",
                       tick.labelled ? "grid" : "minor", x, x, kTop, kPlotHeight - kBottom);
    if (tick.labelled)
      out += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>", x, kPlotHeight - kBottom + 16,
                         compact(tick.value * axes.x_unit));
  }
  return out;
}

std::string y_ticks(const PlotAxes& axes) {
  std::string out;
  for (const LogAxis::Tick& tick : axes.y.ticks()) {
    const double y = axes.y.pixel(tick.value);
    out += fmt::format("<line class=\"{}\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>",
                       tick.labelled ? "grid" : "minor", kLeft, kPlotWidth - kRight, y, y);
    if (tick.labelled)
      out += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>", kLeft - 6, y + 4,
                         tick.value < .01 ? power_of_ten(tick.value) : compact(tick.value));
  }
  for (const double target : axes.targets)
    if (target > axes.y.lo() && target < axes.y.hi())
      out += fmt::format("<line class=\"target\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", kLeft,
                         kPlotWidth - kRight, axes.y.pixel(target), axes.y.pixel(target));
  return out;
}

}  // namespace

LogAxis plot_x_axis(double lo, double hi) { return {lo, hi, kLeft, kPlotWidth - kRight}; }
LogAxis plot_y_axis(double lo, double hi) { return {lo, hi, kPlotHeight - kBottom, kTop}; }

std::string plot_frame(const PlotAxes& axes) {
  std::string out = "<g class=\"axis\" aria-hidden=\"true\">" + x_ticks(axes) + y_ticks(axes);
  out += fmt::format("<rect class=\"border\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>", kLeft, kTop,
                     kPlotWidth - kLeft - kRight, kPlotHeight - kTop - kBottom);
  out += fmt::format("<text class=\"title\" x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
                     (kLeft + kPlotWidth - kRight) / 2, kPlotHeight - 10, escape(axes.x_title));
  return out + fmt::format(
                   "<text class=\"title\" transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">{}"
                   "</text></g>",
                   (kTop + kPlotHeight - kBottom) / 2, escape(axes.y_title));
}

std::string plot_line(const PlotAxes& axes, const std::vector<std::pair<double, double>>& values,
                      const std::string& classes) {
  std::string path;
  for (const auto& [x, y] : values)
    path += fmt::format("{}{:.1f},{:.1f}", path.empty() ? "" : " ", axes.x.pixel(x), axes.y.pixel(y));
  return fmt::format("<polyline class=\"{}\" points=\"{}\"/>", classes, path);
}

std::string plot_label(const PlotAxes& axes, double x, double y, const std::string& text, const std::string& classes) {
  const double width = 7.0 * static_cast<double>(text.size()) + 9;
  const bool left = axes.x.pixel(x) + width > kPlotWidth - kRight;
  return fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" aria-hidden=\"true\">{}</text>",
                     classes, axes.x.pixel(x) + (left ? -9 : 9), axes.y.pixel(y) - 6, left ? "end" : "start",
                     escape(text));
}

std::string plot_point(const PlotAxes& axes, const Row& row, const PlotPoint& point) {
  const double x = axes.x.pixel(point.x), y = axes.y.pixel(point.y);
  std::string out = fmt::format("<g class=\"point {} {}\" tabindex=\"-1\" role=\"img\" {} aria-label=\"{}\">",
                                series_classes(row), point.classes, point.data, escape(point.label));
  if (point.x_hi > point.x_lo)
    out += fmt::format("<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", axes.x.pixel(point.x_lo),
                       axes.x.pixel(point.x_hi), y, y);
  if (point.y_hi > point.y_lo)
    out += fmt::format("<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", x, x,
                       axes.y.pixel(point.y_lo), axes.y.pixel(point.y_hi));
  return out + fmt::format("<g transform=\"translate({:.1f} {:.1f})\"><circle class=\"hit\" r=\"11\"/>{}</g></g>", x, y,
                           marker(row));
}

std::string legend_entry(const Model& model, const Block& block, const Row& row) {
  const std::string style = series_classes(row), letter = block.letter(row);
  return fmt::format(
             "<li><svg width=\"44\" height=\"14\" aria-hidden=\"true\"><polyline class=\"front {}\" points=\"1,7 "
             "43,7\"/><g class=\"point {}\" transform=\"translate(22 7)\">{}</g></svg>",
             style, style, marker(row)) +
         (letter.empty() ? "" : "<b>" + letter + "</b> ") + escape(model.name(block, row)) +
         (row.ranked ? "" : " <span class=\"badge\">not ranked</span>") + "</li>";
}

}  // namespace volumark::html
