// The first screen: what accuracy costs, what stays stable, what effects cost. Each answer is short and leads to its
// details; what the file lacks is said with the command that gets it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "reports/html/effect_rows.h"
#include "reports/html/format.h"
#include "reports/html/hard_case_summary.h"
#include "reports/html/sections.h"

namespace volumark::html {
namespace {

// ---- Accuracy -------------------------------------------------------------------------------------------------------

// The least time of a method in a scene over all its backends and settings that may be ranked against each other.
struct Least {
  std::optional<double> seconds;
  bool interpolated = false;
  const Row* row = nullptr;
  double best_error = std::numeric_limits<double>::infinity();
};

Least least_time(const Model& model, const Block& block, const std::string& method, bool software,
                 const std::string& metric, double target) {
  Least out;
  for (const Row& row : block.rows) {
    if (row.method != method || !row.ranked || model.is_software(row.backend) != software) continue;
    const TimeToError answer = time_to_error(model.points(row, metric), target);
    if (answer.best_error < out.best_error) out.best_error = answer.best_error;
    if (answer.seconds && (!out.seconds || *answer.seconds < *out.seconds)) {
      out.seconds = answer.seconds;
      out.interpolated = answer.interpolated;
      out.row = &row;
    }
  }
  return out;
}

// Why a method has no time with an error in this scene.
std::string outcome_words(const Model& model, const Block& block, const std::string& method) {
  std::string out;
  for (const size_t i : block.cells) {
    const Result& cell = model.results.results[i];
    if (cell.key.method != method || !cell.key.variant.empty()) continue;
    const std::string word = shows_nothing(cell) ? "shows nothing" : to_string(cell.outcome);
    if (out.find(word) == std::string::npos) out += (out.empty() ? "" : ", ") + word;
  }
  return "<a href=\"#problems\">" + (out.empty() || out == "ok" ? std::string("no figure") : escape(out)) + "</a>";
}

std::string least_cells(const Model& model, const Block& block, const std::string& method, bool software,
                        const std::string& metric, std::span<const double> targets, const char* group) {
  std::string out;
  for (size_t i = 0; i < targets.size(); ++i) {
    const Least least = least_time(model, block, method, software, metric, targets[i]);
    if (least.seconds) {
      // Bold: no other method of the same kind of backend is faster.
      const bool first = std::none_of(model.methods.begin(), model.methods.end(), [&](const std::string& other) {
        const Least theirs = least_time(model, block, other, software, metric, targets[i]);
        return theirs.seconds && *theirs.seconds < *least.seconds;
      });
      out += fmt::format("<td class=\"num {}{}\">{}{} <small>{}{}</small></td>", group, first ? " least" : "",
                         least.interpolated ? "" : "<span class=\"mark\">&le;&thinsp;</span>",
                         milliseconds(*least.seconds), escape(least.row->backend),
                         block.letter(*least.row).empty() ? "" : " " + block.letter(*least.row));
      continue;
    }
    size_t end = i + 1;  // the finer targets are missed as well
    while (end < targets.size() && !least_time(model, block, method, software, metric, targets[end]).seconds) ++end;
    out += std::isfinite(least.best_error)
               ? fmt::format("<td class=\"num missed {}\" colspan=\"{}\">{}<i>best</i> {}</td>", group, end - i,
                             end - i > 1 ? "not reached, " : "<span class=\"sr\">not reached, </span>",
                             scientific(least.best_error))
               : fmt::format("<td class=\"num none {}\" colspan=\"{}\">{}</td>", group, end - i,
                             outcome_words(model, block, method));
    i = end - 1;
  }
  return out;
}

std::string accuracy_rows(const Model& model, const Block& block) {
  std::string out;
  size_t count = 0;
  for (const std::string& method : model.methods)
    for (const bool software : {true, false}) {
      const bool there = std::any_of(block.rows.begin(), block.rows.end(), [&](const Row& row) {
        return row.method == method && row.ranked && model.is_software(row.backend) == software;
      });
      if (!there) continue;
      out += fmt::format("<tr{}><th scope=\"row\">{}</th><th scope=\"row\">{}{}</th>{}{}</tr>",
                         count == 0 ? " class=\"first\"" : "",
                         count == 0 ? fmt::format("<a href=\"#{}\">{}</a>", block.id, escape(block.scene))
                                    : "<span class=\"sr\">" + escape(block.scene) + "</span>",
                         escape(method), software ? "" : " <span class=\"tag hard\">hardware</span>",
                         least_cells(model, block, method, software, "rmse", kErrorTargets, "of-rmse"),
                         least_cells(model, block, method, software, "flip_p99", kFlipTargets, "of-flip"));
      ++count;
    }
  return out;
}

std::string accuracy_head() {
  std::string out = "<thead><tr><th scope=\"col\">scene</th><th scope=\"col\">method</th>";
  for (const double target : kErrorTargets)
    out += "<th scope=\"col\" class=\"num of-rmse\"><span class=\"dim\">RMSE</span> " + power_of_ten(target) + "</th>";
  for (const double target : kFlipTargets)
    out += "<th scope=\"col\" class=\"num of-flip\"><span class=\"dim\">FLIP</span> " + compact(target) + "</th>";
  return out + "</tr></thead>";
}

std::string accuracy_answer(const Model& model) {
  std::string rows;
  bool swept = false, lettered = false;
  for (const Block* block : model.accuracy_blocks()) {
    rows += accuracy_rows(model, *block);
    swept = swept || block->swept;
    lettered = lettered || block->settings.size() > 1;
  }
  std::string out =
      "<div class=\"answer\" id=\"answer-accuracy\"><h2>What does accuracy cost? <a href=\"#scenes\">Details</a></h2>";
  if (rows.empty() || !swept) out += missing_text("No method was swept over its quality axis", "accuracy");
  if (rows.empty()) return out + "</div>";
  return out +
         "<p class=\"hint\">Least milliseconds a frame to reach an error (worst view), over the backends: the one "
         "named. "
         "&le; the coarsest setting reaches it. <b>Bold</b>: the fastest method." +
         std::string(lettered ? " Letters: "
                                "settings, see the details."
                              : "") +
         "</p>"
         "<span class=\"picks\" role=\"radiogroup\" aria-label=\"Metric\">"
         "<input type=\"radio\" name=\"metric\" id=\"metric-rmse\" checked><label for=\"metric-rmse\">RMSE</label>"
         "<input type=\"radio\" name=\"metric\" id=\"metric-flip\"><label for=\"metric-flip\">FLIP p99</label></span>"
         "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Time to error, all scenes\"><table "
         "class=\"first-table\" id=\"least-times\">" +
         accuracy_head() + "<tbody>" + rows + "</tbody></table></div></div>";
}

// ---- Stability ------------------------------------------------------------------------------------------------------

std::string plural(size_t count, const char* word) {
  return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

std::string case_line(const Results& results) {
  const HardCaseSummary sum = summarise(results.hard_cases);
  const size_t bad = sum.failed + sum.errors, checks = sum.passed + bad;
  std::string out = fmt::format("<p class=\"line {}\"><b class=\"state\">{}</b> {}", bad > 0 ? "bad" : "good",
                                bad > 0 ? "&#10007; FAILS" : "&#10003; holds", plural(sum.cases, "case"));
  if (sum.worst != nullptr)
    out +=
        fmt::format(", worst deviation <b>{}</b>, in <b>{}</b>", share_text(*sum.worst), escape(place_of(*sum.worst)));
  out += fmt::format(". {} of {} hold", sum.passed, plural(checks, "check"));
  if (sum.failed > 0) out += fmt::format(", {} fail", sum.failed);
  if (sum.errors > 0) out += fmt::format(", {} ended with an error", sum.errors);
  if (sum.not_applicable > 0) out += fmt::format(", {} not applicable", sum.not_applicable);
  out += ".</p>";
  std::string list;
  size_t named = 0;
  std::vector<HardCaseGroup> groups = group_cases(results.hard_cases);
  std::stable_sort(groups.begin(), groups.end(), [](const HardCaseGroup& a, const HardCaseGroup& b) {
    return severity(*a.rows.front()) > severity(*b.rows.front());
  });
  for (const HardCaseGroup& group : groups) {
    const HardCaseRow& row = *group.rows.front();
    if (row.outcome != "fail" && row.outcome != "error") continue;
    if (++named > 3) continue;
    list += "<li>&#10007; " + escape(place_of(row)) + ": " + escape(row.check.empty() ? row.title : row.check) + ", " +
            (row.outcome == "error" ? "error: " + escape(row.reason) : share_text(row)) + "</li>";
  }
  if (named > 3) list += fmt::format("<li>and {} more cases</li>", named - 3);
  return out + (list.empty() ? "" : "<ul class=\"failures\">" + list + "</ul>");
}

std::string motion_line(const Results& results) {
  if (results.sensitivity.empty()) return "";
  size_t bad = 0;
  int64_t spikes = 0;
  const SensitivityRow* worst = nullptr;
  double worst_share = -1;
  for (const SensitivityRow& row : results.sensitivity) {
    bad += row.ok ? 0 : 1;
    spikes += row.spike_count;
    const HardCaseRow* check = motion_check(results.hard_cases, row);
    const double share = check != nullptr ? share_of_bound(*check) : row.limit > 0 ? row.max / row.limit : 0;
    if (share > worst_share) {
      worst_share = share;
      worst = &row;
    }
  }
  std::string out = fmt::format("<p class=\"line {}\"><b class=\"state\">{}</b> Small motions of the camera, {}: {}",
                                bad > 0 ? "bad" : "good", bad > 0 ? "&#10007; SPIKES" : "&#10003; holds",
                                plural(results.sensitivity.size(), "picture"),
                                spikes == 0 ? std::string("no spike") : plural(static_cast<size_t>(spikes), "spike"));
  if (worst != nullptr)
    out += fmt::format("; worst pixel at <b>{} of its limit</b>, in <b>{} ({}, {})</b>", number(worst_share),
                       escape(worst->key.scene), escape(worst->key.method), escape(worst->key.backend));
  return out + ".</p>";
}

std::string stability_answer(const Model& model) {
  std::string out =
      "<div class=\"answer\" id=\"answer-stability\"><h2>What stays stable? <a href=\"#stability\">Details</a></h2>";
  out +=
      model.results.hard_cases.empty() ? missing_text("No hard case was checked", "verify") : case_line(model.results);
  return out + motion_line(model.results) + "</div>";
}

// ---- Effects --------------------------------------------------------------------------------------------------------

std::string effects_answer(const Model& model) {
  std::string out =
      "<div class=\"answer\" id=\"answer-effects\"><h2>What do effects cost? <a href=\"#effects\">Details</a></h2>";
  if (model.results.effects.empty())
    return out + missing_text("No effect was switched on and off", "effects") + "</div>";
  const std::vector<std::string> backends = effect_backends(model.results);
  std::string picks, rows;
  for (size_t i = 0; i < backends.size(); ++i)
    picks += fmt::format(
        "<input type=\"radio\" name=\"effect-backend\" id=\"effect-backend-{}\"{}><label "
        "for=\"effect-backend-{}\">{}</label>",
        i, i == 0 ? " checked" : "", i, escape(backends[i]));
  for (const EffectRow* row : one_row_an_effect(model.results)) {
    const auto backend = std::find(backends.begin(), backends.end(), row->key.backend) - backends.begin();
    rows += fmt::format(
        "<tr class=\"on-{}\"><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td class=\"num\">{}</td><td "
        "class=\"num\">{}"
        "</td><td class=\"num\">{}</td><td class=\"num\">{}</td></tr>",
        backend, escape(row->key.scene), escape(row->key.method), escape(row->effect), stats_text(row->with),
        stats_text(row->without), change_text(model.results, *row), instructions_text(*row));
  }
  return out +
         "<p class=\"hint\">Milliseconds a frame, and instructions of the compiled programs, with the effect and "
         "without it; all else as the scene has it.</p><span class=\"picks\" role=\"radiogroup\" "
         "aria-label=\"Backend\">" +
         picks +
         "</span><div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Cost of effects\"><table "
         "class=\"first-table\" id=\"effect-costs\"><thead><tr><th scope=\"col\">scene</th><th "
         "scope=\"col\">method</th>"
         "<th scope=\"col\">effect</th><th scope=\"col\" class=\"num\">with</th><th scope=\"col\" class=\"num\">without"
         "</th><th scope=\"col\" class=\"num\">time</th><th scope=\"col\" class=\"num\">instructions</th></tr></thead>"
         "<tbody>" +
         rows + "</tbody></table></div></div>";
}

}  // namespace

std::string missing_text(const std::string& what, const std::string& command) {
  const std::string run =
      (command == "verify" ? "volumark verify" : "volumark run " + command) + " --out out/" + command;
  return "<p class=\"note missing\">" + escape(what) + " in these results. To have it:</p>" + command_box(run) +
         "<p class=\"note\">and name that folder too: <code>volumark report THIS_FOLDER out/" + command + "</code></p>";
}

std::string answers(const Model& model) {
  return "<div class=\"answers\">" + accuracy_answer(model) + "<div class=\"beside\">" + stability_answer(model) +
         effects_answer(model) + "</div></div>";
}

}  // namespace volumark::html
