// volumark bench: frames under Google Benchmark, with its flags and its JSON. Each configuration draws in a process of
// its own, and repetitions are interleaved at random. Manual time is the frame's wall time; cpu_ms is the CPU time of
// all its threads.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "harness/cli/bench_worker.h"
#include "harness/cli/commands.h"
#include "methods/reference/reference.h"

namespace volumark::cli {
namespace {

struct FrameCase {
  std::string name, scene, method, backend;
  std::vector<std::string> set;
  int threads = 1, width = 512, height = 512, view = 0;
};

// 256 slices through a 256^3 float volume, seen along an axis.
constexpr const char* kSliceScene = R"({
  "volumark_scene": 1,
  "title": "Benchmark: 256^3 float, seen along z",
  "volume": {"generator": {"kind": "marschner_lobb", "size": 256, "type": "f32", "frequency": 6, "alpha": 0.25}},
  "transfer": {"per": 0.03, "points": [{"value": 0, "colour": [0.1, 0.3, 0.9], "opacity": 0.001},
                                       {"value": 1, "colour": [1, 0.7, 0.3], "opacity": 0.02}], "window": [0, 1]},
  "views": [{"orbit": {"count": 1, "azimuth": 0, "elevation": 0, "distance": 4, "half_height": 1, "units": "world",
                       "target": [0, 0, 0]}}]
})";

Scene bench_scene(const std::string& name, const DataOptions& data) {
  Scene scene = name == "slices256" ? parse_scene(kSliceScene, "slices256.json") : load_scene(name);
  load_data(scene, data);
  return scene;
}

// Everything that one configuration holds, in its own process.
struct Configuration {
  Scene scene;
  Values values;
  std::unique_ptr<Device> device;
  std::unique_ptr<FrameSource> source;
};

BenchSetup frame_setup(const FrameCase& what, const Globals& globals) {
  return [what, &globals]() -> std::function<BenchFrame()> {
    auto held = std::make_shared<Configuration>();
    held->scene = bench_scene(what.scene, globals.data_options());
    const Method& method = find_method(what.method);
    held->values = default_values(method.info().parameters);
    for (const std::string& text : what.set) {
      const auto [name, value] = split_assignment(text);
      set_value(method.info().parameters, held->values, name, value);
    }
    DeviceOptions device = globals.device;
    device.threads = what.threads;
    held->device = std::make_unique<Device>(make_device(what.backend, device));
    if (const auto reason = unsupported_reason(method, held->scene, held->values, held->device->info()))
      throw std::runtime_error(*reason);
    held->source =
        std::make_unique<FrameSource>(held->scene, method, held->values, *held->device, what.width, what.height);
    const View view = held->scene.views.at(static_cast<size_t>(what.view));
    held->source->frame(view);  // compiles
    return [held, view] {
      const Instant cost = held->source->frame(view).cost;
      return BenchFrame{cost.wall, cost.cpu};
    };
  };
}

BenchSetup reference_setup(const std::string& scene_name, int threads, const Globals& globals) {
  return [scene_name, threads, &globals]() -> std::function<BenchFrame()> {
    auto scene = std::make_shared<Scene>(bench_scene(scene_name, globals.data_options()));
    return [scene, threads] {
      ReferenceOptions options;
      options.threads = threads;
      const Instant start = now();
      benchmark::DoNotOptimize(render_reference(*scene, scene->views.front(), 512, 512, options).max_bound);
      const Instant cost = since(start);
      return BenchFrame{cost.wall, cost.cpu};
    };
  };
}

// A frame in which the method records nothing and the backend draws nothing: what is left is the harness' own.
class EmptyMethod : public Method {
 public:
  const MethodInfo& info() const override {
    static const MethodInfo info{"empty", "records nothing", "", {}, {}, nullptr};
    return info;
  }
  std::optional<std::string> unsupported(const Scene&, const Values&, const BackendInfo&) const override { return {}; }
  std::unique_ptr<PreparedMethod> prepare(const Scene&, const Values&, Device&) const override {
    class Prepared : public PreparedMethod {
      void render(const View&, Device&, Texture) override {}
      Counters counters() const override { return {}; }
    };
    return std::make_unique<Prepared>();
  }
  Format target_format(const Values&) const override { return Format::RGBA32F; }
};

BenchSetup empty_setup(const Globals& globals) {
  return [&globals]() -> std::function<BenchFrame()> {
    static const EmptyMethod method;
    auto held = std::make_shared<Configuration>();
    held->device = std::make_unique<Device>(make_device("null", globals.device));
    held->source = std::make_unique<FrameSource>(held->scene, method, held->values, *held->device, 512, 512);
    return [held] {
      const Instant cost = held->source->frame(View{}).cost;
      return BenchFrame{cost.wall, cost.cpu};
    };
  };
}

void register_case(const std::string& name, BenchSetup setup, int threads) {
  auto worker = std::make_shared<BenchWorker>();
  benchmark::RegisterBenchmark(name.c_str(),
                               [worker, setup = std::move(setup), threads](benchmark::State& state) {
                                 double cpu = 0;
                                 for (auto _ : state) {
                                   try {
                                     const BenchFrame frame = worker->frame(setup, threads);
                                     state.SetIterationTime(frame.wall);
                                     cpu += frame.cpu;
                                   } catch (const std::exception& error) {
                                     state.SkipWithError(error.what());
                                     break;
                                   }
                                 }
                                 state.counters["cpu_ms"] =
                                     benchmark::Counter(cpu * 1e3, benchmark::Counter::kAvgIterations);
                               })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

void register_all(const Globals& globals) {
  const std::vector<int> thread_counts =
      globals.device.threads > 0 ? std::vector<int>{globals.device.threads} : std::vector<int>{1, 2};
  for (const int threads : thread_counts) {
    const std::string suffix = fmt::format("/threads:{}", threads);
    for (const char* backend : {"cpu", "gl", "vulkan"}) {
      FrameCase slices{"", "slices256", "texture3d_slices", backend, {"step=1"}, threads, 512, 512, 0};
      register_case(fmt::format("texture3d_slices/float256^3/256_slices/512x512/{}{}", backend, suffix),
                    frame_setup(slices, globals), threads);
      for (const char* scene : {"marschner_lobb", "cloud"}) {
        FrameCase raycast{"", scene, "raycast", backend, {}, threads, 512, 512, 0};
        register_case(fmt::format("raycast/{}/512x512/{}{}", scene, backend, suffix), frame_setup(raycast, globals),
                      threads);
      }
    }
    for (const char* scene : {"marschner_lobb", "cloud"})
      register_case(fmt::format("reference/{}/512x512{}", scene, suffix), reference_setup(scene, threads, globals),
                    threads);
  }
  FrameCase host{"", "sphere", "texture3d_slices", "null", {}, 1, 512, 512, 0};
  register_case("host_side/texture3d_slices/sphere/null", frame_setup(host, globals), 1);
  register_case("harness_overhead/empty_frame/null", empty_setup(globals), 1);
}

int bench(const std::vector<std::string>& flags, const Globals& globals) {
  // Ours first, so that the user's win.
  std::vector<std::string> arguments = {"volumark bench", "--benchmark_enable_random_interleaving=true",
                                        "--benchmark_min_time=0.3"};
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  int argc = static_cast<int>(arguments.size());
  benchmark::Initialize(&argc, argv.data());
  if (argc > 1) throw UsageError(fmt::format("bench: unknown flag {}; see volumark bench --help", argv[1]));
  register_all(globals);
  const size_t run = benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  if (run == 0) throw UsageError("bench: the filter matches no benchmark; see --benchmark_list_tests");
  return kOk;
}

}  // namespace

void add_bench(CLI::App& app, const Globals& globals, Action& action) {
  CLI::App* command = app.add_subcommand("bench", "Frame benchmarks under Google Benchmark, with all its flags");
  command->allow_extras()->fallthrough(false);  // everything after `bench` goes on to Google Benchmark
  command->footer(
      "Flags: --benchmark_list_tests, --benchmark_filter=REGEX, --benchmark_repetitions=N,\n"
      "--benchmark_min_time=SECONDS, --benchmark_out=FILE, --benchmark_out_format=json|csv, ...\n"
      "Common options (--threads, --data, --vk-device ...) go before `bench`.\n"
      "Example: volumark bench --benchmark_filter=texture3d_slices --benchmark_out=slices.json");
  command->callback([&globals, &action, command] {
    const std::vector<std::string> flags = command->remaining();
    action = [&globals, flags] { return bench(flags, globals); };
  });
}

}  // namespace volumark::cli
