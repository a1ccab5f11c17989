// volumark report: tables and the HTML file, from results.json alone; of several runs one report.
#include <fmt/format.h>

#include "harness/cli/commands.h"
#include "reports/merge.h"
#include "reports/tables.h"
#ifdef VM_HAS_HTML
#include "reports/html/html_report.h"
#endif

namespace volumark::cli {
namespace {

struct ReportOptions {
  std::vector<std::filesystem::path> paths;
  std::string out;
};

int report(const ReportOptions& options) {
  const MergedResults merged = merge_results(options.paths);
  const std::filesystem::path& first = options.paths.front();
  for (const std::string& note : merged.notes) fmt::print(stderr, "note: {}\n", note);
  fmt::print("{}", tables_text(merged.results));
#ifdef VM_HAS_HTML
  const std::filesystem::path beside = std::filesystem::is_directory(first) ? first : first.parent_path();
  const std::filesystem::path out = options.out.empty() ? beside / "report.html" : std::filesystem::path(options.out);
  write_html_report(merged.results, merged.folder, out, merged.notes);
  fmt::print("{}\n", out.string());
#else
  if (!options.out.empty()) throw UsageError("--out: this volumark was built without the HTML report");
#endif
  return kOk;
}

}  // namespace

void add_report(CLI::App& app, const Globals&, Action& action) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App* command = app.add_subcommand("report", "Tables and one self-contained HTML file from results");
  command->add_option("results", options->paths, "a run's folder, or results.json; several make one report")
      ->required();
  command->add_option("--out,-o", options->out, "the HTML file (default: report.html beside the first results)");
  command->footer("Example: volumark report out/accuracy out/effects out/verify");
  command->callback([&action, options] { action = [options] { return report(*options); }; });
}

}  // namespace volumark::cli
