// Slices of 2D textures in pairs, both sides in one run: an iteration draws the frames A B B A and notes the ratio of
// their CPU times (all threads; on a machine at rest also wall time, `wall_ratio`). Reported: the median ratio A / B
// with its 95 % interval, and the milliseconds of both sides.
//   two against one texture a polygon, interpolated against stored slices, OSMesa against cpu at 100 and 400 %,
//   isosurfaces back to front against front to back with early depth rejection.
// bench_stacks [--benchmark_filter=...] [--benchmark_min_time=Nx]; environment: VM_BENCH_SCENE (cloud), VM_BENCH_SIDE
// (300).
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "harness/frame.h"
#include "harness/statistics.h"
#include "methods/method.h"
#include "scenes/scene_io.h"

namespace volumark {
namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

struct Side {
  std::string backend, method;
  Settings settings;
};
struct Pair {
  std::string name, scene;
  Side a, b;
};

std::string from_environment(const char* name, const char* fallback) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : fallback;
}

// Devices and scenes outlive all benchmarks: a driver is opened once.
Device& device_of(const std::string& backend) {
  static std::map<std::string, std::unique_ptr<Device>> devices;
  auto& device = devices[backend];
  if (!device) device = std::make_unique<Device>(make_device(backend));
  return *device;
}
const Scene& scene_of(const std::string& name) {
  static std::map<std::string, Scene> scenes;
  const auto found = scenes.find(name);
  return found != scenes.end() ? found->second
                               : scenes.emplace(name, load_scene(name, data_options_from_environment())).first->second;
}

const Method* method_of(const std::string& name) {
  for (const Method* method : method_list())
    if (method->info().name == name) return method;
  return nullptr;
}

std::unique_ptr<FrameSource> source_of(const Side& side, const Scene& scene, int size) {
  const Method* method = method_of(side.method);
  if (method == nullptr) throw std::runtime_error("no method " + side.method);
  Values values = default_values(method->info().parameters);
  for (const auto& [name, value] : side.settings) set_value(method->info().parameters, values, name, value);
  Device& device = device_of(side.backend);
  if (const auto why = unsupported_reason(*method, scene, values, device.info())) throw std::runtime_error(*why);
  return std::make_unique<FrameSource>(scene, *method, values, device, size, size);
}

double median_of(const std::vector<double>& logs) { return std::exp(stats_of(logs).median); }

void run_pair(benchmark::State& state, const Pair& pair) {
  try {
    const Scene& scene = scene_of(pair.scene);
    const int size = std::atoi(from_environment("VM_BENCH_SIDE", "300").c_str());
    const auto a = source_of(pair.a, scene, size), b = source_of(pair.b, scene, size);
    FrameSource* const order[] = {a.get(), b.get(), b.get(), a.get()};
    for (FrameSource* source : {a.get(), b.get()}) source->frame(scene.views.front());  // compiles, allocates
    std::vector<double> cpu, wall, ms[2];
    size_t view = 0;
    for (auto _ : state) {
      double seconds[2] = {0, 0}, walls[2] = {0, 0};
      for (FrameSource* source : order) {
        const Instant cost = source->frame(scene.views[view % scene.views.size()]).cost;
        const int side = source == a.get() ? 0 : 1;
        seconds[side] += cost.cpu / 2;
        walls[side] += cost.wall / 2;
      }
      ++view;
      cpu.push_back(std::log(seconds[0] / seconds[1]));
      wall.push_back(std::log(walls[0] / walls[1]));
      for (int side : {0, 1}) ms[side].push_back(1e3 * seconds[side]);
      state.SetIterationTime(2 * (walls[0] + walls[1]));
    }
    const Stats ratio = stats_of(cpu);
    state.counters["ratio"] = std::exp(ratio.median);
    state.counters["ratio_lo"] = std::exp(ratio.median_lo);
    state.counters["ratio_hi"] = std::exp(ratio.median_hi);
    state.counters["wall_ratio"] = median_of(wall);
    state.counters["a_cpu_ms"] = stats_of(ms[0]).median;
    state.counters["b_cpu_ms"] = stats_of(ms[1]).median;
  } catch (const std::exception& error) {
    state.SkipWithError(error.what());
  }
}

std::vector<Pair> pairs() {
  std::vector<Pair> out;
  const std::string scene = from_environment("VM_BENCH_SCENE", "cloud");
  for (const char* backend : {"gl", "vulkan", "cpu"}) {
    out.push_back({fmt::format("textures_1_over_2/{}", backend),
                   scene,
                   {backend, "slices2d", {{"textures_per_polygon", "1"}}},
                   {backend, "slices2d", {{"textures_per_polygon", "2"}}}});
    out.push_back({fmt::format("interpolated_over_stored/{}", backend),
                   scene,
                   {backend, "slices2d", {{"slices", "400"}}},
                   {backend, "slices2d", {{"slices", "400"}, {"interpolation", "false"}}}});
    out.push_back({fmt::format("iso_back_to_front_over_front_to_back/{}", backend),
                   "brain_iso",
                   {backend, "slices2d_iso", {{"order", "back_to_front"}}},
                   {backend, "slices2d_iso", {{"order", "front_to_back"}}}});
  }
  for (const char* slices : {"100", "400"})
    out.push_back({fmt::format("gl_over_cpu/{}_percent", slices),
                   scene,
                   {"gl", "slices2d", {{"slices", slices}}},
                   {"cpu", "slices2d", {{"slices", slices}}}});
  return out;
}

}  // namespace
}  // namespace volumark

int main(int argc, char** argv) {
  for (const volumark::Pair& pair : volumark::pairs())
    benchmark::RegisterBenchmark(pair.name.c_str(),
                                 [pair](benchmark::State& state) { volumark::run_pair(state, pair); })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
