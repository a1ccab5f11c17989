// The fronts of a scene as a table: of each method, of each backend, and over all; the cells that no other one beats in
// both time and error.
#include <fmt/format.h>

#include "reports/html/format.h"
#include "reports/html/sections.h"

namespace volumark::html {
namespace {

std::string front_rows(const Model& model, const Front& front) {
  const std::string name = front.method.empty() ? front.backend.empty() ? "all" : front.backend : front.method;
  std::string out;
  for (const CostPoint& point : front.points) {
    const Result& cell = model.results.results[point.result];
    out += fmt::format(
        "<tr><th scope=\"row\">{}{}</th><td>{}</td><td>{}</td><td>{}</td><td class=\"num\">{} <span class=\"dim\">[{}, "
        "{}]</span></td><td class=\"num\">{} <span class=\"dim\">[{}, {}]</span></td><td class=\"num\">{}</td></tr>",
        escape(name), front.software ? "" : " <span class=\"tag hard\">hardware</span>", escape(cell.key.method),
        escape(cell.key.backend), escape(model.settings[point.result]), milliseconds(point.time),
        milliseconds(point.time_lo), milliseconds(point.time_hi), scientific(point.error), scientific(point.error_lo),
        scientific(point.error_hi), number(cell.error->worst.flip_p99));
  }
  return out;
}

}  // namespace

std::string fronts_table(const Model& model, const Block& block) {
  std::string all, rows;
  for (const Front& front : fronts(model.results, block.experiment, block.scene, "rmse")) {
    if (!front.method.empty() && !front.backend.empty()) continue;  // those are the lines of the plot
    (front.method.empty() && front.backend.empty() ? all : rows) += front_rows(model, front);
  }
  rows = all + rows;
  if (rows.empty()) return "";
  return folded("Table: the fronts over all, of each method, of each backend", table_text("Fronts",
                                                                                          {{"front of", false},
                                                                                           {"method", false},
                                                                                           {"backend", false},
                                                                                           {"setting", false},
                                                                                           {"ms [interval]", true},
                                                                                           {"RMSE [views]", true},
                                                                                           {"FLIP p99", true}},
                                                                                          rows, "wide snug"));
}

}  // namespace volumark::html
