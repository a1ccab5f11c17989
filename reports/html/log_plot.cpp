#include "reports/html/log_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

std::string PlotLabels::put(double x, double y, const std::string& text) {
  constexpr double kHeight = 13;
  const double width = 7.2 * static_cast<double>(text.size()) + 2;
  const double px = axes_.x.pixel(x), py = axes_.y.pixel(y);
  const std::pair<double, double> places[] = {{px + 9, py - 5},          {px + 9, py + 13},
                                              {px - 9 - width, py - 5},  {px - 9 - width, py + 13},
                                              {px - width / 2, py - 10}, {px - width / 2, py + 20}};
  for (const auto& [left, base] : places) {
    if (left < kLeft || left + width > kPlotWidth - kRight || base > kPlotHeight - kBottom || base < kTop + kHeight)
      continue;
    // One word for two lines that end together says the same as two.
    const bool free = std::none_of(taken_.begin(), taken_.end(), [&](const Box& box) {
      return left < box.x + box.width && box.x < left + width && std::abs(base - box.y) < kHeight;
    });
    const bool said = std::any_of(taken_.begin(), taken_.end(), [&](const Box& box) {
      return box.text == text && std::abs(left - box.x) < 16 && std::abs(base - box.y) < kHeight;
    });
    if (said) return "";
    if (!free) continue;
    taken_.push_back({left, base, width, text});
    return fmt::format("<text class=\"letter\" x=\"{:.1f}\" y=\"{:.1f}\" aria-hidden=\"true\">{}</text>", left, base,
                       escape(text));
  }
  return "";
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

std::string legend_entry(const Row& row, const std::string& name, const std::string& letter, bool line) {
  const std::string style = series_classes(row);
  return fmt::format(
      "<li><svg width=\"44\" height=\"14\" aria-hidden=\"true\">{}<g class=\"point {}\" "
      "transform=\"translate(22 7)\">{}</g></svg>{}{}</li>",
      line ? "<polyline class=\"front " + style + "\" points=\"1,7 43,7\"/>" : "", style, marker(row),
      letter.empty() ? "" : "<b>" + letter + "</b> ", escape(name));
}

}  // namespace volumark::html
