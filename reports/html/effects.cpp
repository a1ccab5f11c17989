// What each effect costs: time and instructions with and without it as bars, the table, and the pictures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "reports/html/bars.h"
#include "reports/html/effect_rows.h"
#include "reports/html/format.h"
#include "reports/html/sections.h"

namespace volumark::html {
namespace {

std::vector<std::string> scenes_of(const Results& results) {
  std::vector<std::string> out;
  for (const EffectRow& row : results.effects)
    if (std::find(out.begin(), out.end(), row.key.scene) == out.end()) out.push_back(row.key.scene);
  return out;
}

std::string interval(const Stats& stats) {
  return stats.count > 0 ? milliseconds(stats.median) + " ms <span class=\"dim\">[" + milliseconds(stats.median_lo) +
                               ", " + milliseconds(stats.median_hi) + "]</span>"
                         : "not timed";
}

// Times and instructions of one scene; all its bars have one scale.
std::string bars_of(const Results& results, const std::vector<const EffectRow*>& rows) {
  double slowest = 0, longest = 0;
  for (const EffectRow* row : rows) {
    slowest = std::max({slowest, row->with.median, row->without.median});
    longest = std::max(
        {longest, static_cast<double>(row->instructions_with), static_cast<double>(row->instructions_without)});
  }
  auto time = [&](const Stats& stats) { return slowest > 0 ? stats.median / slowest : 0; };
  auto text = [&](int64_t count) { return longest > 0 ? static_cast<double>(count) / longest : 0; };
  std::string out;
  for (const EffectRow* row : rows) {
    out += "<li><p><b>" + escape(row->effect) + "</b> " + escape(row->key.method) + " on " + escape(row->key.backend) +
           " <span class=\"dim change\">" + change_text(results, *row) + "</span></p>" +
           bar(time(row->with), 0, interval(row->with)) + bar(time(row->without), 1, interval(row->without));
    // The same on every backend: once is enough.
    const bool counted = std::any_of(rows.begin(), rows.end(), [&](const EffectRow* other) {
      return std::less<>()(other, row) && other->key.method == row->key.method && other->effect == row->effect &&
             other->instructions_with == row->instructions_with &&
             other->instructions_without == row->instructions_without;
    });
    if (!counted && (row->instructions_with > 0 || row->instructions_without > 0))
      out += bar(text(row->instructions_with), 0, fmt::format("{} instructions", row->instructions_with)) +
             bar(text(row->instructions_without), 1, fmt::format("{} instructions", row->instructions_without));
    out += "</li>";
  }
  return "<ul class=\"legend\"><li>" + swatch(0) + "with</li><li>" + swatch(1) +
         "without</li></ul><ul class=\"bars "
         "effect-bars\">" +
         out + "</ul>";
}

// A picture of each variant of the scene, of the first method and backend that has several.
std::string variant_pictures(const Model& model, const PictureBook& book, const std::string& scene) {
  std::string out;
  for (const std::string& method : model.methods) {
    std::vector<const PictureEntry*> found;
    std::string backend;
    for (const PictureEntry& entry : book.entries) {
      const CellKey& key = model.results.results[entry.cell].key;
      if (key.scene != scene || key.method != method || entry.rendered < 0) continue;
      const bool wanted =
          std::any_of(model.results.effects.begin(), model.results.effects.end(),
                      [&](const EffectRow& r) { return r.key.experiment == key.experiment && r.key.scene == scene; });
      if (!wanted || (!backend.empty() && key.backend != backend)) continue;
      const bool known = std::any_of(found.begin(), found.end(), [&](const PictureEntry* other) {
        return model.results.results[other->cell].key.variant == key.variant;
      });
      if (known) continue;
      backend = key.backend;
      found.push_back(&entry);
    }
    if (found.size() < 2) continue;
    const PictureEntry* base = *std::min_element(found.begin(), found.end(), [&](auto* a, auto* b) {
      return model.results.results[a->cell].key.variant < model.results.results[b->cell].key.variant;
    });
    for (const PictureEntry* entry : found) {
      const CellKey& key = model.results.results[entry->cell].key;
      out += fmt::format(
          "<li><button type=\"button\" class=\"thumb\" data-entry=\"{}\" data-against=\"{}\" data-picture=\"{}\"><span "
          "class=\"frame\"></span><b>{}</b><span>{}</span><span class=\"dim\">{}</span></button></li>",
          entry - book.entries.data(), entry == base ? -1 : base - book.entries.data(), entry->rendered,
          key.variant.empty()     ? "as the scene is"
          : key.variant == "none" ? "no effect"
                                  : escape(key.variant),
          escape(key.method), escape(key.backend) + picture_badges(model.results.results[entry->cell]));
    }
  }
  return out.empty()
             ? ""
             : "<ul class=\"thumbs\" aria-label=\"Pictures with and without; opens the comparison\">" + out + "</ul>";
}

std::string table_rows(const Model& model) {
  std::string out;
  for (const EffectRow& row : model.results.effects) {
    auto figure = [](const std::string& text, double value) {
      return fmt::format("<td class=\"num\" data-value=\"{:.17g}\">{}</td>", value, text);
    };
    out += "<tr><th scope=\"row\">" + escape(row.key.scene) + "</th><td>" + escape(row.key.method) + "</td><td>" +
           escape(row.key.backend) + "</td><td>" + escape(row.effect) + "</td><td>" +
           (row.mode == "single"          ? "alone"
            : row.mode == "leave_one_out" ? "all but it"
                                          : escape(row.mode)) +
           "</td>" + figure(interval(row.with), row.with.median) + figure(interval(row.without), row.without.median) +
           "<td>" + change_text(model.results, row) + "</td>" + figure(scientific(row.rmse), row.rmse) +
           figure(number(row.flip_p99), row.flip_p99) + "<td class=\"num\">" + instructions_text(row) + "</td></tr>";
  }
  return out;
}

}  // namespace

std::string effects_section(const Model& model, const PictureBook& book) {
  if (model.results.effects.empty()) return missing_text("No effect was switched on and off", "effects");
  std::string out =
      "<p class=\"hint\">The scene as it is against the scene without the effect. The program that runs is compiled "
      "without what a scene does not call for; instructions are those of the optimised SPIR-V of all stages, the same "
      "on "
      "every backend (cpu runs twins of it, in C++). Within noise: the 95 % intervals of the two medians "
      "touch.</p><div class=\"cards\">";
  const std::vector<const EffectRow*> once = one_row_an_effect(model.results);
  for (const std::string& scene : scenes_of(model.results)) {
    std::vector<const EffectRow*> rows;
    std::copy_if(once.begin(), once.end(), std::back_inserter(rows),
                 [&](const EffectRow* row) { return row->key.scene == scene; });
    out += "<div class=\"card effect\"><h3>" + escape(scene) + "</h3>" + bars_of(model.results, rows) +
           variant_pictures(model, book, scene) +
           command_box("volumark run " + rows.front()->key.experiment + " --scene " + scene) + "</div>";
  }
  return out + "</div>" +
         folded("Table: each effect alone and left out", table_text("Effects",
                                                                    {{"scene", false},
                                                                     {"method", false},
                                                                     {"backend", false},
                                                                     {"effect", false},
                                                                     {"switched", false},
                                                                     {"with", true},
                                                                     {"without", true},
                                                                     {"time", false},
                                                                     {"RMSE between", true},
                                                                     {"FLIP p99", true},
                                                                     {"instructions", true}},
                                                                    table_rows(model), "wide sortable"));
}

}  // namespace volumark::html
