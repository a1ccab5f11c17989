// make_report FOLDER: writes the synthetic run there, results.json with its pictures and report.html, and the same run
// without pictures as bare.html, as a file of version 1.0 as old.html, and the hard cases alone as verify.html.
// make_report FOLDER RESULTS: report.html of a real run.
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>

#include "reports/html/html_report.h"
#include "tests/report/synthetic_run.h"

namespace {

// The run as version 1.0 wrote it: without the members that came later, and without their cells.
volumark::Results of_version_1_0(const std::filesystem::path& folder) {
  nlohmann::json json = to_json(volumark::read_results(folder));
  json["schema"]["version"] = "1.0.0";
  json.erase("nulls");
  for (const char* later : {"attribution", "pairs", "effects", "hard_cases", "sensitivity"}) json.erase(later);
  nlohmann::json cells = nlohmann::json::array();
  for (nlohmann::json& cell : json["results"]) {
    if (cell["key"]["variant"] != "" || cell["key"]["experiment"] != "quick") continue;
    cell["key"].erase("variant");
    cell.erase("ignored_effects");
    cell.erase("programs");
    cells.push_back(cell);
  }
  json["results"] = cells;
  for (nlohmann::json& backend : json["backends"]) backend.erase("filter_levels");
  for (nlohmann::json& row : json["convergence"]) row.erase("floor_reason");
  return volumark::results_from_json(json);
}

}  // namespace

int main(int argc, char** argv) try {
  using namespace volumark;
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: make_report FOLDER [RESULTS]\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  if (argc == 3) {
    const std::filesystem::path given = argv[2];
    write_html_report(read_results(given), std::filesystem::is_directory(given) ? given : given.parent_path(),
                      folder / "report.html");
    return 0;
  }
  Results results = report_test::synthetic_run(folder);
  write_results(results, folder / "results.json");
  write_html_report(read_results(folder), folder, folder / "report.html");
  for (Result& result : results.results)
    for (ViewResult& view : result.views)
      view.rendered = view.reference_image = view.difference = view.flip = std::nullopt;
  write_html_report(results, folder, folder / "bare.html");
  write_html_report(of_version_1_0(folder), folder, folder / "old.html");
  Results verified = results;
  verified.results.clear();
  verified.convergence.clear();
  verified.parity.clear();
  verified.attribution.clear();
  verified.pairs.clear();
  verified.effects.clear();
  write_html_report(verified, folder, folder / "verify.html");
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "make_report: %s\n", error.what());
  return 1;
}
