// Where the figures come from: machine, build, backends, run.
#include <fmt/format.h>

#include "reports/html/format.h"
#include "reports/html/sections.h"

namespace volumark::html {
namespace {

std::string line(const std::string& name, const std::string& value) {
  return value.empty() ? "" : "<dt>" + name + "</dt><dd>" + escape(value) + "</dd>";
}

template <class T>
std::string joined(const std::vector<T>& words, const char* between) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
  return out;
}

std::string sentence(const std::string& text) {
  if (text.empty()) return "";
  return text + (text.back() == '.' ? " " : ". ");
}

std::string variables(const std::map<std::string, std::string>& env) {
  std::string out;
  for (const auto& [name, value] : env) out += fmt::format("{}{}={}", out.empty() ? "" : "  ", name, value);
  return out;
}

std::string load(const std::array<double, 3>& values) {
  return fmt::format("{:.2f} {:.2f} {:.2f}", values[0], values[1], values[2]);
}

// How finely the driver filters textures, and what that means.
std::string filter_text(const BackendResultInfo& info) {
  if (info.filter_levels.empty()) return "";
  constexpr double kEightBits = 300;  // about 256 steps between two texels, however many are asked for
  std::string levels, coarse;
  for (const auto& [format, count] : info.filter_levels) {
    levels += fmt::format("{}{} {:.0f}", levels.empty() ? "" : ", ", format, count);
    if (count <= kEightBits) coarse += (coarse.empty() ? "" : ", ") + format;
  }
  const std::string meaning =
      coarse.empty() ? "Linear filtering is finer than 8 bits for all of them: it adds no visible error of its own."
                     : "Linear filtering of " + coarse +
                           " has only 8 bits: it errs by up to 1/255 of the data's range, "
                           "whatever the step; a wider texture format avoids it.";
  return "<p class=\"hint filter\">Filter levels, distinct values of 4096 between two texels 0 and 1: " +
         escape(levels) + ". " + escape(meaning) + "</p>";
}

std::string backend(const BackendResultInfo& info) {
  std::string out =
      "<div class=\"card\"><h3>" + escape(info.id) +
      (info.software ? " <span class=\"tag\">software</span>" : " <span class=\"tag hard\">hardware</span>") +
      "</h3><dl>";
  out += line("API", info.api) + line("vendor", info.vendor) + line("renderer", info.renderer);
  out += line("version", info.version) + line("driver", info.driver) + line("LLVM", info.llvm);
  if (info.simd_bits > 0) out += line("SIMD", fmt::format("{} bits", info.simd_bits));
  if (info.threads > 0) out += line("threads", fmt::format("{}", info.threads));
  return out + line("variables", variables(info.env)) + line("capabilities", joined(info.capabilities, ", ")) +
         line("workarounds", joined(info.workarounds, "; ")) + "</dl>" + filter_text(info) + "</div>";
}

}  // namespace

std::string environment_section(const Model& model) {
  const Results& r = model.results;
  std::string out = "<div class=\"cards even\"><div class=\"card\"><h3>Machine</h3><dl>";
  out += line("CPU", r.machine.cpu) + line("cores", fmt::format("{}", r.machine.cores));
  out += line("memory", fmt::format("{:.1f} GiB", static_cast<double>(r.machine.ram_bytes) / 1073741824.0));
  out += line("system", r.machine.os) + line("hypervisor", r.machine.hypervisor);
  out += line("load before", load(r.machine.load_before)) + line("load after", load(r.machine.load_after));
  out += line("variables", variables(r.machine.env)) + "</dl></div>";
  out += "<div class=\"card\"><h3>Run and build</h3><dl>" + line("run", r.run.id) + line("started", r.run.started_at);
  out += line("finished", r.run.finished_at) + line("order", r.run.order) + line("seed", fmt::format("{}", r.run.seed));
  if (r.run.resumed > 0) out += line("resumed", fmt::format("{} times", r.run.resumed));
  out += line("commit", r.git.sha + (r.git.dirty ? " with uncommitted changes" : ""));
  out += line("branch", r.git.branch) + line("commit date", r.git.commit_date);
  out += line("compiler", r.build.compiler + " " + r.build.version) + line("build type", r.build.type);
  out += line("flags", r.build.flags) + line("schema", r.schema_name + " " + r.schema_version) + "</dl>";
  const std::string command = joined(r.run.argv, " ");
  out += "<p>" + command_box(command) + "</p></div>";
  for (const BackendResultInfo& info : r.backends) out += backend(info);
  out += "</div>";
  if (!r.experiments.empty()) {
    out += "<h3>Experiments</h3><dl class=\"wide-dl\">";
    for (const ExperimentResultInfo& experiment : r.experiments) {
      std::string limits;
      for (const auto& [metric, limit] : experiment.limits)
        limits += (limits.empty() ? "" : ", ") + metric + " " + compact(limit);
      out += line(escape(experiment.name), sentence(experiment.title) + sentence(experiment.description) +
                                               (limits.empty() ? "" : "Limits: " + limits + "."));
    }
    out += "</dl>";
  }
  return out;
}

}  // namespace volumark::html
