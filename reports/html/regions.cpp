// Errors by region of the picture, since a dark background dilutes every mean: the most accurate cell of each row.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "reports/html/bars.h"
#include "reports/html/format.h"
#include "reports/html/sections.h"

namespace volumark::html {
namespace {

const Result* most_accurate(const Model& model, const Row& row) {
  const Result* best = nullptr;
  for (const size_t i : row.cells) {
    const Result& result = model.results.results[i];
    if (!result.error || result.error->worst.regions.empty() || shows_nothing(result)) continue;
    if (best == nullptr || result.error->worst.rmse < best->error->worst.rmse) best = &result;
  }
  return best;
}

}  // namespace

std::string regions_part(const Model& model, const Block& block) {
  static const std::vector<std::string> known = {"silhouette", "grazing", "interior", "background"};
  std::vector<std::pair<const Row*, const Result*>> cells;
  std::set<std::string> seen;
  double largest = 0;
  for (const Row& row : block.rows)
    if (const Result* cell = most_accurate(model, row)) {
      cells.emplace_back(&row, cell);
      for (const auto& [name, region] : cell->error->worst.regions) {
        seen.insert(name);
        largest = std::max(largest, region.rmse);
      }
    }
  if (cells.empty()) return "";
  std::vector<std::string> names;
  for (const std::string& name : known)
    if (seen.erase(name) > 0) names.push_back(name);
  names.insert(names.end(), seen.begin(), seen.end());

  std::vector<std::pair<std::string, bool>> columns = {{"most accurate cell", false}, {"whole picture", true}};
  for (const std::string& name : names) columns.emplace_back(escape(name), false);
  std::string rows;
  for (const auto& [row, cell] : cells) {
    const size_t index = static_cast<size_t>(cell - model.results.results.data());
    rows += "<tr><th scope=\"row\">" + escape(row->method + " on " + row->backend) + " <span class=\"dim\">" +
            escape(model.settings[index]) + "</span></th><td class=\"num\">" + scientific(cell->error->worst.rmse) +
            "</td>";
    for (size_t i = 0; i < names.size(); ++i) {
      const auto region = cell->error->worst.regions.find(names[i]);
      if (region == cell->error->worst.regions.end()) {
        rows += "<td class=\"none\">-</td>";
        continue;
      }
      const RegionError& e = region->second;
      rows += e.pixels == 0
                  ? "<td class=\"none\">no pixel</td>"
                  : fmt::format("<td data-value=\"{:.17g}\" title=\"max {}, {} pixels\">{}</td>", e.rmse,
                                scientific(e.max), e.pixels,
                                bar(largest > 0 ? e.rmse / largest : 0, i,
                                    scientific(e.rmse) + " <span class=\"dim\">max " + scientific(e.max) + "</span>"));
    }
    rows += "</tr>";
  }
  return "<h4>Error by region</h4><p class=\"hint\">RMSE of the pixels of each region, worst view. Silhouette: the "
         "reference's alpha changes within 3 &times; 3 pixels; grazing: the surface is seen edge-on; background: "
         "nothing "
         "is there.</p>" +
         table_text("Error by region", columns, rows, "wide regions");
}

}  // namespace volumark::html
