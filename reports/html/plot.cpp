#include "reports/html/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "reports/html/format.h"
#include "reports/html/log_plot.h"
#include "reports/html/marker.h"
#include "reports/html/sections.h"

namespace volumark::html {
namespace {

struct Series {
  const Row* row;
  std::vector<CostPoint> points;
  std::vector<size_t> front;
};

std::vector<Series> series_of(const Model& model, const Block& block, const std::string& metric) {
  std::vector<Series> out;
  for (const Row& row : block.rows) {
    Series series{&row, model.points(row, metric), {}};
    if (series.points.empty()) continue;
    series.front = pareto_front(series.points);
    out.push_back(std::move(series));
  }
  return out;
}

PlotAxes axes_of(const std::vector<Series>& all, const PlotMetric& metric) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  double t0 = inf, t1 = 0, e0 = inf, e1 = 0;
  for (const Series& series : all)
    for (const CostPoint& point : series.points) {
      t0 = std::min({t0, point.time, point.time_lo > 0 ? point.time_lo : point.time});
      t1 = std::max({t1, point.time, point.time_hi});
      // A view without error, or the bound taken off, must not stretch the axis to nowhere.
      if (point.error > 0) e0 = std::min(e0, std::max(point.error_lo, point.error / 50));
      e1 = std::max(e1, point.error_hi);
    }
  return {plot_x_axis(t0, t1), plot_y_axis(std::min(e0, e1), e1), 1e3, "time a frame, ms (median)", metric.title,
          metric.targets};
}

std::vector<std::pair<double, double>> places(const std::vector<CostPoint>& points, const std::vector<size_t>& front) {
  std::vector<std::pair<double, double>> out;
  for (const size_t i : front) out.emplace_back(points[i].time, points[i].error);
  return out;
}

// Backends that draw the same image differ in the last digits: steps below 1 % are not worth a line.
std::string front_line(const Front& front, const PlotAxes& axes, const std::string& classes,
                       PlotLabels* labels = nullptr, const std::string& name = "") {
  std::vector<std::pair<double, double>> places;
  for (const CostPoint& point : front.points)
    if (places.empty() || point.error < 0.99 * places.back().second) places.emplace_back(point.time, point.error);
  if (places.empty()) return "";
  return plot_line(axes, places, classes) +
         (labels == nullptr ? "" : labels->put(places.back().first, places.back().second, name));
}

// The front over all, and, hidden until they are asked for, those of each method over backends and of each backend over
// methods.
std::string joint_fronts(const Model& model, const Block& block, const PlotAxes& axes, const char* metric) {
  auto index = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) - names.begin();
  };
  std::string overall, by_method, by_backend;
  PlotLabels of_methods(axes), of_backends(axes);
  for (const Front& front : fronts(model.results, block.experiment, block.scene, metric)) {
    if (front.method.empty() && front.backend.empty())
      overall += front_line(front, axes, "overall");
    else if (front.backend.empty())
      by_method += front_line(front, axes, fmt::format("front plain d{}", index(model.methods, front.method) % 4),
                              &of_methods, front.method);
    else if (front.method.empty())
      by_backend += front_line(front, axes, fmt::format("front c{}", index(model.backends, front.backend) % 6),
                               &of_backends, front.backend);
  }
  return overall + "<g class=\"fronts by-method\">" + by_method + "</g><g class=\"fronts by-backend\">" + by_backend +
         "</g>";
}

std::string point_text(const Model& model, const Series& series, const CostPoint& point, const PlotMetric& metric,
                       bool dominated) {
  const std::string& settings = model.settings[point.result];
  std::string text =
      fmt::format("{} on {}{}: {} ms ({} to {}), {} {}", series.row->method, series.row->backend,
                  settings.empty() ? "" : ", " + settings, milliseconds(point.time), milliseconds(point.time_lo),
                  milliseconds(point.time_hi), metric.title, scientific(point.error));
  if (point.error_lo < point.error_hi)
    text += fmt::format(" (views {} to {})", scientific(point.error_lo), scientific(point.error_hi));
  if (point.error > error_value(model.results.results[point.result].error->worst, metric.key))
    text += "; at the reference's bound";
  if (model.results.results[point.result].outcome == Outcome::WrongImage) text += "; counted as a wrong image";
  return text + (dominated ? "; dominated" : "");
}

std::string series_line(const Block& block, const Series& series, const PlotAxes& axes, PlotLabels& labels) {
  std::string out = plot_line(axes, places(series.points, series.front), "front " + series_classes(*series.row));
  const std::string letter = block.letter(*series.row);
  const CostPoint& last = series.points[series.front.back()];
  if (!letter.empty()) out += labels.put(last.time, last.error, letter);
  return out;
}

std::string series_points(const Model& model, const Series& series, const PlotAxes& axes, const PlotMetric& metric) {
  std::string out;
  for (size_t i = 0; i < series.points.size(); ++i) {
    const CostPoint& point = series.points[i];
    const bool dominated = std::find(series.front.begin(), series.front.end(), i) == series.front.end();
    PlotPoint drawn{point.time, point.error, point.time_lo, point.time_hi, point.error_lo, point.error_hi, "", "", ""};
    drawn.classes = dominated ? "dominated" : "";
    drawn.label = point_text(model, series, point, metric, dominated);
    drawn.data = fmt::format("data-cell=\"{}\" data-time=\"{:.17g}\" data-error=\"{:.17g}\"", point.result, point.time,
                             point.error);
    out += plot_point(axes, *series.row, drawn);
  }
  return out;
}

}  // namespace

std::string cost_plot(const Model& model, const Block& block, const PlotMetric& metric) {
  const std::vector<Series> all = series_of(model, block, metric.key);
  if (all.empty()) return "";
  const auto positive = [](const CostPoint& point) { return point.error > 0; };
  if (std::none_of(all.begin(), all.end(),
                   [&](const Series& s) { return std::any_of(s.points.begin(), s.points.end(), positive); }))
    return fmt::format("<p class=\"note empty\">{}: 0 for every cell, nothing to plot.</p>", metric.title);
  const PlotAxes axes = axes_of(all, metric);
  std::string out = fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {} {}\" role=\"group\" aria-label=\"{} against time, {}\" "
      "data-metric=\"{}\">",
      kPlotWidth, kPlotHeight, metric.title, escape(model.title(block)), metric.key);
  out += plot_frame(axes) + joint_fronts(model, block, axes, metric.key);
  out += "<g class=\"fronts each\">";
  PlotLabels labels(axes);
  for (const Series& series : all) out += series_line(block, series, axes, labels);
  out += "</g>";
  for (const Series& series : all) out += series_points(model, series, axes, metric);
  return out + "</svg>";
}

std::string plot_legend(const Model& model, const Block& block) {
  constexpr size_t kEach = 8;  // more lines than these are told by their parts: backend, method, setting
  std::vector<const Row*> rows;
  for (const Row& row : block.rows)
    if (!model.points(row, "rmse").empty()) rows.push_back(&row);
  std::string out = "<ul class=\"legend\" aria-label=\"Legend\">";
  if (rows.size() <= kEach) {
    for (const Row* row : rows) out += legend_entry(*row, model.name(block, *row), block.letter(*row), true);
  } else {
    std::vector<std::string> known;
    auto once = [&](const std::string& name) {
      const bool first = std::find(known.begin(), known.end(), name) == known.end();
      if (first) known.push_back(name);
      return first;
    };
    for (const Row* row : rows)
      if (once("backend " + row->backend)) out += legend_entry(*row, row->backend, "", false);
    for (const Row* row : rows)
      if (once("method " + row->method)) out += legend_entry(*row, row->method, "", true);
    for (const Row* row : rows)
      if (!block.letter(*row).empty() && once("setting " + row->setting))
        out += "<li><b>" + block.letter(*row) + "</b> " + escape(row->setting) + "</li>";
  }
  return out +
         "<li><svg width=\"44\" height=\"14\" aria-hidden=\"true\"><polyline class=\"overall\" points=\"2,7 42,7\"/>"
         "</svg>front over all</li></ul>";
}

}  // namespace volumark::html
