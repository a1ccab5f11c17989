// Where the error comes from: for each explained cell a stacked bar of what making one thing ideal takes away, and the
// table behind it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/html/bars.h"
#include "reports/html/format.h"
#include "reports/html/sections.h"

namespace volumark::html {
namespace {

std::string percent(double share) {
  if (!std::isfinite(share)) return number(share);
  if (share != 0 && std::abs(share) < .0005) return share > 0 ? "&lt; 0.1 %" : "&gt; &minus;0.1 %";
  return fmt::format("{}{:.1f} %", share < 0 ? "&minus;" : "", 100 * std::abs(share));
}

// Aspects of a scene's attributions, each once: pattern and letter are the same in all its bars.
std::vector<std::string> aspects_of(const std::vector<const Attribution*>& rows) {
  std::vector<std::string> out;
  for (const Attribution* row : rows)
    for (const AttributionPart& part : row->parts)
      if (std::find(out.begin(), out.end(), part.aspect) == out.end()) out.push_back(part.aspect);
  return out;
}

size_t index_in(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

std::string letter_of(size_t index) { return std::string(1, static_cast<char>('A' + index % 26)); }

std::string cell_text(const Model& model, const CellKey& key) {
  for (size_t i = 0; i < model.results.results.size(); ++i)
    if (model.results.results[i].key == key)
      return key.method + " on " + key.backend + (model.settings[i].empty() ? "" : ", " + model.settings[i]);
  std::string params;  // a cell of no result: all that it says
  for (const auto& [name, value] : key.params) params += ", " + name + " " + to_text(value);
  return key.method + " on " + key.backend + params;
}

std::string bar_row(const Model& model, const Attribution& row, const std::vector<std::string>& aspects) {
  std::vector<Segment> segments;
  std::string words;
  for (const AttributionPart& part : row.parts) {
    if (!std::isfinite(part.worth)) continue;
    const size_t at = index_in(aspects, part.aspect);
    segments.push_back({part.worth, at, letter_of(at), part.aspect + ": " + fmt::format("{:.1f} %", 100 * part.worth)});
    if (std::abs(part.worth) >= .005)
      words += (words.empty() ? "" : ", ") + escape(part.aspect) + " " + percent(part.worth);
  }
  const double left = row.error > 0 ? row.all_ideal * row.all_ideal / (row.error * row.error) : 0;
  return "<li><p><b>" + escape(cell_text(model, row.key)) + "</b> <span class=\"dim\">RMSE " + scientific(row.error) +
         (row.seconds > 0 ? " in " + milliseconds(row.seconds) + " ms" : "") + "</span></p>" + stacked_bar(segments) +
         "<p class=\"hint\">" + (words.empty() ? "nothing that can be made ideal is worth 0.5 %" : words) +
         "; with all ideal " + scientific(row.all_ideal) + " is left, " + percent(left) + " of the squared error" +
         (row.all_ideal <= row.bound ? " (at the reference's bound)" : "") + "</p></li>";
}

std::string part_row(const Model& model, const Attribution& row, const AttributionPart& part, size_t aspect) {
  return fmt::format(
      "<tr><th scope=\"row\">{}</th><td>{} <b>{}</b> {}</td><td>{}</td><td>{} &rarr; {}</td><td class=\"num\" "
      "data-value=\"{:.17g}\">{}</td><td class=\"num\" data-value=\"{:.17g}\">{}</td><td class=\"num\">{}</td><td>{}"
      "</td></tr>",
      escape(cell_text(model, row.key)), swatch(aspect), letter_of(aspect), escape(part.aspect), escape(part.parameter),
      escape(to_text(part.from)), escape(to_text(part.to)), part.error, scientific(part.error), part.worth,
      percent(part.worth), part.seconds > 0 ? milliseconds(part.seconds) : "-",
      escape(part.note) +
          (part.worth < -.005 ? std::string(part.note.empty() ? "" : "; ") + "two errors had cancelled" : ""));
}

}  // namespace

std::string attribution_part(const Model& model, const Block& block) {
  std::vector<const Attribution*> rows;
  for (const Attribution& row : model.results.attribution)
    if (row.key.experiment == block.experiment && row.key.scene == block.scene) rows.push_back(&row);
  if (rows.empty()) return "";
  const std::vector<std::string> aspects = aspects_of(rows);
  std::string bars, table, legend, commands;
  for (size_t i = 0; i < aspects.size(); ++i)
    legend += "<li>" + swatch(i) + "<b>" + letter_of(i) + "</b> " + escape(aspects[i]) + "</li>";
  for (const Attribution* row : rows) {
    bars += bar_row(model, *row, aspects);
    for (const AttributionPart& part : row->parts) table += part_row(model, *row, part, index_in(aspects, part.aspect));
    if (!row->command.empty()) commands += "<li>" + command_box(row->command) + "</li>";
  }
  return "<h4>Where the error comes from</h4><p class=\"hint\">Share of the squared error (RMSE&sup2;, worst view) "
         "that goes away when one thing is made ideal and all else stays. The line marks 100 %. Shares need not add up "
         "to it: errors overlap. To the left of zero: making it ideal makes the error larger, because two errors had "
         "cancelled.</p><ul class=\"legend\" aria-label=\"Legend\">" +
         legend + "</ul><ul class=\"bars attribution\">" + bars + "</ul>" +
         folded("Table: what each is worth", table_text("Attribution",
                                                        {{"cell", false},
                                                         {"made ideal", false},
                                                         {"parameter", false},
                                                         {"from, to", false},
                                                         {"RMSE then", true},
                                                         {"worth", true},
                                                         {"ms then", true},
                                                         {"note", false}},
                                                        table, "wide sortable")) +
         (commands.empty() ? "" : folded("Commands: run these again", "<ul class=\"commands\">" + commands + "</ul>"));
}

}  // namespace volumark::html
