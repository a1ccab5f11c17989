// The tables below the scenes: problems, every cell, parity, self-test.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/html/format.h"
#include "reports/html/sections.h"

namespace volumark::html {
namespace {

std::string head(const std::vector<std::pair<std::string, bool>>& columns, bool sortable) {
  std::string out = "<thead><tr>";
  for (const auto& [name, numeric] : columns) {
    const char* number = numeric ? " class=\"num\"" : "";
    out += sortable ? fmt::format(
                          "<th scope=\"col\"{} aria-sort=\"none\"><button type=\"button\" class=\"sort\">{}"
                          "</button></th>",
                          number, name)
                    : fmt::format("<th scope=\"col\"{}>{}</th>", number, name);
  }
  return out + "</tr></thead>";
}

// A number that sorts by its exact value.
std::string figure(const std::string& text, double value) {
  return fmt::format("<td class=\"num\" data-value=\"{:.17g}\">{}</td>", value, text);
}
constexpr const char* kNothing = "<td class=\"num none\">-</td>";

std::string time_figures(const Result& result) {
  if (!result.metrics || result.metrics->frame_wall.stats.count == 0) {
    std::string out;
    for (int i = 0; i < 5; ++i) out += kNothing;
    return out;
  }
  const Metrics& metrics = *result.metrics;
  const Stats& wall = metrics.frame_wall.stats;
  std::string out = figure(milliseconds(wall.median), wall.median);
  const double spread = (wall.median_hi - wall.median_lo) / (2 * wall.median);
  out += figure(fmt::format("{:.1f} %", 100 * spread), spread);
  out += figure(milliseconds(metrics.frame_cpu.stats.median), metrics.frame_cpu.stats.median);
  out +=
      metrics.frame_wall.first ? figure(milliseconds(*metrics.frame_wall.first), *metrics.frame_wall.first) : kNothing;
  return out + figure(milliseconds(metrics.prepare.wall), metrics.prepare.wall);
}

std::string error_figures(const Result& result) {
  if (!result.error) {
    std::string out;
    for (int i = 0; i < 5; ++i) out += kNothing;
    return out;
  }
  const ErrorMetrics& worst = result.error->worst;
  const double bias = error_value(worst, "bias");
  return figure(scientific(worst.rmse), worst.rmse) + figure(scientific(worst.max), worst.max) +
         figure(scientific(bias), bias) + figure(number(worst.flip_p99), worst.flip_p99) +
         figure(std::isfinite(worst.ssim) ? fmt::format("{:.4f}", worst.ssim) : number(worst.ssim), worst.ssim);
}

}  // namespace

std::string software_tag(const Model& model, const std::string& backend) {
  return model.is_software(backend) ? " <span class=\"tag\">software</span>" : "";
}

std::string command_box(const std::string& command) {
  if (command.empty()) return "";
  // Each word in an element of its own: lines end between words, not at the hyphens of an option.
  std::string words;
  for (size_t at = 0; at < command.size();) {
    const size_t end = std::min(command.find(' ', at), command.size());
    words += (words.empty() ? "<span>" : " <span>") + escape(command.substr(at, end - at)) + "</span>";
    at = end + 1;
  }
  return "<span class=\"command\"><code>" + words + "</code><button type=\"button\" class=\"copy\" data-copy=\"" +
         escape(command) + "\">copy</button></span>";
}

std::string verdict_badge(const std::string& verdict) {
  const bool good = verdict == "pass" || verdict == "ok" || verdict == "reproduced";
  const bool bad = verdict == "fail" || verdict == "failed" || verdict == "not reproduced" ||
                   verdict == "wrong_image" || verdict == "timeout" || verdict == "differs";
  return fmt::format("<span class=\"badge {}\">{}</span>", good ? "good" : bad ? "bad" : "neutral", escape(verdict));
}

std::string table_text(const std::string& name, const std::vector<std::pair<std::string, bool>>& columns,
                       const std::string& rows, const std::string& classes) {
  const bool sortable = classes.find("sortable") != std::string::npos;
  return "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"" + escape(name) + "\"><table class=\"" +
         classes + "\">" + head(columns, sortable) + "<tbody>" + rows + "</tbody></table></div>";
}

std::string folded(const std::string& title, const std::string& inside, bool open) {
  return "<details class=\"fold\"" + std::string(open ? " open" : "") + "><summary>" + title + "</summary>" + inside +
         "</details>";
}

std::string problems_section(const Model& model) {
  std::string rows;
  for (size_t i = 0; i < model.results.results.size(); ++i) {
    const Result& result = model.results.results[i];
    if (result.outcome == Outcome::Ok) continue;
    rows += fmt::format(
        "<tr><td>{}</td><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}"
        "</td></tr>",
        verdict_badge(to_string(result.outcome)), escape(result.key.scene), escape(result.key.method),
        escape(result.key.backend), escape(model.settings[i]), escape(result.reason), command_box(result.command));
  }
  if (rows.empty()) return "<p class=\"note\">None: every cell ended as <b>ok</b>.</p>";
  return "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Outcomes that are not ok\"><table "
         "class=\"wide problems\">" +
         head({{"outcome", false},
               {"scene", false},
               {"method", false},
               {"backend", false},
               {"settings", false},
               {"reason", false},
               {"run it again", false}},
              false) +
         "<tbody>" + rows + "</tbody></table></div>";
}

std::string cells_table(const Model& model) {
  std::string rows;
  for (size_t i = 0; i < model.results.results.size(); ++i) {
    const Result& result = model.results.results[i];
    rows += fmt::format(
        "<tr data-cell=\"{}\"><td class=\"num\" data-value=\"{}\"><button type=\"button\" "
        "class=\"more\" aria-expanded=\"false\" aria-label=\"Details of cell {}\">{}</button></td>",
        i, i, i + 1, i + 1);
    rows += fmt::format("<th scope=\"row\">{}</th><td>{}</td><td>{}{}</td>", escape(result.key.scene),
                        escape(result.key.method), escape(result.key.backend), software_tag(model, result.key.backend));
    const std::string settings = escape(model.settings[i]);
    rows += result.quality ? fmt::format("<td data-value=\"{:.17g}\">{}</td>", result.quality->value, settings)
                           : "<td>" + settings + "</td>";
    rows += "<td>" + verdict_badge(to_string(result.outcome)) + "</td>" + time_figures(result) + error_figures(result);
    rows += fmt::format(
        "<td><button type=\"button\" class=\"copy\" data-copy=\"{}\" title=\"{}\">copy</button></td>"
        "</tr>",
        escape(result.command), escape(result.command));
  }
  constexpr size_t kScrolled = 80;  // more rows than these scroll in a frame of their own
  const std::string tall = model.results.results.size() > kScrolled ? " tall" : "";
  return "<div class=\"scroll" + tall +
         "\" tabindex=\"0\" role=\"group\" aria-label=\"All cells\"><table class=\"wide sortable\" "
         "id=\"cell-table\">" +
         head({{"#", true},
               {"scene", false},
               {"method", false},
               {"backend", false},
               {"setting", false},
               {"outcome", false},
               {"frame ms", true},
               {"&plusmn;", true},
               {"CPU ms", true},
               {"first ms", true},
               {"prepare ms", true},
               {"RMSE", true},
               {"max", true},
               {"|bias|", true},
               {"FLIP p99", true},
               {"SSIM", true},
               {"again", false}},
              true) +
         "<tbody>" + rows + "</tbody></table></div>";
}

std::string parity_table(const Model& model) {
  std::vector<ParityRow> parity = model.results.parity;
  std::stable_partition(parity.begin(), parity.end(), [](const ParityRow& row) { return !row.ok; });
  if (parity.empty()) return "<p class=\"note\">This run did not compare backends with each other.</p>";
  std::string rows;
  for (const ParityRow& row : parity) {
    std::string settings;
    for (size_t i = 0; i < model.results.results.size(); ++i)
      if (model.results.results[i].key == row.key) settings = model.settings[i];
    rows += fmt::format(
        "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{} / {}</td><td class=\"num\" "
        "data-value=\"{}\">{}</td>",
        escape(row.key.scene), escape(row.key.method), escape(settings), escape(row.key.backend), escape(row.other),
        row.view, row.view);
    rows += figure(scientific(row.interior_max), row.interior_max);
    rows +=
        figure(fmt::format("{} of {}", row.interior_over, row.interior_pixels), static_cast<double>(row.interior_over));
    rows += figure(scientific(row.silhouette_max), row.silhouette_max);
    rows += figure(fmt::format("{} of {}", row.silhouette_over, row.silhouette_pixels),
                   static_cast<double>(row.silhouette_over));
    rows += figure(compact(row.limit), row.limit) + "<td>" + verdict_badge(row.ok ? "ok" : "differs") + "</td></tr>";
  }
  return "<div class=\"scroll tall\" tabindex=\"0\" role=\"group\" aria-label=\"Parity\"><table class=\"wide "
         "sortable\">" +
         head({{"scene", false},
               {"method", false},
               {"setting", false},
               {"backends", false},
               {"view", true},
               {"interior max", true},
               {"over the limit", true},
               {"silhouette max", true},
               {"over the limit", true},
               {"limit", true},
               {"verdict", false}},
              true) +
         "<tbody>" + rows + "</tbody></table></div>";
}

std::string self_test_table(const Model& model) {
  if (model.results.self_test.empty()) return "<p class=\"note\">The metrics were not tested in this run.</p>";
  const bool sources = std::any_of(model.results.self_test.begin(), model.results.self_test.end(),
                                   [](const SelfTestRow& row) { return !row.source.empty(); });
  std::string rows;
  for (const SelfTestRow& row : model.results.self_test)
    rows += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"num\">{}</td><td class=\"num\">{}</td><td "
        "class=\"num\">{}</td>{}<td>{}</td></tr>",
        escape(row.name), fmt::format("{:.7g}", row.expected), fmt::format("{:.7g}", row.measured),
        compact(row.tolerance), sources ? "<td>" + escape(row.source) + "</td>" : "",
        verdict_badge(row.ok ? "ok" : "fail"));
  std::vector<std::pair<std::string, bool>> columns = {
      {"check", false}, {"expected", true}, {"measured", true}, {"tolerance", true}};
  if (sources) columns.emplace_back("source", false);
  columns.emplace_back("verdict", false);
  return "<div class=\"scroll tall\" tabindex=\"0\" role=\"group\" aria-label=\"Metrics self-test\"><table "
         "class=\"wide snug\">" +
         head(columns, false) + "<tbody>" + rows + "</tbody></table></div>";
}

}  // namespace volumark::html
