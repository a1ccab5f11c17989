// volumark render: one picture.
#include <fmt/format.h>

#include "harness/cli/commands.h"
#include "harness/effect_variants.h"
#include "harness/frame.h"
#include "harness/image_io.h"
#include "harness/progress.h"
#include "harness/scene_data.h"
#include "methods/reference/reference.h"
#include "scenes/nearest.h"

namespace volumark::cli {
namespace {

struct RenderOptions {
  std::string scene, method, backend = "cpu", out, size;
  std::vector<std::string> set;
  int view = 0;
  bool ignore_effects = false;
};

const View& view_of(const Scene& scene, int index) {
  if (index < 0 || index >= static_cast<int>(scene.views.size()))
    throw UsageError(fmt::format("--view {}: scene {} has views 0 to {}", index, scene.name, scene.views.size() - 1));
  return scene.views[static_cast<size_t>(index)];
}

void render_with_reference(const RenderOptions& options, const Scene& scene, int width, int height, int threads) {
  if (!options.set.empty()) throw UsageError("--set: the reference has no parameters");
  ReferenceOptions reference_options;
  reference_options.threads = threads;
  const Instant start = now();
  const Reference reference = render_reference(scene, view_of(scene, options.view), width, height, reference_options);
  write_image(options.out, reference.image, scene.background, ignored_note(scene.effects.others));
  fmt::print("{}: {}x{}, reference, {}; largest error bound {:.2e}{}\n", options.out, width, height,
             duration_text(since(start).wall), reference.max_bound, reference.estimate ? " (an estimate)" : "");
}

int refuse(const std::string& reason) {
  fmt::print(stderr, "volumark: unsupported: {}\n", reason);
  if (reason.starts_with("effect ")) fmt::print(stderr, "volumark: to draw without it: --ignore-effects\n");
  return kBadNews;
}

// What no setting and no backend could change: known before data are read.
std::optional<std::string> missing_effect(const RenderOptions& options, const Scene& scene) {
  if (options.method != "reference")
    if (auto other = display_reason(find_method(options.method), scene)) return other;
  if (options.ignore_effects) return std::nullopt;
  if (options.method != "reference") return missing_effect_reason(find_method(options.method), scene.effects);
  if (scene.effects.others.empty()) return std::nullopt;
  return fmt::format("effect {}: the reference does not simulate it", scene.effects.others.front());
}

// The effects that are left out so that the picture can be drawn; the user is told.
std::vector<std::string> ignored_effects(const Method& method, const Scene& scene, const Values& values,
                                         const Device& device) {
  std::vector<std::string> ignored = effects_to_ignore(method, scene, values, device.info());
  if (!ignored.empty())
    fmt::print(stderr, "volumark: warning: {} does not simulate {}: the picture lacks what the scene calls for\n",
               method.info().name, fmt::join(ignored, ", "));
  return ignored;
}

int render_with_method(const RenderOptions& options, const Scene& whole, int width, int height,
                       const Globals& globals) {
  const Method& method = find_method(options.method);
  Values values = default_values(method.info().parameters);
  for (const std::string& text : options.set) {
    const auto [name, value] = split_assignment(text);
    set_value(method.info().parameters, values, name, value);
  }
  const View& view = view_of(whole, options.view);
  Device device = open_backend(options.backend, globals);
  std::vector<std::string> ignored;
  if (options.ignore_effects) ignored = ignored_effects(method, whole, values, device);
  const Scene scene = without_effects(whole, ignored);
  if (const auto reason = unsupported_reason(method, scene, values, device.info())) return refuse(*reason);
  FrameSource source(scene, method, values, device, width, height);
  const FrameCost first = source.frame(view);
  write_image(options.out, source.read_back(), scene.background, ignored_note(ignored));
  fmt::print(
      "{}: {}x{}, {} on {} ({}): prepare {}, first frame {}, peak {:.1f} MiB on the device ({:.1f} MiB of voxels)\n",
      options.out, width, height, method.info().name, options.backend, device.info().renderer,
      duration_text(source.prepare_cost().cost.wall), duration_text(first.cost.wall),
      static_cast<double>(device.peak_bytes()) / 1048576, static_cast<double>(data_of(scene).bytes) / 1048576);
  return kOk;
}

int render(const RenderOptions& options, const Globals& globals) {
  if (options.method != "reference") {
    check_backend_name(options.backend);
    std::vector<std::string> names = {"reference"};
    for (const Method* method : method_list()) names.push_back(method->info().name);
    if (std::find(names.begin(), names.end(), options.method) == names.end())
      throw UsageError(fmt::format("unknown method \"{}\"{}; known: {}", options.method,
                                   did_you_mean(options.method, names), fmt::join(names, ", ")));
  }
  Scene scene = load_scene(options.scene);
  if (const auto reason = missing_effect(options, scene)) return refuse(*reason);
  load_data(scene, globals.data_options());
  int width = scene.width, height = scene.height;
  if (!options.size.empty()) std::tie(width, height) = parse_size(options.size);
  if (options.method != "reference") return render_with_method(options, scene, width, height, globals);
  render_with_reference(options, scene, width, height, globals.device.threads);
  return kOk;
}

}  // namespace

void add_render(CLI::App& app, const Globals& globals, Action& action) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Draw one view of a scene into an image file");
  command->add_option("scene", options->scene, "a scene's name, or a .json file")->required();
  command->add_option("--method,-m", options->method, "a method's name, or reference")->required();
  command->add_option("--backend,-b", options->backend, "gl, vulkan or cpu")->capture_default_str();
  command->add_option("--set", options->set, "a parameter: name=value (volumark list methods)")->take_all();
  command->add_flag("--ignore-effects", options->ignore_effects,
                    "draw without the effects that the method cannot simulate; the file says so");
  command->add_option("--view", options->view, "index of the view")->capture_default_str();
  command->add_option("--size", options->size, "WIDTHxHEIGHT instead of the scene's own");
  command->add_option("--out,-o", options->out, "image.exr, .png or .pfm")->required();
  command->footer("Example: volumark render sphere --method raycast --backend cpu --set step=0.5 --out sphere.png");
  command->callback(
      [&globals, &action, options] { action = [&globals, options] { return render(*options, globals); }; });
}

}  // namespace volumark::cli
