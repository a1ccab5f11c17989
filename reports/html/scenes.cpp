// A section for each scene: what it is, its two plots, how the methods converge, a small picture of each row.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/html/format.h"
#include "reports/html/plot.h"
#include "reports/html/sections.h"

namespace volumark::html {
namespace {

std::string facts(const SceneResultInfo& info) {
  std::string out = "<p class=\"facts\">";
  if (!info.voxel_type.empty())
    out += fmt::format("<span>{} &times; {} &times; {} voxels, {}</span>", info.voxels[0], info.voxels[1],
                       info.voxels[2], escape(info.voxel_type));
  std::string effects;
  for (const std::string& effect : info.effects) effects += (effects.empty() ? "" : ", ") + effect;
  out += "<span><span class=\"dim\">effects</span> " + (effects.empty() ? "none" : escape(effects)) + "</span>";
  if (!info.origin.empty()) out += "<span><span class=\"dim\">from</span> " + escape(info.origin) + "</span>";
  if (!info.licence.empty()) out += "<span><span class=\"dim\">licence</span> " + escape(info.licence) + "</span>";
  return out + "</p>";
}

std::string plots(const Model& model, const Block& block) {
  const std::string rmse = cost_plot(model, block, {"rmse", "RMSE, worst view", kErrorTargets});
  const std::string flip = cost_plot(model, block, {"flip_p99", "FLIP p99, worst view", kFlipTargets});
  if (rmse.empty() && flip.empty())
    return "<p class=\"note\">No cell of this scene has both a time and an error: there is nothing to plot.</p>";
  return "<div class=\"plots\"><figure>" + rmse +
         "<figcaption class=\"sr\">RMSE against time</figcaption></figure>"
         "<figure>" +
         flip + "<figcaption class=\"sr\">FLIP p99 against time</figcaption></figure></div>" +
         plot_legend(model, block) +
         "<p class=\"hint\">Lower left is better. Bars: 95 % interval of the median time; best to worst view. Faded: "
         "another setting of the same method and backend is at least as fast and as accurate. Dotted lines across: "
         "the targets of the table. On the lower edge: error 0. <span class=\"screen\">Tab to a point, then the arrow "
         "keys go from point to point; "
         "Enter shows its picture.</span></p>";
}

std::string bound_text(const Model& model, const PictureEntry& entry) {
  const ViewResult& view = model.results.results[entry.cell].views[entry.view];
  return view.reference ? scientific(view.reference->bound) : "not stated";
}

// The picture of the most accurate cell of each row, beside the reference.
std::string thumbs(const Model& model, const Block& block, const PictureBook& book) {
  std::string out;
  bool reference_shown = false;
  for (const Row& row : block.rows) {
    const PictureEntry* best = nullptr;
    for (const PictureEntry& entry : book.entries) {
      if (std::find(row.cells.begin(), row.cells.end(), entry.cell) == row.cells.end() || entry.rendered < 0) continue;
      auto rmse = [&](const PictureEntry& e) {
        const Result& result = model.results.results[e.cell];
        return result.error ? result.error->worst.rmse : 1e30;
      };
      if (best == nullptr || rmse(entry) < rmse(*best)) best = &entry;
    }
    if (best == nullptr) continue;
    const auto entry = best - book.entries.data();
    if (!reference_shown && best->reference >= 0) {
      out += fmt::format(
          "<li><button type=\"button\" class=\"thumb\" data-entry=\"{}\" data-picture=\"{}\"><span class=\"frame\">"
          "</span><b>reference</b><span>double precision</span><span class=\"dim\">bound {}</span></button></li>",
          entry, best->reference, bound_text(model, *best));
      reference_shown = true;
    }
    out += fmt::format(
        "<li><button type=\"button\" class=\"thumb\" data-entry=\"{}\" data-picture=\"{}\"><span class=\"frame\">"
        "</span><b>{}</b><span>{}</span><span class=\"dim\">{}</span></button></li>",
        entry, best->rendered, escape(row.method), escape(row.backend), escape(model.settings[best->cell]));
  }
  if (out.empty()) return "<p class=\"note\">No picture of this scene is in the report.</p>";
  return "<ul class=\"thumbs\" aria-label=\"Pictures, the most accurate setting of each; opens the comparison\">" +
         out + "</ul>";
}

std::string range(const std::vector<double>& values, std::string (*text)(double)) {
  if (values.empty()) return "";
  return text(values.front()) + (values.size() > 1 ? " &rarr; " + text(values.back()) : "");
}

}  // namespace

std::string convergence_table(const Model& model, const Block& block) {
  std::string rows;
  for (const Convergence& row : model.results.convergence) {
    if (row.key.experiment != block.experiment || row.key.scene != block.scene) continue;
    rows += fmt::format(
        "<tr><th scope=\"row\">{}</th><td>{}</td><td>{} {} <span class=\"dim\">({})</span></td>"
        "<td class=\"num\">{}</td>",
        escape(row.key.method), escape(row.key.backend), escape(row.parameter), range(row.values, compact),
        row.values.size(), range(row.errors, scientific));
    rows += row.fitted_points > 0
                ? fmt::format(
                      "<td class=\"num\"><b>{:.2f}</b> <span class=\"dim\">[{:.2f}, {:.2f}]</span></td>"
                      "<td class=\"num\">{}</td>",
                      row.fitted, row.fitted_lo, row.fitted_hi, row.fitted_points)
                : "<td class=\"num\">n/a</td><td class=\"num\">0</td>";
    rows += fmt::format("<td class=\"num\">{}</td><td class=\"num\">{}</td><td>{}</td><td>{}</td></tr>",
                        row.expected > 0 ? compact(row.expected) : "n/a",
                        row.floor > 0 ? scientific(row.floor) : "<span class=\"dim\">falling</span>",
                        verdict_badge(row.verdict), escape(row.reason));
  }
  if (rows.empty()) return "";
  return "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Convergence\"><table class=\"wide "
         "convergence\"><caption>Order of convergence: RMSE ~ step<sup>order</sup></caption><thead><tr><th "
         "scope=\"col\">method</th><th scope=\"col\">backend</th><th scope=\"col\">axis (values)</th><th scope=\"col\" "
         "class=\"num\">RMSE, coarse to fine</th><th scope=\"col\" class=\"num\">fitted [interval]</th><th "
         "scope=\"col\" class=\"num\">points</th><th scope=\"col\" class=\"num\">expected</th><th scope=\"col\" "
         "class=\"num\">floor</th><th scope=\"col\">verdict</th><th scope=\"col\">reason</th></tr></thead><tbody>" +
         rows + "</tbody></table></div>";
}

std::string scene_sections(const Model& model, const PictureBook& book) {
  std::string out;
  for (const Block& block : model.blocks) {
    out += "<section class=\"scene\" id=\"" + block.id + "\"><h3>" + escape(model.title(block)) + "</h3>";
    if (block.info != nullptr) {
      if (!block.info->description.empty()) out += "<p>" + escape(block.info->description) + "</p>";
      out += facts(*block.info);
    }
    out += plots(model, block) + thumbs(model, block, book) + convergence_table(model, block) + "</section>";
  }
  return out;
}

}  // namespace volumark::html
