#include "reports/html/html_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "reports/html/assets.h"
#include "reports/html/format.h"
#include "reports/html/sections.h"

namespace volumark {
namespace html {
namespace {

using Json = nlohmann::json;

// The scripts show statistics; the raw samples stay in results.json, which is many times larger.
void drop_samples(Json& node) {
  if (node.is_object() && node.contains("samples") && node.contains("stats")) {
    node.erase("samples");
    node.erase("views");
  }
  if (node.is_structured())
    for (Json& child : node) drop_samples(child);
}

// Of each view the scripts show a few metrics only; the rest is in the worst of the cell, or in results.json.
void drop_view_errors(Json& cells) {
  for (Json& cell : cells)
    for (Json& view : cell["views"]) {
      if (!view.contains("error")) continue;
      Json kept = Json::object();
      for (const char* name : {"rmse", "max", "max_x", "max_y", "flip_p99", "ssim"})
        if (view["error"].contains(name)) kept[name] = view["error"][name];
      view["error"] = std::move(kept);
      view.erase("counters");
    }
}

std::string script_json(const Json& json) {
  return json_for_script(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string results_json(const Results& results) {
  Json json;  // what is a table already is not needed a second time
  json["results"] = to_json(results)["results"];
  drop_samples(json["results"]);
  drop_view_errors(json["results"]);
  return script_json(json);
}

std::string model_json(const Model& model, const PictureBook& book) {
  Json json;
  json["settings"] = model.settings;
  for (const Block& block : model.blocks)
    json["blocks"].push_back({{"id", block.id}, {"title", model.title(block)}, {"cells", block.cells}});
  json["entries"] = Json::array();
  for (const PictureEntry& entry : book.entries)
    json["entries"].push_back({{"cell", entry.cell},
                               {"view", entry.view},
                               {"rendered", entry.rendered},
                               {"reference", entry.reference},
                               {"difference", entry.difference},
                               {"flip", entry.flip},
                               {"note", entry.note}});
  // Full scale of the signed difference pictures: 50 % grey is equal, black and white are this far apart.
  json["difference_scale"] = kDifferenceScale;
  return script_json(json);
}

std::string picture_scripts(const PictureBook& book) {
  std::string out;
  for (size_t i = 0; i < book.base64.size(); ++i)
    out += fmt::format("<script type=\"text/plain\" id=\"picture-{}\">", i) + book.base64[i] + "</script>\n";
  return out;
}

std::string note_lines(const std::vector<std::string>& notes) {
  std::string out;
  for (const std::string& note : notes) out += "<p class=\"warning\" role=\"note\">" + escape(note) + ".</p>";
  return out;
}

std::string picture_note(const PictureBook& book) {
  if (book.entries.empty())
    return "<p class=\"warning\" role=\"note\">No picture is in this report: the run kept none (or their PNG previews "
           "are not beside the results file).</p>";
  std::string out;
  if (book.missing > 0)
    out += fmt::format(
        "<p class=\"warning\" role=\"note\">{} pictures could not be embedded; the view says which and "
        "why.</p>",
        book.missing);
  if (book.left_out > 0)
    out += fmt::format(
        "<p class=\"note\">{} pictures of coarser settings were left out to keep this file below {} MB; "
        "they are in the results' folder.</p>",
        book.left_out, kPictureBudget >> 20);
  return out;
}

// Of one experiment its title; of several their names.
std::string page_title(const Results& results) {
  const std::string cases = results.hard_cases.empty() ? "" : "hard cases";
  if (results.experiments.size() == 1) {
    const ExperimentResultInfo& only = results.experiments.front();
    return only.title.empty() ? only.name : only.title;
  }
  std::string out;
  for (const ExperimentResultInfo& experiment : results.experiments) out += (out.empty() ? "" : ", ") + experiment.name;
  if (out.empty()) return cases.empty() ? "Results" : "Hard cases";
  return out + (cases.empty() ? "" : ", " + cases);
}

// Replaces each {{name}} of the template once; what is put in is not searched again.
std::string fill(std::string_view text, const std::map<std::string, std::string, std::less<>>& values) {
  std::string out;
  size_t at = 0;
  for (size_t open; (open = text.find("{{", at)) != std::string_view::npos;) {
    const size_t close = text.find("}}", open);
    const auto value = values.find(text.substr(open + 2, close - open - 2));
    if (close == std::string_view::npos || value == values.end())
      throw std::logic_error("template of the report: unknown place near '" + std::string(text.substr(open, 40)) + "'");
    out += text.substr(at, open - at);
    out += value->second;
    at = close + 2;
  }
  return out += text.substr(at);
}

}  // namespace
}  // namespace html

void write_html_report(const Results& results, const std::filesystem::path& results_dir,
                       const std::filesystem::path& out, const std::vector<std::string>& notes) {
  using namespace html;
  const Model model(results);
  const PictureBook book = read_pictures(model, results_dir);
  const std::string papers = claims_table(model, book);
  const std::string page =
      fill(page_template(), {{"title", escape(page_title(results))},
                             {"style", style_text()},
                             {"script", script_text()},
                             {"run", run_line(model) + note_lines(notes)},
                             {"answers", answers(model)},
                             {"tiles", summary_tiles(model)},
                             {"stability", stability_section(model, book)},
                             {"effects", effects_section(model, book)},
                             {"scenes", scene_sections(model, book)},
                             {"picture_note", picture_note(book)},
                             {"problems", problems_section(model)},
                             {"cells", cells_table(model)},
                             {"parity", parity_table(model)},
                             {"claims", papers},
                             {"papers_link", papers.empty() ? "" : "<a href=\"#claims\">Papers</a>"},
                             {"self_test", self_test_table(model)},
                             {"environment", environment_section(model)},
                             {"results_json", results_json(results)},
                             {"model_json", model_json(model, book)},
                             {"pictures", picture_scripts(book)}});
  write_file_atomically(out, page);
}

}  // namespace volumark
