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

std::string settings_text(const Model& model, const CellKey& key) {
  for (size_t i = 0; i < model.results.results.size(); ++i)
    if (model.results.results[i].key == key) return model.settings[i];
  std::string out;  // a cell of no result: all that it says
  for (const auto& [name, value] : key.params) out += (out.empty() ? "" : ", ") + name + " " + to_text(value);
  return out;
}

std::string cell_text(const Model& model, const CellKey& key) {
  const std::string settings = settings_text(model, key);
  return key.method + " on " + key.backend + (settings.empty() ? "" : ", " + settings);
}

// Backends that run the same arithmetic have the same errors: one bar says so for all of them.
struct Bar {
  const Attribution* row;
  std::vector<std::string> backends;
};

bool same_but_backend(const Attribution& a, const Attribution& b) {
  constexpr double kSame = .005;  // of the squared error, and of the error
  if (a.key.method != b.key.method || a.key.params != b.key.params || a.key.variant != b.key.variant ||
      a.parts.size() != b.parts.size() || a.note != b.note || !(std::abs(a.error - b.error) <= kSame * a.error) ||
      !(std::abs(a.all_ideal - b.all_ideal) <= kSame * a.error))
    return false;
  return std::all_of(a.parts.begin(), a.parts.end(), [&](const AttributionPart& part) {
    return std::any_of(b.parts.begin(), b.parts.end(), [&](const AttributionPart& other) {
      return other.aspect == part.aspect && other.note == part.note &&
             ((std::isnan(other.worth) && std::isnan(part.worth)) || std::abs(other.worth - part.worth) <= kSame);
    });
  });
}

std::vector<Bar> bars_of(const std::vector<const Attribution*>& rows) {
  std::vector<Bar> out;
  for (const Attribution* row : rows) {
    const auto same =
        std::find_if(out.begin(), out.end(), [&](const Bar& bar) { return same_but_backend(*bar.row, *row); });
    if (same == out.end())
      out.push_back({row, {row->key.backend}});
    else
      same->backends.push_back(row->key.backend);
  }
  return out;
}

std::string bar_row(const Model& model, const Bar& bar, const std::vector<std::string>& aspects) {
  const Attribution& row = *bar.row;
  std::vector<Segment> segments;
  std::string words, backends;
  for (const AttributionPart& part : row.parts) {
    if (!std::isfinite(part.worth)) continue;
    const size_t at = index_in(aspects, part.aspect);
    segments.push_back({part.worth, at, letter_of(at), part.aspect + ": " + fmt::format("{:.1f} %", 100 * part.worth)});
    if (std::abs(part.worth) >= .005)
      words += (words.empty() ? "" : ", ") + escape(part.aspect) + " " + percent(part.worth);
  }
  for (const std::string& backend : bar.backends) backends += (backends.empty() ? "" : ", ") + backend;
  const double left = row.error > 0 ? row.all_ideal * row.all_ideal / (row.error * row.error) : 0;
  if (words.empty()) words = row.parts.empty() ? "no part of it can be made ideal" : "no part of it is worth 0.5 %";
  std::string out = "<li><p><b>" + escape(row.key.method + " on " + backends) + "</b> " +
                    escape(settings_text(model, row.key)) + " <span class=\"dim\">RMSE " + scientific(row.error);
  if (bar.backends.size() == 1 && row.seconds > 0) out += " in " + milliseconds(row.seconds) + " ms";
  out += "</span></p>" + (segments.empty() ? "" : stacked_bar(segments)) + "<p class=\"hint\">" + words;
  // Not all of it can always be made ideal at once (memory): the note says so.
  if (row.note.empty() && !row.parts.empty())
    out += "; with all ideal " + scientific(row.all_ideal) + " is left, " + percent(left) + " of the squared error" +
           (row.all_ideal <= row.bound ? " (at the reference's bound)" : "");
  return out + (row.note.empty() ? "" : "; " + escape(row.note)) + "</p></li>";
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
  for (const Bar& bar : bars_of(rows)) bars += bar_row(model, bar, aspects);
  for (const Attribution* row : rows) {
    for (const AttributionPart& part : row->parts) table += part_row(model, *row, part, index_in(aspects, part.aspect));
    if (!row->command.empty()) commands += "<li>" + command_box(row->command) + "</li>";
  }
  return "<h4>Where the error comes from</h4><p class=\"hint\">Share of the squared error (RMSE&sup2;, worst view) "
         "that goes away when one thing is made ideal and all else stays. The line marks 100 %. Shares need not add up "
         "to it: errors overlap. To the left of zero: making it ideal makes the error larger, because two errors had "
         "cancelled (an arrow: by more than the bar shows).</p><ul class=\"legend\" aria-label=\"Legend\">" +
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
