#include "reports/html/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "reports/html/format.h"
#include "reports/html/log_axis.h"
#include "reports/html/marker.h"
#include "reports/html/sections.h"

namespace volumark::html {
namespace {

constexpr double kWidth = 640, kHeight = 400, kLeft = 64, kRight = 14, kTop = 12, kBottom = 48;

// Best and worst view of a cell, the reference's bound added on both sides.
struct Span {
  double lo, hi;
};

Span error_span(const Result& result, const CostPoint& point, const std::string& metric) {
  Span span{point.error, point.error};
  const bool on_pixels = metric == "rmse" || metric == "max" || metric == "mae";
  for (const ViewResult& view : result.views) {
    if (!view.error) continue;
    const double error = error_value(*view.error, metric);
    const double bound = on_pixels && view.reference ? view.reference->bound : 0;
    if (!std::isfinite(error)) continue;
    span.lo = std::min(span.lo, std::max(error - bound, bound));
    span.hi = std::max(span.hi, error + bound);
  }
  return span;
}

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

std::pair<LogAxis, LogAxis> axes_of(const Model& model, const std::vector<Series>& all, const std::string& metric) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  double t0 = inf, t1 = 0, e0 = inf, e1 = 0;
  for (const Series& series : all)
    for (const CostPoint& point : series.points) {
      t0 = std::min({t0, point.time, point.time_lo > 0 ? point.time_lo : point.time});
      t1 = std::max({t1, point.time, point.time_hi});
      const Span span = error_span(model.results.results[point.result], point, metric);
      if (span.lo > 0) e0 = std::min(e0, span.lo);
      if (point.error > 0) e0 = std::min(e0, point.error);
      e1 = std::max(e1, span.hi);
    }
  return {LogAxis(t0, t1, kLeft, kWidth - kRight), LogAxis(std::min(e0, e1), e1, kHeight - kBottom, kTop)};
}

std::string frame(const LogAxis& time, const LogAxis& error, const PlotMetric& metric) {
  std::string out = "<g class=\"axis\" aria-hidden=\"true\">";
  for (const LogAxis::Tick& tick : time.ticks()) {
    const double x = time.pixel(tick.value);
    out += fmt::format("<line class=\"{}\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{}\" y2=\"{}\"/>",
                       tick.labelled ? "grid" : "minor", x, x, kTop, kHeight - kBottom);
    if (tick.labelled)
      out += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>", x, kHeight - kBottom + 16,
                         compact(tick.value * 1e3));
  }
  for (const LogAxis::Tick& tick : error.ticks()) {
    const double y = error.pixel(tick.value);
    out += fmt::format("<line class=\"{}\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>",
                       tick.labelled ? "grid" : "minor", kLeft, kWidth - kRight, y, y);
    if (tick.labelled)
      out += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>", kLeft - 6, y + 4,
                         tick.value < .01 ? power_of_ten(tick.value) : compact(tick.value));
  }
  for (const double target : metric.targets)
    if (target > error.lo() && target < error.hi())
      out += fmt::format("<line class=\"target\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", kLeft,
                         kWidth - kRight, error.pixel(target), error.pixel(target));
  out += fmt::format("<rect class=\"border\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>", kLeft, kTop,
                     kWidth - kLeft - kRight, kHeight - kTop - kBottom);
  out += fmt::format("<text class=\"title\" x=\"{}\" y=\"{}\" text-anchor=\"middle\">time a frame, ms (median)</text>",
                     (kLeft + kWidth - kRight) / 2, kHeight - 10);
  const double middle = (kTop + kHeight - kBottom) / 2;
  out += fmt::format(
      "<text class=\"title\" transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">{}"
      "</text></g>",
      middle, metric.title);
  return out;
}

std::string polyline(const std::vector<CostPoint>& points, const std::vector<size_t>& front, const LogAxis& time,
                     const LogAxis& error, const std::string& classes) {
  std::string path;
  for (const size_t i : front)
    path += fmt::format("{}{:.1f},{:.1f}", path.empty() ? "" : " ", time.pixel(points[i].time),
                        error.pixel(points[i].error));
  return fmt::format("<polyline class=\"{}\" points=\"{}\"/>", classes, path);
}

// The front over all methods; software and hardware apart, because they are not ranked against each other.
std::string overall_fronts(const Model& model, const std::vector<Series>& all, const LogAxis& time,
                           const LogAxis& error) {
  std::string out;
  for (const bool software : {true, false}) {
    std::vector<CostPoint> points;
    for (const Series& series : all)
      if (model.is_software(series.row->backend) == software)
        points.insert(points.end(), series.points.begin(), series.points.end());
    // Backends that draw the same image differ in the last digits: steps below 1 % are not worth a line.
    std::vector<size_t> front;
    for (const size_t i : pareto_front(points))
      if (front.empty() || points[i].error < 0.99 * points[front.back()].error) front.push_back(i);
    if (!front.empty()) out += polyline(points, front, time, error, "overall");
  }
  return out;
}

std::string point_text(const Model& model, const Series& series, const CostPoint& point, const PlotMetric& metric,
                       bool dominated) {
  const std::string& settings = model.settings[point.result];
  const Span span = error_span(model.results.results[point.result], point, metric.key);
  std::string text =
      fmt::format("{} on {}{}: {} ms ({} to {}), {} {}", series.row->method, series.row->backend,
                  settings.empty() ? "" : ", " + settings, milliseconds(point.time), milliseconds(point.time_lo),
                  milliseconds(point.time_hi), metric.title, scientific(point.error));
  if (span.lo < span.hi) text += fmt::format(" (views {} to {})", scientific(span.lo), scientific(span.hi));
  if (point.error > error_value(model.results.results[point.result].error->worst, metric.key))
    text += "; at the reference's bound";
  if (model.results.results[point.result].outcome == Outcome::WrongImage) text += "; counted as a wrong image";
  return text + (dominated ? "; dominated" : "");
}

std::string series_marks(const Model& model, const Series& series, const LogAxis& time, const LogAxis& error,
                         const PlotMetric& metric) {
  const std::string style = series_classes(*series.row);
  std::string out = polyline(series.points, series.front, time, error, "front " + style);
  for (size_t i = 0; i < series.points.size(); ++i) {
    const CostPoint& point = series.points[i];
    const bool dominated = std::find(series.front.begin(), series.front.end(), i) == series.front.end();
    const double x = time.pixel(point.time), y = error.pixel(point.error);
    const Span span = error_span(model.results.results[point.result], point, metric.key);
    out += fmt::format(
        "<g class=\"point {}{}\" tabindex=\"-1\" role=\"img\" data-cell=\"{}\" data-time=\"{:.17g}\" "
        "data-error=\"{:.17g}\" aria-label=\"{}\">",
        style, dominated ? " dominated" : "", point.result, point.time, point.error,
        escape(point_text(model, series, point, metric, dominated)));
    out += fmt::format("<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", time.pixel(point.time_lo),
                       time.pixel(point.time_hi), y, y);
    out += fmt::format("<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", x, x, error.pixel(span.lo),
                       error.pixel(span.hi));
    out += fmt::format("<g transform=\"translate({:.1f} {:.1f})\"><circle class=\"hit\" r=\"11\"/>{}</g></g>", x, y,
                       marker(*series.row));
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
  const auto [time, error] = axes_of(model, all, metric.key);
  std::string out = fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {} {}\" role=\"group\" aria-label=\"{} against time, {}\" "
      "data-metric=\"{}\">",
      kWidth, kHeight, metric.title, escape(model.title(block)), metric.key);
  out += frame(time, error, metric) + overall_fronts(model, all, time, error);
  for (const Series& series : all) out += series_marks(model, series, time, error, metric);
  return out + "</svg>";
}

std::string plot_legend(const Model& model, const Block& block) {
  std::string out = "<ul class=\"legend\" aria-label=\"Legend\">";
  for (const Row& row : block.rows) {
    if (model.points(row, "rmse").empty()) continue;
    const std::string style = series_classes(row);
    out += fmt::format(
        "<li><svg width=\"44\" height=\"14\" aria-hidden=\"true\"><polyline class=\"front {}\" points=\"1,7 43,7\"/>"
        "<g class=\"point {}\" transform=\"translate(22 7)\">{}</g></svg>{} <span class=\"dim\">{}</span></li>",
        style, style, marker(row), escape(row.method), escape(row.backend));
  }
  return out +
         "<li><svg width=\"44\" height=\"14\" aria-hidden=\"true\"><polyline class=\"overall\" points=\"2,7 42,7\"/>"
         "</svg>front over all</li></ul>";
}

}  // namespace volumark::html
