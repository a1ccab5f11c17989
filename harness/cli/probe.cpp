// volumark probe: one pixel, depth by depth.
#include "harness/probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "harness/cli/commands.h"
#include "harness/probe_output.h"
#include "reports/results.h"
#include "scenes/nearest.h"

namespace volumark::cli {
namespace {

constexpr int kLongestEdge = 192;  // of a picture whose size was not asked for

struct Options {
  std::string scene, pixel, backend = "cpu", size, out;
  std::vector<std::string> methods, set;
  int view = 0, depths = 64;
  double threshold = 2e-3;
};

std::pair<int, int> parse_pixel(const std::string& text) {
  int x = 0, y = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%d,%d%c", &x, &y, &rest) != 2)
    throw UsageError(fmt::format("--pixel: expected x,y (row 0 on top), found \"{}\"", text));
  return {x, y};
}

// The scene's own shape, small.
std::pair<int, int> size_of(const Options& options, const Scene& scene) {
  if (!options.size.empty()) return parse_size(options.size);
  const double scale = std::min(1., static_cast<double>(kLongestEdge) / std::max(scene.width, scene.height));
  const auto scaled = [&](int pixels) { return std::max(1, static_cast<int>(std::lround(pixels * scale))); };
  return {scaled(scene.width), scaled(scene.height)};
}

std::string output_format(const std::string& out) {
  const std::string extension = std::filesystem::path(out).extension().string();
  if (!out.empty() && extension != ".html" && extension != ".json" && extension != ".svg")
    throw UsageError(fmt::format("--out {}: a profile is written as .html, .json or .svg", out));
  return extension;
}

// Does "raycast:step" speak of this subject? By its method's name, its letter (A, B) or not at all: of each.
bool speaks_of(const std::string& whom, const ProbeSubject& subject, size_t index) {
  return whom.empty() || whom == curve_letter(index) ||
         (subject.method != nullptr && whom == subject.method->info().name);
}

void apply_setting(const std::string& text, std::vector<ProbeSubject>& subjects) {
  const auto [key, value] = split_assignment(text);
  const size_t colon = key.find(':');
  const std::string whom = colon == std::string::npos ? "" : key.substr(0, colon);
  const std::string name = colon == std::string::npos ? key : key.substr(colon + 1);
  bool used = false;
  for (size_t i = 0; i < subjects.size(); ++i) {
    ProbeSubject& subject = subjects[i];
    if (!speaks_of(whom, subject, i)) continue;
    if (subject.method == nullptr) {
      if (!whom.empty()) throw UsageError(fmt::format("--set {}: the reference has no parameters", text));
      continue;
    }
    set_value(subject.method->info().parameters, subject.values, name, value);
    subject.label += fmt::format(" {}={}", name, value);
    used = true;
  }
  if (!used) throw UsageError(fmt::format("--set {}: no --method that it speaks of", text));
}

std::vector<ProbeSubject> subjects_of(const Options& options) {
  std::vector<std::string> names = options.methods;
  // One method alone is held against the reference; two also show it.
  if (std::find(names.begin(), names.end(), "reference") == names.end()) names.emplace_back("reference");
  if (names.size() > 3 || std::count(names.begin(), names.end(), "reference") > 1)
    throw UsageError("--method: one or two, and the reference");
  std::vector<ProbeSubject> subjects;
  for (const std::string& name : names) {
    if (name == "reference") {
      subjects.push_back({name});
    } else {
      const Method& method = find_method(name);
      subjects.push_back({name, &method, default_values(method.info().parameters)});
    }
  }
  for (const std::string& text : options.set) apply_setting(text, subjects);
  return subjects;
}

std::string command_line(const Globals& globals) {
  std::string out = "volumark";
  for (size_t i = 1; i < globals.argv.size(); ++i) out += " " + globals.argv[i];
  return out;
}

int probe_pixel(const Options& options, const Globals& globals) {
  const std::string format = output_format(options.out);
  const std::vector<ProbeSubject> subjects = subjects_of(options);
  check_backend_name(options.backend);
  Scene scene = load_scene(options.scene);
  if (options.view < 0 || options.view >= static_cast<int>(scene.views.size()))
    throw UsageError(
        fmt::format("--view {}: scene {} has views 0 to {}", options.view, scene.name, scene.views.size() - 1));
  load_data(scene, globals.data_options());
  ProbeOptions settings;
  std::tie(settings.width, settings.height) = size_of(options, scene);
  std::tie(settings.x, settings.y) = parse_pixel(options.pixel);
  settings.depths = options.depths;
  settings.threshold = options.threshold;
  const View& view = scene.views[static_cast<size_t>(options.view)];

  std::optional<Device> device;
  if (subjects.front().method != nullptr || subjects.size() > 1) device.emplace(open_backend(options.backend, globals));
  Probe result;
  try {
    result = probe(scene, view, subjects, device ? &*device : nullptr, settings);
  } catch (const ProbeError& error) {
    throw UsageError(error.what());
  }
  const ProbeHeading heading{scene.name, options.backend, options.view, command_line(globals)};
  if (format == ".json") write_file_atomically(options.out, probe_json(result, heading));
  if (format == ".svg") write_file_atomically(options.out, probe_svg(result, heading));
  if (format == ".html") write_file_atomically(options.out, probe_html(result, heading));
  fmt::print("{}\n{}\n{}\n{}\n", probe_summary(result, heading), probe_table(result), probe_plot(result),
             parting_text(result));
  if (!options.out.empty()) fmt::print("{}\n", options.out);
  return kOk;
}

}  // namespace

void add_probe(CLI::App& app, const Globals& globals, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("probe", "Follow one pixel's ray: transmittance and colour, depth by depth");
  command->add_option("scene", options->scene, "a scene's name, or a .json file")->required();
  command->add_option("--pixel,-p", options->pixel, "x,y in the picture, row 0 on top")->required();
  command->add_option("--method,-m", options->methods, "a method's name, or reference; twice to compare two")
      ->required()
      ->take_all();
  command->add_option("--backend,-b", options->backend, "gl, vulkan or cpu")->capture_default_str();
  command
      ->add_option("--set", options->set, "a parameter: name=value of each method, or METHOD:name=value, A:name=value")
      ->take_all();
  command->add_option("--view", options->view, "index of the view")->capture_default_str();
  command->add_option("--size", options->size, "WIDTHxHEIGHT of the picture; default: the scene's shape, 192 at most");
  command->add_option("--depths", options->depths, "depths of the profile")
      ->check(CLI::Range(2, 4096))
      ->capture_default_str();
  command->add_option("--threshold", options->threshold, "two curves part where they differ by more")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--out,-o", options->out, "also as a file: .html, .json or .svg");
  command->footer(
      "One --method is held against the reference, two against each other.\nExample: volumark probe engine --pixel "
      "90,100 --method raycast --method texture3d_slices --set raycast:step=0.5 --out probe.html");
  command->callback(
      [&globals, &action, options] { action = [&globals, options] { return probe_pixel(*options, globals); }; });
}

}  // namespace volumark::cli
