// volumark render: one picture.
#include <fmt/format.h>

#include "harness/cli/commands.h"
#include "harness/frame.h"
#include "harness/image_io.h"
#include "harness/progress.h"
#include "methods/reference/reference.h"
#include "scenes/nearest.h"

namespace volumark::cli {
namespace {

struct RenderOptions {
  std::string scene, method, backend = "cpu", out, size;
  std::vector<std::string> set;
  int view = 0;
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
  write_image(options.out, reference.image, scene.background);
  fmt::print("{}: {}x{}, reference, {}; largest error bound {:.2e}{}\n", options.out, width, height,
             duration_text(since(start).wall), reference.max_bound, reference.estimate ? " (an estimate)" : "");
}

int render_with_method(const RenderOptions& options, const Scene& scene, int width, int height,
                       const Globals& globals) {
  const Method& method = find_method(options.method);
  Values values = default_values(method.info().parameters);
  for (const std::string& text : options.set) {
    const auto [name, value] = split_assignment(text);
    set_value(method.info().parameters, values, name, value);
  }
  const View& view = view_of(scene, options.view);
  Device device = open_backend(options.backend, globals);
  if (const auto reason = unsupported_reason(method, scene, values, device.info())) {
    fmt::print(stderr, "volumark: unsupported: {}\n", *reason);
    return kBadNews;
  }
  FrameSource source(scene, method, values, device, width, height);
  const FrameCost first = source.frame(view);
  write_image(options.out, source.read_back(), scene.background);
  fmt::print(
      "{}: {}x{}, {} on {} ({}): prepare {}, first frame {}, peak {:.1f} MiB on the device ({:.1f} MiB of voxels)\n",
      options.out, width, height, method.info().name, options.backend, device.info().renderer,
      duration_text(source.prepare_cost().cost.wall), duration_text(first.cost.wall),
      static_cast<double>(device.peak_bytes()) / 1048576, static_cast<double>(scene.volume->voxels.size()) / 1048576);
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
  command->add_option("--view", options->view, "index of the view")->capture_default_str();
  command->add_option("--size", options->size, "WIDTHxHEIGHT instead of the scene's own");
  command->add_option("--out,-o", options->out, "image.exr, .png or .pfm")->required();
  command->footer("Example: volumark render sphere --method raycast --backend cpu --set step=0.5 --out sphere.png");
  command->callback(
      [&globals, &action, options] { action = [&globals, options] { return render(*options, globals); }; });
}

}  // namespace volumark::cli
