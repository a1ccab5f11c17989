// A part for each paper, and in it for each experiment that replays it: the pictures side by side, what the paper
// prints beside what was measured here, and its claims with their verdicts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "reports/html/format.h"
#include "reports/html/sections.h"
#include "reports/paper_table.h"

namespace volumark::html {
namespace {

std::string figure(double value, const std::string& absent) { return std::isfinite(value) ? number(value) : absent; }

std::string number_cell(const std::string& text, double value) {
  return fmt::format("<td class=\"num\" data-value=\"{}\">{}</td>", std::isfinite(value) ? value : -1.0, text);
}

// One experiment of one paper: what a part of the section is about.
struct Replay {
  std::string paper, experiment;
};

bool is_of(const Result& result, const Replay& replay) {
  return result.paper && result.paper->key == replay.paper && result.key.experiment == replay.experiment;
}

bool is_of(const Claim& claim, const Replay& replay) {
  return claim.paper == replay.paper && claim.experiment == replay.experiment;
}

// In the order of the file; the claims of files that name no paper last.
std::vector<Replay> replays_of(const Model& model) {
  std::vector<Replay> out;
  const auto add = [&](const std::string& paper, const std::string& experiment) {
    if (std::none_of(out.begin(), out.end(),
                     [&](const Replay& known) { return known.paper == paper && known.experiment == experiment; }))
      out.push_back({paper, experiment});
  };
  for (const Result& result : model.results.results)
    if (result.paper) add(result.paper->key, result.key.experiment);
  for (const Claim& claim : model.results.claims) add(claim.paper, claim.experiment);
  std::stable_partition(out.begin(), out.end(), [](const Replay& replay) { return !replay.paper.empty(); });
  return out;
}

// The pictures of the cells that the paper shows, beside each other and beside the reference: of each scene and view
// once, on the first backend that has them (the others are held to the same picture elsewhere in the report).
std::string pictures_part(const Model& model, const PictureBook& book, const Replay& replay) {
  std::vector<std::string> scenes;  // scene and view, in order
  std::map<std::string, std::string> backend, shown;
  for (size_t e = 0; e < book.entries.size(); ++e) {
    const PictureEntry& entry = book.entries[e];
    const Result& result = model.results.results[entry.cell];
    if (!is_of(result, replay) || entry.rendered < 0) continue;
    const ViewResult& view = result.views[entry.view];
    const std::string scene = result.key.scene + ", " + (view.name.empty() ? "view" : view.name);
    if (backend.emplace(scene, result.key.backend).second) {
      scenes.push_back(scene);
      if (entry.reference >= 0) shown[scene] += thumb(e, entry.reference, "reference", "double precision", "");
    }
    if (backend[scene] != result.key.backend) continue;
    shown[scene] += thumb(e, entry.rendered, escape(result.paper->cell), escape(result.key.backend),
                          view.error ? "RMSE " + scientific(view.error->rmse) : "");
  }
  std::string out;
  for (const std::string& scene : scenes)
    out += "<p class=\"hint\">" + escape(scene) + "</p><ul class=\"thumbs\" aria-label=\"Pictures of " + escape(scene) +
           "; opens the comparison\">" + shown[scene] + "</ul>";
  return out;
}

std::string cells_part(const Model& model, const Replay& replay) {
  std::string rows;
  for (const Result& result : model.results.results) {
    if (!is_of(result, replay)) continue;
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
  return "<h5>Published and measured</h5><p class=\"hint\">Published figures are of the paper's machine and are not "
         "judged.</p>" +
         table_text("Published cells of " + replay.experiment,
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

std::string claims_part(const Model& model, const Replay& replay) {
  const std::vector<Claim>& claims = model.results.claims;
  std::string rows;
  for (size_t i = 0; i < claims.size(); ++i) {
    const Claim& claim = claims[i];
    if (!is_of(claim, replay)) continue;
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
  return "<h5>Claims</h5>" + table_text("Claims of " + replay.experiment,
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

// How many verdicts came out which way; a claim has one on each backend.
std::string verdict_line(const Model& model, const std::string& paper) {
  std::map<std::string, int> count;
  for (const Claim& claim : model.results.claims)
    if (claim.paper == paper) ++count[verdict_words(claim.verdict)];
  std::string out;
  for (const auto& [words, number] : count) out += (out.empty() ? "" : ", ") + fmt::format("{} {}", number, words);
  return out.empty() ? "" : "<p class=\"facts\"><span>Verdicts, each backend apart: " + escape(out) + "</span></p>";
}

std::string heading(const Model& model, const Replay& replay) {
  for (const ExperimentResultInfo& info : model.results.experiments)
    if (info.name == replay.experiment)
      return "<h4>" + escape(info.title.empty() ? info.name : info.title) + "</h4>" +
             (info.description.empty() ? "" : "<p>" + escape(info.description) + "</p>");
  return replay.experiment.empty() ? "" : "<h4>" + escape(replay.experiment) + "</h4>";
}

}  // namespace

std::string claims_table(const Model& model, const PictureBook& book) {
  std::string out, paper;
  for (const Replay& replay : replays_of(model)) {
    const std::string inside =
        pictures_part(model, book, replay) + cells_part(model, replay) + claims_part(model, replay);
    if (inside.empty()) continue;
    if (!replay.paper.empty() && replay.paper != paper)
      out += "<h3>" + escape(replay.paper) + "</h3>" + verdict_line(model, replay.paper);
    paper = replay.paper;
    out += heading(model, replay) + inside;
  }
  return out.empty() ? "" : "<section id=\"claims\"><h2>Papers: what they print and claim</h2>" + out + "</section>";
}

}  // namespace volumark::html
