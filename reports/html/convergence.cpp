// How the error falls along the quality axis: plot with the expected slope, and the table of fitted orders and floors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/html/format.h"
#include "reports/html/log_plot.h"
#include "reports/html/marker.h"
#include "reports/html/sections.h"

namespace volumark::html {
namespace {

std::string range(const std::vector<double>& values, std::string (*text)(double)) {
  if (values.empty()) return "";
  return text(values.front()) + (values.size() > 1 ? " &rarr; " + text(values.back()) : "");
}

bool drawable(double value, double error) {
  return value > 0 && error > 0 && std::isfinite(value) && std::isfinite(error);
}

std::vector<const Convergence*> series_of(const Model& model, const Block& block) {
  std::vector<const Convergence*> out;
  for (const Convergence& row : model.results.convergence)
    if (row.key.experiment == block.experiment && row.key.scene == block.scene) out.push_back(&row);
  return out;
}

std::vector<std::pair<double, double>> points_of(const Convergence& series) {
  std::vector<std::pair<double, double>> out;
  for (size_t i = 0; i < std::min(series.values.size(), series.errors.size()); ++i)
    if (drawable(series.values[i], series.errors[i])) out.emplace_back(series.values[i], series.errors[i]);
  return out;
}

// Some axes count what is done (slices): their finer values are larger, and the error falls with their inverse.
bool finer_is_larger(const Convergence& series) {
  return series.values.size() > 1 && series.values.back() > series.values.front();
}

// The slope that is expected, from the coarsest point on, as long as it stays within the frame.
std::string expected_slope(const PlotAxes& axes, PlotLabels& labels, const Convergence& series) {
  const auto points = points_of(series);
  if (!(series.expected > 0) || points.size() < 2) return "";
  const auto [v0, e0] = points.front();
  const double power = finer_is_larger(series) ? -series.expected : series.expected;
  double end = points.back().first, error = e0 * std::pow(end / v0, power);
  if (error < axes.y.lo()) {  // it leaves the frame before
    error = axes.y.lo();
    end = v0 * std::pow(error / e0, 1 / power);
  }
  if (!(error < e0)) return "";
  return plot_line(axes, {{v0, e0}, {end, error}}, "slope") +
         labels.put(std::sqrt(v0 * end), std::sqrt(e0 * error), "order " + compact(series.expected));
}

std::string cell_data(const Model& model, const Row* row, double value) {
  if (row != nullptr)
    for (const size_t i : row->cells) {
      const Result& cell = model.results.results[i];
      if (cell.quality && cell.quality->value == value) return fmt::format("data-cell=\"{}\"", i);
    }
  return "";
}

std::string drawn_series(const Model& model, const Block& block, const PlotAxes& axes, PlotLabels& labels,
                         const Convergence& series) {
  const Row* found = model.row_of(block, series.key);
  const Row row = found != nullptr ? *found : Row{series.key.method, series.key.backend, "", true, 0, 0, 0, {}};
  const auto points = points_of(series);
  std::string out = plot_line(axes, points, "front " + series_classes(row));
  const std::string letter = found != nullptr ? block.letter(row) : "";
  if (!letter.empty() && !points.empty()) out += labels.put(points.back().first, points.back().second, letter);
  for (const auto& [value, error] : points) {
    PlotPoint point;
    point.x = value;
    point.y = error;
    point.label =
        fmt::format("{}: {} {}, RMSE {}", model.name(block, row), series.parameter, compact(value), scientific(error));
    point.data = cell_data(model, found, value);
    out += plot_point(axes, row, point);
  }
  return out;
}

std::string convergence_plot(const Model& model, const Block& block, const std::vector<const Convergence*>& all,
                             const std::string& parameter) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  double v0 = inf, v1 = 0, e0 = inf, e1 = 0;
  bool larger = false;
  for (const Convergence* series : all)
    if (series->parameter == parameter) {
      larger = larger || finer_is_larger(*series);
      for (const auto& [value, error] : points_of(*series)) {
        v0 = std::min(v0, value);
        v1 = std::max(v1, value);
        e0 = std::min(e0, error);
        e1 = std::max(e1, error);
      }
    }
  if (!(e1 > 0)) return "";
  const PlotAxes axes{plot_x_axis(v0, v1),
                      plot_y_axis(e0, e1),
                      1,
                      parameter + (larger ? " (finer to the right)" : " (finer to the left)"),
                      "RMSE, worst view",
                      kErrorTargets};
  std::string out = fmt::format(
      "<figure><svg class=\"plot\" data-plot=\"convergence\" viewBox=\"0 0 {} {}\" role=\"group\" aria-label=\"RMSE "
      "against {}, {}\">",
      kPlotWidth, kPlotHeight, escape(parameter), escape(model.title(block)));
  out += plot_frame(axes);
  PlotLabels labels(axes);
  std::vector<std::pair<std::string, double>> slopes;  // one line for each order that a method states
  for (const Convergence* series : all) {
    if (series->parameter != parameter) continue;
    const std::pair<std::string, double> slope{series->key.method, series->expected};
    if (std::find(slopes.begin(), slopes.end(), slope) != slopes.end()) continue;
    slopes.push_back(slope);
    out += expected_slope(axes, labels, *series);
  }
  for (const Convergence* series : all)
    if (series->parameter == parameter) out += drawn_series(model, block, axes, labels, *series);
  return out + "</svg><figcaption class=\"sr\">RMSE against " + escape(parameter) + "</figcaption></figure>";
}

std::string floor_text(const Convergence& row) {
  if (!(row.floor > 0)) return "<span class=\"dim\">still falling</span>";
  return scientific(row.floor) +
         (row.floor_reason.empty() ? "" : " <span class=\"why\">" + escape(row.floor_reason) + "</span>");
}

std::string table_row(const Model& model, const Block& block, const Convergence& row) {
  const Row* series = model.row_of(block, row.key);
  const std::string setting =
      series != nullptr && block.settings.size() > 1 && !series->setting.empty()
          ? " <span class=\"setting\"><b>" + block.letter(*series) + "</b> " + escape(series->setting) + "</span>"
          : "";
  std::string out = fmt::format(
      "<tr><th scope=\"row\">{}</th><td>{}{}</td><td>{} {} <span class=\"dim\">({})</span></td><td "
      "class=\"num\">{}</td>",
      escape(row.key.method), escape(row.key.backend), setting, escape(row.parameter), range(row.values, compact),
      row.values.size(), range(row.errors, scientific));
  out += row.fitted_points > 0 ? fmt::format(
                                     "<td class=\"num\"><b>{:.2f}</b> <span class=\"dim\">[{:.2f}, {:.2f}]</span></td>"
                                     "<td class=\"num\">{}</td>",
                                     row.fitted, row.fitted_lo, row.fitted_hi, row.fitted_points)
                               : "<td class=\"num\">n/a</td><td class=\"num\">0</td>";
  return out +
         fmt::format("<td class=\"num\">{}</td><td class=\"floor\">{}</td><td>{}</td><td class=\"reason\">{}</td></tr>",
                     row.expected > 0 ? compact(row.expected) : "n/a", floor_text(row), verdict_badge(row.verdict),
                     escape(row.reason));
}

}  // namespace

std::string convergence_part(const Model& model, const Block& block) {
  const std::vector<const Convergence*> all = series_of(model, block);
  if (all.empty()) return "";
  std::string rows, plots;
  std::vector<std::string> parameters;
  for (const Convergence* row : all) {
    rows += table_row(model, block, *row);
    if (std::find(parameters.begin(), parameters.end(), row->parameter) == parameters.end())
      parameters.push_back(row->parameter);
  }
  for (const std::string& parameter : parameters) plots += convergence_plot(model, block, all, parameter);
  return "<h4>Order of convergence: RMSE ~ step<sup>order</sup></h4>" +
         (plots.empty() ? ""
                        : "<div class=\"plots one\">" + plots +
                              "</div><p class=\"hint\">Dashed: the slope that the "
                              "method states. A line that bends to the level has met its floor.</p>") +
         table_text("Convergence",
                    {{"method", false},
                     {"backend", false},
                     {"axis (values)", false},
                     {"RMSE, coarse to fine", true},
                     {"fitted [interval]", true},
                     {"points", true},
                     {"expected", true},
                     {"floor, and what holds it there", false},
                     {"verdict", false},
                     {"reason", false}},
                    rows, "wide convergence");
}

}  // namespace volumark::html
