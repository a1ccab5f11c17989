// A part for each paper: what it prints beside what was measured here, then its claims with their verdicts.
#include <fmt/format.h>

#include <cmath>

#include "reports/html/format.h"
#include "reports/html/sections.h"
#include "reports/paper_table.h"

namespace volumark::html {
namespace {

std::string figure(double value, const std::string& absent) { return std::isfinite(value) ? number(value) : absent; }

std::string number_cell(const std::string& text, double value) {
  return fmt::format("<td class=\"num\" data-value=\"{}\">{}</td>", std::isfinite(value) ? value : -1.0, text);
}

std::string cells_part(const Model& model, const std::string& paper) {
  std::string rows;
  for (const Result& result : model.results.results) {
    if (!result.paper || result.paper->key != paper) continue;
    const PaperCell& cell = *result.paper;
    const double ours = our_figure(result), ratio = ours / cell.published;
    rows += "<tr><td>" + escape(cell.table) + "</td><th scope=\"row\">" + escape(cell.cell) + "</th><td>" +
            escape(result.key.scene) + "</td><td>" + escape(result.key.backend) +
            software_tag(model, result.key.backend) + "</td><td>" + escape(cell.unit) + "</td>" +
            number_cell(figure(cell.published, "not printed"), cell.published) +
            number_cell(figure(ours, escape(to_string(result.outcome))), ours) +
            number_cell(figure(ratio, "&ndash;"), ratio) + "</tr>";
  }
  if (rows.empty()) return "";
  return "<h4>Published and measured</h4><p class=\"hint\">Published figures are of the paper's machine and are not "
         "judged.</p>" +
         table_text("Published cells of " + paper,
                    {{"table", false},
                     {"cell", false},
                     {"scene", false},
                     {"backend", false},
                     {"unit", false},
                     {"published", true},
                     {"ours", true},
                     {"ours / published", true}},
                    rows, "wide sortable");
}

std::string wanted_text(const Claim& claim) {
  if (claim.limit_lo && claim.limit_hi) return number(*claim.limit_lo) + " to " + number(*claim.limit_hi);
  if (claim.limit_lo) return "at least " + number(*claim.limit_lo);
  if (claim.limit_hi) return "at most " + number(*claim.limit_hi);
  return figure(claim.expected, "&ndash;");
}

std::string interval_text(const Claim& claim) {
  if (claim.measured_lo == claim.measured_hi || !std::isfinite(claim.measured_lo)) return "";
  return " <span class=\"dim\">[" + number(claim.measured_lo) + ", " + number(claim.measured_hi) + "]</span>";
}

bool same_claim(const Claim& a, const Claim& b) {
  return a.paper == b.paper && a.experiment == b.experiment && a.id == b.id;
}

// What all backends of a claim share, once: cells that span their rows.
std::string claim_head(const Claim& claim, size_t rows) {
  const std::string span = rows > 1 ? fmt::format(" rowspan=\"{}\"", rows) : "";
  return "<th scope=\"row\"" + span + ">" + escape(claim.id) + "</th><td" + span + ">" + escape(claim.text) +
         "</td><td" + span + ">" + escape(claim.rule) + "</td><td" + span + ">" + escape(claim.measure) + "</td>";
}

std::string claims_part(const Model& model, const std::string& paper) {
  const std::vector<Claim>& claims = model.results.claims;
  std::string rows;
  for (size_t i = 0; i < claims.size(); ++i) {
    const Claim& claim = claims[i];
    if (claim.paper != paper) continue;
    size_t end = i + 1;
    while (end < claims.size() && same_claim(claims[end], claim)) ++end;
    const bool first = i == 0 || !same_claim(claims[i - 1], claim);
    rows += "<tr>" + (first ? claim_head(claim, end - i) : "") + "<td>" + escape(claim.backend) +
            (claim.backend.empty() ? "" : software_tag(model, claim.backend)) + "</td><td class=\"num\">" +
            figure(claim.measured, "&ndash;") + interval_text(claim) + "</td><td class=\"num\">" + wanted_text(claim) +
            "</td><td>" + verdict_badge(verdict_words(claim.verdict)) + "</td><td>" + escape(claim.reason) +
            "</td></tr>";
  }
  if (rows.empty()) return "";
  return "<h4>Claims</h4>" + table_text("Claims",
                                        {{"claim", false},
                                         {"text", false},
                                         {"rule", false},
                                         {"measure", false},
                                         {"backend", false},
                                         {"measured", true},
                                         {"wanted", true},
                                         {"verdict", false},
                                         {"reason", false}},
                                        rows, "wide");
}

}  // namespace

std::string claims_table(const Model& model) {
  std::vector<std::string> papers = papers_of(model.results);
  papers.emplace_back();  // claims of files that do not name a paper
  std::string out;
  for (const std::string& paper : papers) {
    const std::string inside = cells_part(model, paper) + claims_part(model, paper);
    if (!inside.empty()) out += (paper.empty() ? "" : "<h3>" + escape(paper) + "</h3>") + inside;
  }
  return out.empty() ? "" : "<section id=\"claims\"><h2>Papers: what they print and claim</h2>" + out + "</section>";
}

}  // namespace volumark::html
