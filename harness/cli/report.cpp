// volumark report: tables and the HTML file, from results.json alone.
#include <fmt/format.h>

#include "harness/cli/commands.h"
#include "reports/tables.h"
#ifdef VM_HAS_HTML
#include "reports/html/html_report.h"
#endif

namespace volumark::cli {
namespace {

struct ReportOptions {
  std::string path, out;
};

int report(const ReportOptions& options) {
  const Results results = read_results(options.path);
  const bool folder = std::filesystem::is_directory(options.path);
  const std::filesystem::path base =
      folder ? std::filesystem::path(options.path) : std::filesystem::absolute(options.path).parent_path();
  fmt::print("{}", tables_text(results));
#ifdef VM_HAS_HTML
  const std::filesystem::path out = options.out.empty() ? base / "report.html" : std::filesystem::path(options.out);
  write_html_report(results, base, out);
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
  command->add_option("results", options->path, "a run's folder, or results.json")->required();
  command->add_option("--out,-o", options->out, "the HTML file (default: report.html beside the results)");
  command->footer("Example: volumark report out/quick");
  command->callback([&action, options] { action = [options] { return report(*options); }; });
}

}  // namespace volumark::cli
