// The hard cases: for each the worst deviation as a bar up to its bound, its rows as a table, and the worst pixels.
#include <fmt/format.h>

#include <algorithm>

#include "reports/html/bars.h"
#include "reports/html/format.h"
#include "reports/html/hard_case_summary.h"
#include "reports/html/sections.h"

namespace volumark::html {
namespace {

std::string symbol(const std::string& outcome) {
  return outcome == "pass" ? "&#10003;" : outcome == "fail" || outcome == "error" ? "&#10007;" : "&ndash;";
}

std::string outcome_badge(const HardCaseRow& row) {
  return row.outcome == "not_applicable" ? "<span class=\"badge neutral\">not applicable</span>"
                                         : verdict_badge(row.outcome);
}

std::string table_row(const HardCaseRow& row) {
  const bool measured = has_deviation(row);
  auto figure = [&](double value) {
    return measured ? fmt::format("<td class=\"num\" data-value=\"{:.17g}\">{}</td>", value, number(value))
                    : std::string("<td class=\"num none\">-</td>");
  };
  std::string why = row.reason.empty() ? "" : "<b>" + escape(row.reason) + "</b>";
  if (!row.source.empty()) why += (why.empty() ? "" : "<br>") + escape(row.source);
  return "<tr class=\"is-" + escape(row.outcome) + "\"><td>" + outcome_badge(row) + "</td><th scope=\"row\">" +
         escape(row.check) + "</th><td>" + escape(row.method.empty() ? "-" : row.method) + "</td><td>" +
         escape(row.backend.empty() ? "-" : row.backend) + "</td>" + figure(row.expected) + figure(row.measured) +
         figure(row.deviation) + figure(row.bound) +
         (measured ? fmt::format("<td class=\"share\" data-value=\"{:.17g}\">", share_of_bound(row)) +
                         bound_bar(share_of_bound(row)) + " " + number(share_of_bound(row)) + "</td>"
                   : std::string("<td class=\"none\">-</td>")) +
         "<td class=\"reason\">" + why + "</td><td>" +
         (row.command.empty() ? ""
                              : "<button type=\"button\" class=\"copy\" data-copy=\"" + escape(row.command) +
                                    "\" title=\"" + escape(row.command) + "\">copy</button>") +
         "</td></tr>";
}

std::string spot(const Model& model, const PictureBook& book, const HardCaseRow& row) {
  const size_t index = static_cast<size_t>(&row - model.results.hard_cases.data());
  const auto found = book.hard_cases.find(index);
  if (found == book.hard_cases.end()) return "";
  const auto [picture, difference] = found->second;
  const std::string at = row.x >= 0 ? fmt::format(", worst pixel {}, {}", row.x, row.y) : "";
  return fmt::format(
      "<figure class=\"spots\" data-picture=\"{}\" data-difference=\"{}\" data-x=\"{}\" data-y=\"{}\"><figcaption>"
      "{}{}</figcaption></figure>",
      picture, difference, row.x, row.y, escape(place_of(row) + (row.check.empty() ? "" : ": " + row.check)), at);
}

bool is_bad(const HardCaseRow& row) { return row.outcome != "pass" && row.outcome != "not_applicable"; }

std::string table(const std::string& name, const std::string& rows) {
  return table_text(name,
                    {{"outcome", false},
                     {"check", false},
                     {"method", false},
                     {"backend", false},
                     {"expected", true},
                     {"measured", true},
                     {"deviation", true},
                     {"bound", true},
                     {"deviation / bound", false},
                     {"reason; where expected value and bound come from", false},
                     {"again", false}},
                    rows, "wide sortable");
}

std::string group_text(const Model& model, const PictureBook& book, const HardCaseGroup& group) {
  const HardCaseRow& worst = *group.rows.front();
  size_t passed = 0, bad = 0, not_applicable = 0;
  std::string good_rows, bad_rows, spots;
  for (const HardCaseRow* row : group.rows) {
    ++(row->outcome == "pass" ? passed : row->outcome == "not_applicable" ? not_applicable : bad);
    (is_bad(*row) ? bad_rows : good_rows) += table_row(*row);
    spots += spot(model, book, *row);
  }
  const size_t good = passed + not_applicable;
  std::string counts = fmt::format("{} of {} hold", passed, passed + bad);
  if (passed + bad == 0) counts = "not applicable";
  const std::string state = bad > 0 ? "bad" : passed > 0 ? "good" : "none";
  std::string title = "<span class=\"case-line " + state + "\"><span class=\"state\">" +
                      symbol(bad > 0      ? "fail"
                             : passed > 0 ? "pass"
                                          : "none") +
                      "</span><span class=\"case-name\">" + escape(worst.number) + " " + escape(worst.title) +
                      "</span>";
  title += has_deviation(worst)
               ? bound_bar(share_of_bound(worst)) + "<span class=\"case-worst\">" + share_text(worst) +
                     " <span class=\"dim\">" + escape(worst.method) +
                     (worst.backend.empty() ? "" : " " + escape(worst.backend)) + "</span></span>"
               : "<span></span><span class=\"case-worst\">" + (worst.outcome == "error" ? "error: " : std::string()) +
                     escape(worst.reason) + "</span>";
  title += "<span class=\"case-counts\">" + counts + "</span></span>";
  const std::string passes = table(worst.title, good_rows);
  std::string inside = bad > 0 ? table(worst.title, bad_rows) : passes;
  if (!spots.empty()) inside += "<div class=\"spot-row\">" + spots + "</div>";
  if (bad > 0 && !good_rows.empty()) inside += folded(fmt::format("{} more, which do not fail", good), passes);
  return "<details class=\"fold case\" data-case=\"" + escape(group.id) + "\"" + (bad > 0 ? " open" : "") +
         "><summary>" + title + "</summary>" + inside + "</details>";
}

}  // namespace

std::string stability_section(const Model& model, const PictureBook& book) {
  const Results& results = model.results;
  if (results.hard_cases.empty() && results.sensitivity.empty())
    return missing_text("No hard case was checked", "verify");
  std::string out;
  if (results.hard_cases.empty()) {
    out = missing_text("No hard case was checked", "verify");
  } else {
    out =
        "<p class=\"hint\">Each case has an answer in closed form or within a bound. The bar is the worst deviation of "
        "the case; the line across it is the bound, and what goes beyond is hatched. A case opens on a click or "
        "Enter; those that fail are open.</p><div class=\"cases\">";
    std::vector<HardCaseGroup> groups = group_cases(results.hard_cases);
    std::stable_partition(groups.begin(), groups.end(),
                          [](const HardCaseGroup& group) { return is_bad(*group.rows.front()); });
    for (const HardCaseGroup& group : groups) out += group_text(model, book, group);
    out += "</div><p class=\"hint\">All again: </p>" + command_box("volumark verify");
  }
  return out + sensitivity_part(model, book);
}

}  // namespace volumark::html
