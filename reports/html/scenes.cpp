// A section for each scene: what it is, error against time, small pictures, where the error comes from and lies, how
// the methods converge and compare.
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
  std::string shows = info.display;
  std::replace(shows.begin(), shows.end(), '_', ' ');
  if (shows != "direct") out += "<span><span class=\"dim\">shows</span> " + escape(shows) + "</span>";
  std::string effects;
  for (const std::string& effect : info.effects) effects += (effects.empty() ? "" : ", ") + effect;
  out += "<span><span class=\"dim\">effects</span> " + (effects.empty() ? "none" : escape(effects)) + "</span>";
  if (!info.origin.empty()) out += "<span><span class=\"dim\">from</span> " + escape(info.origin) + "</span>";
  if (!info.licence.empty()) out += "<span><span class=\"dim\">licence</span> " + escape(info.licence) + "</span>";
  return out + "</p>";
}

// Views whose reference is nothing but background: their errors praise nothing, and they are not ranked.
std::string empty_views(const Model& model, const Block& block) {
  std::vector<std::string> names;
  for (const size_t cell : block.cells)
    for (const ViewResult& view : model.results.results[cell].views) {
      const std::string name = view.name.empty() ? fmt::format("view {}", view.index) : view.name;
      if (view.shows_nothing && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  if (names.empty()) return "";
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + escape(name);
  return "<p class=\"warning\" role=\"note\">&#9888; Shows nothing but the background: " + list +
         ". Its errors say nothing, and it is left out of all rankings.</p>";
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
    const auto entry = static_cast<size_t>(best - book.entries.data());
    if (!reference_shown && best->reference >= 0) {
      out += thumb(entry, best->reference, "reference", "double precision", "bound " + bound_text(model, *best));
      reference_shown = true;
    }
    out += thumb(entry, best->rendered, escape(row.method), escape(row.backend),
                 escape(model.settings[best->cell]) + picture_badges(model.results.results[best->cell]));
  }
  if (out.empty()) return "<p class=\"note\">No picture of this scene is in the report.</p>";
  return "<ul class=\"thumbs\" aria-label=\"Pictures, the most accurate setting of each; opens the comparison\">" +
         out + "</ul>";
}

std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && word.find_first_not_of(
                                          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                          "0123456789_-+=.,:/") == std::string::npos;
  if (plain) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string scene_links(const std::vector<const Block*>& blocks) {
  if (blocks.size() < 2) return "";
  std::string out = "<ul class=\"jump\" aria-label=\"Scenes\">";
  for (const Block* block : blocks) out += "<li><a href=\"#" + block->id + "\">" + escape(block->scene) + "</a></li>";
  return out + "</ul>";
}

// Which fronts the plots draw as lines: one choice for all scenes, without a script.
constexpr const char* kFrontChoice =
    "<input type=\"radio\" name=\"fronts\" id=\"fronts-each\" checked><label for=\"fronts-each\">each method and "
    "backend</label><input type=\"radio\" name=\"fronts\" id=\"fronts-method\"><label for=\"fronts-method\">each "
    "method</label><input type=\"radio\" name=\"fronts\" id=\"fronts-backend\"><label for=\"fronts-backend\">each "
    "backend</label>";

}  // namespace

std::string thumb(size_t entry, int picture, const std::string& title, const std::string& line,
                  const std::string& dim) {
  return fmt::format(
      "<li><button type=\"button\" class=\"thumb\" data-entry=\"{}\" data-picture=\"{}\"><span class=\"frame\">"
      "</span><b>{}</b><span>{}</span><span class=\"dim\">{}</span></button></li>",
      entry, picture, title, line, dim);
}

std::string picture_badges(const Result& result) {
  std::string out;
  for (const std::string& effect : result.ignored_effects)
    out += "<span class=\"badge bad\">" + escape(effect) + " ignored</span>";
  if (shows_nothing(result)) out += "<span class=\"badge neutral\">shows nothing</span>";
  return out;
}

std::string block_command(const Model& model, const Block& block) {
  std::string out = "volumark run " + quoted(block.experiment) + " --scene " + quoted(block.scene);
  for (const std::string& sweep : model.results.run.sweeps) out += " --sweep " + quoted(sweep);
  const bool ignored = std::any_of(block.cells.begin(), block.cells.end(),
                                   [&](size_t cell) { return !model.results.results[cell].ignored_effects.empty(); });
  if (ignored) out += " --ignore-effects";
  return out;
}

std::string scene_sections(const Model& model, const PictureBook& book) {
  const std::vector<const Block*> blocks = model.accuracy_blocks();
  if (blocks.empty()) return "<p class=\"note\">The results file holds no cells.</p>";
  std::string out = scene_links(blocks) +
                    "<div class=\"front-choice\"><span class=\"picks\" role=\"radiogroup\" aria-label=\"Fronts\">"
                    "<span class=\"dim\">Lines: front of</span> " +
                    kFrontChoice + "</span></div>";
  for (const Block* block : blocks) {
    out += "<section class=\"scene\" id=\"" + block->id + "\"><h3>" + escape(model.title(*block)) + "</h3>";
    if (block->info != nullptr) {
      if (!block->info->description.empty()) out += "<p>" + escape(block->info->description) + "</p>";
      out += facts(*block->info);
    }
    out += empty_views(model, *block) + plots(model, *block);
    out += "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Time to error, " +
           escape(model.title(*block)) + "\">" + time_to_error_table(model, *block) + "</div>";
    out += fronts_table(model, *block) + thumbs(model, *block, book) + attribution_part(model, *block);
    out += convergence_part(model, *block) + pairs_part(model, *block) + regions_part(model, *block);
    out += "<p class=\"hint\">Run this scene again:</p>" + command_box(block_command(model, *block)) + "</section>";
  }
  return out;
}

}  // namespace volumark::html
