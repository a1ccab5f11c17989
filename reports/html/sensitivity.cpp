// How the picture changes with a small motion of the camera: a row for each cell, and the spikes where they are.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/html/bars.h"
#include "reports/html/format.h"
#include "reports/html/hard_case_summary.h"
#include "reports/html/sections.h"

namespace volumark::html {
namespace {

constexpr size_t kListed = 8;  // spikes in words; the picture marks all that the file has

std::string spike_list(const SensitivityRow& row) {
  if (row.spike_count == 0) return "none";
  std::string out;
  for (size_t i = 0; i < std::min(row.spikes.size(), kListed); ++i) {
    const Spike& spike = row.spikes[i];
    out +=
        fmt::format("{}{} at {}, {} (view {})", i == 0 ? "" : "; ", number(spike.change), spike.x, spike.y, spike.view);
  }
  const int64_t more = row.spike_count - static_cast<int64_t>(std::min(row.spikes.size(), kListed));
  return out + (more > 0 ? fmt::format("; and {} more", more) : "");
}

// The picture in which the row's worst spike lies: that of the hard case that found it, or of the row's own cell, which
// then has the same size. -1: the report has none.
int picture_of(const Model& model, const PictureBook& book, const SensitivityRow& row) {
  const Spike& worst = row.spikes.front();
  for (const auto& [index, pictures] : book.hard_cases) {
    const HardCaseRow& found = model.results.hard_cases[index];
    if (found.method == row.key.method && found.backend == row.key.backend && found.x == worst.x &&
        found.y == worst.y && found.check.find(row.key.scene) != std::string::npos && pictures.first >= 0)
      return pictures.first;
  }
  for (const PictureEntry& entry : book.entries) {
    const Result& result = model.results.results[entry.cell];
    if (entry.rendered >= 0 && result.key.scene == row.key.scene && result.key.method == row.key.method &&
        result.key.backend == row.key.backend && result.key.variant == row.key.variant &&
        result.key.params == row.key.params && result.views[entry.view].index == worst.view)
      return entry.rendered;
  }
  return -1;
}

std::string marked_picture(const Model& model, const PictureBook& book, const SensitivityRow& row) {
  if (row.spikes.empty()) return "";
  const int picture = picture_of(model, book, row);
  if (picture < 0) return "";
  std::string marks;
  for (const Spike& spike : row.spikes)
    if (spike.view == row.spikes.front().view)
      marks += fmt::format("{}{},{}", marks.empty() ? "" : " ", spike.x, spike.y);
  return fmt::format(
      "<figure class=\"spots\" data-picture=\"{}\" data-difference=\"-1\" data-x=\"{}\" data-y=\"{}\" "
      "data-marks=\"{}\">"
      "<figcaption>{} ({}, {}), view {}: spikes</figcaption></figure>",
      picture, row.spikes.front().x, row.spikes.front().y, marks, escape(row.key.scene), escape(row.key.method),
      escape(row.key.backend), row.spikes.front().view);
}

}  // namespace

std::string sensitivity_part(const Model& model, const PictureBook& book) {
  if (model.results.sensitivity.empty()) return missing_text("No motion of the camera was tried", "verify");
  std::vector<const SensitivityRow*> order;
  for (const SensitivityRow& row : model.results.sensitivity) order.push_back(&row);
  std::stable_sort(order.begin(), order.end(),
                   [](const SensitivityRow* a, const SensitivityRow* b) { return !a->ok && b->ok; });
  double largest = 0;
  for (const SensitivityRow* row : order)
    if (std::isfinite(row->max)) largest = std::max(largest, row->max);
  std::string rows, pictures;
  for (const SensitivityRow* row : order) {
    const HardCaseRow* check = motion_check(model.results.hard_cases, *row);
    auto figure = [](double value) {
      return fmt::format("<td class=\"num\" data-value=\"{:.17g}\">{}</td>", value, number(value));
    };
    rows += "<tr><td>" + verdict_badge(row->ok ? "ok" : "fail") + "</td><th scope=\"row\">" + escape(row->key.scene) +
            "</th><td>" + escape(row->key.method) + "</td><td>" + escape(row->key.backend) + "</td>" +
            figure(row->median) + figure(row->p99) + fmt::format("<td data-value=\"{:.17g}\">", row->max) +
            bar(largest > 0 ? row->max / largest : 0, row->ok ? 0 : 1, number(row->max)) + "</td>" +
            figure(row->limit) +
            (check != nullptr ? "<td class=\"share\">" + bound_bar(share_of_bound(*check)) + " " +
                                    number(share_of_bound(*check)) + "</td>"
                              : std::string("<td class=\"none\">-</td>")) +
            fmt::format("<td class=\"num\" data-value=\"{}\">{}</td>", row->spike_count, row->spike_count) + "<td>" +
            spike_list(*row) + (row->reason.empty() ? "" : " <b>" + escape(row->reason) + "</b>") + "</td></tr>";
    pictures += marked_picture(model, book, *row);
  }
  const SensitivityRow& first = model.results.sensitivity.front();
  return fmt::format(
             "<h3 id=\"sensitivity\">Small motions of the camera</h3><p class=\"hint\">The camera moves by {} of the "
             "scene's size in {} directions. Change of the picture (largest channel) per motion, over the pixels that "
             "change. A spike is a pixel that changes more "
             "than its own limit, which follows from a larger motion and from what changes around it: a crack, a pop "
             "or a "
             "branch that flips. The limit shown is that of the pixel that comes nearest to its own.</p>",
             scientific(first.motion), first.directions) +
         table_text("Sensitivity",
                    {{"verdict", false},
                     {"scene", false},
                     {"method", false},
                     {"backend", false},
                     {"median", true},
                     {"p99", true},
                     {"largest", false},
                     {"limit where nearest", true},
                     {"nearest to its limit", false},
                     {"spikes", true},
                     {"the worst, and where", false}},
                    rows, "wide sortable sensitivity") +
         (pictures.empty() ? "" : "<div class=\"spot-row\">" + pictures + "</div>");
}

}  // namespace volumark::html
