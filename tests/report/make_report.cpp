// make_report FOLDER: writes the synthetic run there, results.json with its pictures and report.html, and the same run
// without pictures as bare.html. make_report FOLDER RESULTS: report.html of a real run.
#include <cstdio>
#include <exception>

#include "reports/html/html_report.h"
#include "tests/report/synthetic_run.h"

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
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "make_report: %s\n", error.what());
  return 1;
}
