#include "harness/resume.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "harness/environment.h"

namespace volumark {

namespace {

// When a cell is done: more passes, a longer budget or a narrower interval make other figures of the same cell.
std::string sampling_of(const Experiment& experiment) {
  return fmt::format("{} to {} passes, {:g} s, {:g} %, timeout {:g} s", experiment.least, experiment.most,
                     experiment.budget, 100 * experiment.precision, experiment.timeout);
}

// What makes a cell a wrong image, or its backends disagree.
std::string limits_of(const Experiment& experiment) {
  std::vector<std::string> out;
  for (const auto& [metric, worst] : experiment.limits) out.push_back(fmt::format("{} {:g}", metric, worst));
  for (const auto& [metric, worst] : experiment.finest_limits)
    out.push_back(fmt::format("finest {} {:g}", metric, worst));
  if (experiment.parity > 0) out.push_back(fmt::format("parity {:g}", experiment.parity));
  if (experiment.references) out.push_back(fmt::format("reference to {:g}", experiment.reference_tolerance));
  return fmt::format("{}", fmt::join(out, ", "));
}

}  // namespace

std::map<std::string, std::string> deciding_options(const RunOptions& options,
                                                    const std::vector<Experiment>& experiments) {
  const DeviceOptions& device = options.cell.device;
  std::map<std::string, std::string> out = {{"threads", std::to_string(device.threads)},
                                            {"gl_platform", device.gl_platform},
                                            {"vk_device", device.vk_device},
                                            {"validation", device.validation ? "on" : "off"},
                                            {"references", options.references ? "on" : "off"},
                                            {"ignore_effects", options.ignore_effects ? "on" : "off"}};
  for (const Experiment& experiment : experiments) {
    out["sampling of " + experiment.name] = sampling_of(experiment);
    out["limits of " + experiment.name] = limits_of(experiment);
  }
  return out;
}

std::string resume_differences(const Results& earlier, const RunOptions& options,
                               const std::vector<Experiment>& experiments) {
  std::vector<std::string> out;
  const auto compare = [&](const std::string& what, const std::string& was, const std::string& is) {
    if (was != is)
      out.push_back(fmt::format("{}: {}, now {}", what, was.empty() ? "none" : was, is.empty() ? "none" : is));
  };
  const GitInfo git = git_info();
  const BuildInfo build = build_info();
  const MachineInfo machine = machine_info();
  compare("commit", earlier.git.sha, git.sha);
  compare("local changes", earlier.git.dirty ? "yes" : "no", git.dirty ? "yes" : "no");
  compare("build type", earlier.build.type, build.type);
  compare("compiler", earlier.build.compiler + " " + earlier.build.version, build.compiler + " " + build.version);
  compare("compiler flags", earlier.build.flags, build.flags);
  compare("processor", earlier.machine.cpu, machine.cpu);
  compare("cores", std::to_string(earlier.machine.cores), std::to_string(machine.cores));
  const auto compare_all = [&](const std::map<std::string, std::string>& was,
                               const std::map<std::string, std::string>& is) {
    const auto value = [](const auto& map, const std::string& name) {
      const auto found = map.find(name);
      return found == map.end() ? std::string() : found->second;
    };
    std::set<std::string> names;
    for (const auto& [name, unused] : was) names.insert(name);
    for (const auto& [name, unused] : is) names.insert(name);
    for (const std::string& name : names) compare(name, value(was, name), value(is, name));
  };
  compare_all(earlier.machine.env, machine.env);
  compare_all(earlier.run.device, deciding_options(options, experiments));
  std::vector<std::string> sweeps;
  for (const Sweep& sweep : options.sweeps) sweeps.push_back(to_string(sweep));
  compare("--sweep", fmt::format("{}", fmt::join(earlier.run.sweeps, " ")), fmt::format("{}", fmt::join(sweeps, " ")));
  return fmt::format("{}", fmt::join(out, "; "));
}

std::string resume_command(std::vector<std::string> argv) {
  std::erase_if(argv, [](const std::string& word) { return word == "--overwrite" || word == "--resume"; });
  argv.emplace_back("--resume");
  std::string out;
  for (const std::string& word : argv) out += (out.empty() ? "" : " ") + shell_quoted(word);
  return out;
}

}  // namespace volumark
