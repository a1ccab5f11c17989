// Time to error of one scene, in full: every method, backend and setting, for each target.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/html/format.h"
#include "reports/html/sections.h"

namespace volumark::html {
namespace {

struct Column {
  std::string metric;
  double target;
};

std::vector<Column> columns() {
  std::vector<Column> out;
  for (const double target : kErrorTargets) out.push_back({"rmse", target});
  for (const double target : kFlipTargets) out.push_back({"flip_p99", target});
  return out;
}

struct Entry {
  TimeToError answer;
  std::string between;  // the two cells that the time was interpolated between
};

// "step 2 and 1": both cells are of one row, so they differ on the quality axis alone.
std::string between_text(const Model& model, size_t coarse, size_t fine) {
  const auto &a = model.results.results[coarse].quality, &b = model.results.results[fine].quality;
  if (!a || !b || a->parameter != b->parameter) return model.settings[coarse] + " and " + model.settings[fine];
  return a->parameter + " " + compact(a->value) + " and " + compact(b->value);
}

Entry entry_of(const Model& model, const Row& row, const Column& column) {
  const std::vector<CostPoint> points = model.points(row, column.metric);
  Entry out{time_to_error(points, column.target), ""};
  if (out.answer.interpolated) out.between = between_text(model, out.answer.coarse, out.answer.fine);
  return out;
}

std::string reached_text(const Entry& entry, bool least) {
  const TimeToError& answer = entry.answer;
  const char* mark = answer.interpolated ? "" : "<span class=\"mark\">&le;&thinsp;</span>";
  const std::string why = answer.interpolated ? "interpolated between " + entry.between
                                              : "the fastest setting measured already reaches this";
  return fmt::format("<td class=\"num{}\" title=\"{}\">{}{}{}</td>", least ? " least" : "", escape(why), mark,
                     milliseconds(*answer.seconds),
                     answer.interpolated ? "<span class=\"between\">" + escape(entry.between) + "</span>" : "");
}

// A target that was missed, with the `columns - 1` finer ones after it.
std::string missed_text(const Entry& entry, int columns) {
  const TimeToError& answer = entry.answer;
  if (!std::isfinite(answer.best_error)) return fmt::format("<td class=\"num none\" colspan=\"{}\">n/a</td>", columns);
  // In a single narrow column "not reached" is for readers that are read to.
  return fmt::format(
      "<td class=\"num missed\" colspan=\"{}\" title=\"not reached: best {} in {} ms\"><span{}>not reached, </span>"
      "<i>best</i> {}</td>",
      columns, scientific(answer.best_error), milliseconds(answer.best_seconds), columns == 1 ? " class=\"sr\"" : "",
      scientific(answer.best_error));
}

std::string outcomes_of(const Model& model, const Row& row) {
  if (std::any_of(row.cells.begin(), row.cells.end(),
                  [&](size_t i) { return shows_nothing(model.results.results[i]); }))
    return "the views show nothing but the background, so there is nothing to rank";
  if (!row.ranked) return "not ranked: " + row.setting + ", so it draws another picture";
  std::string out;
  for (const size_t cell : row.cells) {
    const std::string name = to_string(model.results.results[cell].outcome);
    if (out.find(name) == std::string::npos) out += (out.empty() ? "" : ", ") + name;
  }
  return out;
}

// Image size, views, and what the errors are measured against.
std::string conditions(const Model& model, const Block& block) {
  int64_t width = 0, height = 0;
  size_t views = 0;
  double bound = -1;
  bool estimate = false;
  for (const size_t cell : block.cells) {
    const Result& result = model.results.results[cell];
    width = std::max(width, result.width);
    height = std::max(height, result.height);
    views = std::max(views, result.views.size());
    for (const ViewResult& view : result.views)
      if (view.reference && view.reference->bound > bound) {
        bound = view.reference->bound;
        estimate = view.reference->estimate;
      }
  }
  if (views == 0) return "nothing was drawn";
  std::string out = fmt::format("{} &times; {}, {} view{}", width, height, views, views == 1 ? "" : "s");
  return out + (bound < 0 ? ", no reference"
                          : fmt::format(", reference within {}{}", scientific(bound), estimate ? " (estimate)" : ""));
}

std::string setting_text(const Block& block, const Row& row) {
  if (block.settings.size() < 2 || row.setting.empty()) return "";
  return "<span class=\"setting\"><b>" + block.letter(row) + "</b> " + escape(row.setting) + "</span>" +
         (row.ranked ? "" : " <span class=\"badge\">not ranked</span>");
}

std::string head() {
  std::string out =
      "<thead><tr><th rowspan=\"2\" scope=\"col\">method</th><th rowspan=\"2\" scope=\"col\">backend</th>"
      "<th colspan=\"4\" scope=\"colgroup\" class=\"span\">RMSE</th><th colspan=\"3\" scope=\"colgroup\" "
      "class=\"span\">FLIP p99</th></tr><tr>";
  for (const Column& column : columns())
    out += fmt::format("<th scope=\"col\" class=\"num\">{}</th>",
                       column.metric == "rmse" ? power_of_ten(column.target) : compact(column.target));
  return out + "</tr></thead>";
}

}  // namespace

std::string time_to_error_table(const Model& model, const Block& block) {
  const std::vector<Column> wanted = columns();
  std::vector<std::vector<Entry>> entries;
  for (const Row& row : block.rows) {
    entries.emplace_back();
    for (const Column& column : wanted) entries.back().push_back(entry_of(model, row, column));
  }
  // The least time of a column, among software and among hardware: the two are not ranked against each other.
  auto is_least = [&](size_t row, size_t column) {
    const auto& mine = entries[row][column].answer.seconds;
    const bool software = model.is_software(block.rows[row].backend);
    if (!mine || !block.rows[row].ranked) return false;
    for (size_t other = 0; other < block.rows.size(); ++other) {
      const auto& theirs = entries[other][column].answer.seconds;
      if (theirs && *theirs < *mine && block.rows[other].ranked &&
          model.is_software(block.rows[other].backend) == software)
        return false;
    }
    return true;
  };
  std::string out = fmt::format(
      "<table class=\"tte\" data-experiment=\"{}\" data-scene=\"{}\"><caption>Time to error, ms a frame <span "
      "class=\"dim\">{}</span></caption>",
      escape(block.experiment), escape(block.scene), conditions(model, block));
  out += head() + "<tbody>";
  for (size_t r = 0; r < block.rows.size(); ++r) {
    const Row& row = block.rows[r];
    out += fmt::format("<tr data-method=\"{}\" data-backend=\"{}\" data-setting=\"{}\"{}>", escape(row.method),
                       escape(row.backend), escape(row.setting),
                       r > 0 && block.rows[r - 1].method != row.method ? " class=\"first\"" : "");
    if (r == 0 || block.rows[r - 1].method != row.method) {
      const auto count = std::count_if(block.rows.begin(), block.rows.end(),
                                       [&](const Row& other) { return other.method == row.method; });
      out += fmt::format("<th scope=\"rowgroup\" rowspan=\"{}\">{}</th>", count, escape(row.method));
    }
    out += fmt::format("<th scope=\"row\">{}{}{}</th>", escape(row.backend), software_tag(model, row.backend),
                       setting_text(block, row));
    const bool nothing = std::all_of(entries[r].begin(), entries[r].end(), [](const Entry& entry) {
      return !entry.answer.seconds && !std::isfinite(entry.answer.best_error);
    });
    if (nothing)
      out += fmt::format("<td colspan=\"{}\" class=\"none\">no time with an error: {}</td>", wanted.size(),
                         escape(outcomes_of(model, row)));
    else
      for (size_t c = 0; c < wanted.size();) {
        if (entries[r][c].answer.seconds) {
          out += reached_text(entries[r][c], is_least(r, c));
          ++c;
          continue;
        }
        size_t end = c + 1;
        while (end < wanted.size() && wanted[end].metric == wanted[c].metric && !entries[r][end].answer.seconds) ++end;
        out += missed_text(entries[r][c], static_cast<int>(end - c));
        c = end;
      }
    out += "</tr>";
  }
  return out + "</tbody></table>";
}

}  // namespace volumark::html
