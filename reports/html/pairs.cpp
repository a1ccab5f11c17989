// Method against method: who is closer to the reference and who is faster, as a matrix for each scene, with the figures
// behind it.
#include <fmt/format.h>

#include <algorithm>

#include "reports/html/format.h"
#include "reports/html/sections.h"

namespace volumark::html {
namespace {

// The winner's name; what is not decided keeps its word.
std::string winner(const PairRow& row, const std::string& verdict) {
  return verdict == "a" ? row.a.method : verdict == "b" ? row.b.method : verdict;
}

std::string short_winner(const PairRow& row, const std::string& verdict) {
  return verdict == "a" || verdict == "b" ? "<b>" + escape(winner(row, verdict)) + "</b>" : escape(verdict);
}

std::vector<std::string> methods_of(const std::vector<const PairRow*>& rows) {
  std::vector<std::string> out;
  for (const PairRow* row : rows)
    for (const std::string& name : {row->a.method, row->b.method})
      if (std::find(out.begin(), out.end(), name) == out.end()) out.push_back(name);
  return out;
}

// Lines of one field, a backend each: above the diagonal who is closer, below it who is faster.
std::string field(const std::vector<const PairRow*>& rows, const std::string& a, const std::string& b, bool error) {
  std::string out;
  for (const PairRow* row : rows) {
    const bool here = (row->a.method == a && row->b.method == b) || (row->a.method == b && row->b.method == a);
    if (!here) continue;
    out += "<li><span class=\"dim\">" + escape(row->a.backend) + "</span> " +
           short_winner(*row, error ? row->error_verdict : row->time_verdict) +
           (error ? " <span class=\"dim\">apart " + scientific(row->rmse) + "</span>" : "") + "</li>";
  }
  return out.empty() ? "<td class=\"none\">-</td>" : "<td><ul class=\"plain\">" + out + "</ul></td>";
}

std::string matrix(const std::vector<const PairRow*>& rows) {
  const std::vector<std::string> methods = methods_of(rows);
  std::string out =
      "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Method against method\"><table "
      "class=\"matrix\">"
      "<thead><tr><td></td>";
  for (const std::string& name : methods) out += "<th scope=\"col\">" + escape(name) + "</th>";
  out += "</tr></thead><tbody>";
  for (size_t a = 0; a < methods.size(); ++a) {
    out += "<tr><th scope=\"row\">" + escape(methods[a]) + "</th>";
    for (size_t b = 0; b < methods.size(); ++b)
      out += a == b ? "<td class=\"none\" aria-label=\"the same method\">\\</td>"
                    : field(rows, methods[a], methods[b], a < b);
    out += "</tr>";
  }
  return out + "</tbody></table></div>";
}

std::string key_text(const Model& model, const CellKey& key) {
  for (size_t i = 0; i < model.results.results.size(); ++i)
    if (model.results.results[i].key == key)
      return key.method + (model.settings[i].empty() ? "" : ", " + model.settings[i]);
  return key.method;
}

std::string figures(const Model& model, const PairRow& row) {
  auto figure = [](double value) {
    return fmt::format("<td class=\"num\" data-value=\"{:.17g}\">{}</td>", value, scientific(value));
  };
  return "<tr><th scope=\"row\">" + escape(key_text(model, row.a)) + "</th><th scope=\"row\">" +
         escape(key_text(model, row.b)) + "</th><td>" + escape(row.a.backend) + "</td>" + figure(row.rmse) +
         figure(row.max) + figure(row.flip_p99) + figure(row.noise_a) + figure(row.noise_b) + figure(row.bound) +
         "<td>" + verdict_badge(winner(row, row.error_verdict)) + "</td><td>" +
         verdict_badge(winner(row, row.time_verdict)) + "</td><td>" + escape(row.reason) + "</td></tr>";
}

}  // namespace

std::string pairs_part(const Model& model, const Block& block) {
  std::vector<const PairRow*> rows;
  for (const PairRow& row : model.results.pairs)
    if (row.a.experiment == block.experiment && row.a.scene == block.scene) rows.push_back(&row);
  if (rows.empty()) return "";
  std::string table;
  for (const PairRow* row : rows) table += figures(model, *row);
  return "<h4>Method against method</h4><p class=\"hint\">Each at the finest value of its axis, picture against "
         "picture. "
         "Above the diagonal: who is closer to the reference, and how far the two pictures are apart (RMSE). Below it: "
         "who is faster. Indistinguishable: the intervals, with the reference's bound and the noise of a second "
         "drawing, overlap.</p>" +
         matrix(rows) +
         folded("Table: figures of each pair", table_text("Pairs of methods",
                                                          {{"a", false},
                                                           {"b", false},
                                                           {"backend", false},
                                                           {"RMSE a to b", true},
                                                           {"max", true},
                                                           {"FLIP p99", true},
                                                           {"noise a", true},
                                                           {"noise b", true},
                                                           {"bound", true},
                                                           {"closer", false},
                                                           {"faster", false},
                                                           {"reason", false}},
                                                          table, "wide sortable"));
}

}  // namespace volumark::html
