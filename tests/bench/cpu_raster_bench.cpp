// Fragments a second of the texture3d_slices method: float 256^3, 512 x 512, 256 slices that fill the screen, blended
// into a float target; the cpu backend with 1 and 2 threads, and gl (OSMesa) in the same run with the same program.
// Compare at equal threads: LP_NUM_THREADS=1 for gl's one-thread figure.
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>

#include "methods/texture3d_slices/slice_geometry.h"
#include "methods/texture3d_slices/texture3d_slices.h"
#include "methods/volume/volume_uniforms.h"
#include "scenes/procedural.h"

namespace volumark {
namespace {

constexpr int kVoxels = 256, kSlices = 256, kPixels = 512;

// Nested shells on a ramp, cheap to compute; seen from a corner, so that no slice is along an axis.
const Scene& bench_scene(VoxelType type) {
  static std::map<VoxelType, Scene> scenes;
  Scene& scene = scenes[type];
  if (scene.volume) return scene;
  ProceduralSpec spec;
  spec.field = MarschnerLobbField{};
  spec.size = glm::ivec3(kVoxels);
  spec.type = type;
  scene.volume = std::make_shared<const Volume>(make_volume(spec));
  scene.name = "bench";
  scene.transfer.lo = 0;
  scene.transfer.hi = 1;
  scene.transfer.points = {
      {0, {0.2, 0.3, 1}, 0}, {0.4, {0.2, 1, 0.4}, 0.1}, {0.6, {1, 0.8, 0.2}, 1}, {1, {1, 0.2, 0.1}, 2}};
  View view;
  view.eye = glm::dvec3(0.55, 0.4, 0.8);
  view.eye *= 3.0 / glm::length(view.eye);
  view.perspective = true;
  view.fov_y = 0.3;
  view.near = 0.1;
  scene.views = {view};
  scene.width = scene.height = kPixels;
  return scene;
}

// Area of the slices on the screen in pixels: how many fragments there are, but for the polygons' edges.
double fragment_count(const Scene& scene, double step_in_voxels) {
  const glm::dvec3 extent = scene.volume->extent();
  const ViewRays rays = view_rays(*scene.volume, scene.views[0], kPixels, kPixels);
  const Body body = visible_body(extent, rays, {});
  SliceMesh mesh;
  build_slices(body, rays, slabs_of(body, step_in_voxels * scene.volume->spacing.x), true, false, mesh);
  double area = 0;
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const SliceVertex &a = mesh.vertices[mesh.indices[i]], &b = mesh.vertices[mesh.indices[i + 1]],
                      &c = mesh.vertices[mesh.indices[i + 2]];
    area += std::abs((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y)) / 2;
  }
  return area * kPixels * kPixels / 4;
}

double step_for_slices(const Scene& scene) {
  const ViewRays rays = view_rays(*scene.volume, scene.views[0], kPixels, kPixels);
  const Body body = visible_body(scene.volume->extent(), rays, {});
  return (body.z_last - body.z_first) / kSlices / scene.volume->spacing.x;
}

void slices(benchmark::State& state, const char* backend, int threads, VoxelType type, const char* order,
            const char* classification) {
  const Scene& scene = bench_scene(type);
  DeviceOptions options;
  options.threads = threads;
  Device device = make_device(backend, options);
  const Method& method = texture3d_slices();
  Values values = default_values(method.info().parameters);
  const double step = step_for_slices(scene);
  values.insert_or_assign("step", Value(step));
  values.insert_or_assign("order", Value(std::string(order)));
  values.insert_or_assign("classification", Value(std::string(classification)));
  const auto prepared = method.prepare(scene, values, device);
  TextureDesc desc;
  desc.label = "target";
  desc.width = desc.height = kPixels;
  desc.target = true;
  const Texture target = device.create_texture(desc);
  for (auto _ : state) {
    prepared->render(scene.views[0], device, target);
    benchmark::DoNotOptimize(device.submit_and_wait());
  }
  const double fragments = fragment_count(scene, step);
  state.counters["fragments"] = fragments;
  state.counters["fragments/s"] = benchmark::Counter(fragments, benchmark::Counter::kIsIterationInvariantRate);
}

void add(const char* name, const char* backend, int threads, VoxelType type, const char* order,
         const char* classification) {
  benchmark::RegisterBenchmark(name, slices, backend, threads, type, order, classification)
      ->UseRealTime()
      ->MeasureProcessCPUTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace volumark

int main(int argc, char** argv) {
  using volumark::VoxelType;
  volumark::add("slices/f32/cpu/threads:1", "cpu", 1, VoxelType::F32, "back_to_front", "post");
  volumark::add("slices/f32/cpu/threads:2", "cpu", 2, VoxelType::F32, "back_to_front", "post");
  volumark::add("slices/f32/gl", "gl", 0, VoxelType::F32, "back_to_front", "post");
  volumark::add("slices_under/f32/cpu/threads:1", "cpu", 1, VoxelType::F32, "front_to_back", "post");
  volumark::add("slices_preintegrated/f32/cpu/threads:1", "cpu", 1, VoxelType::F32, "back_to_front", "preintegrated");
  volumark::add("slices/u8/cpu/threads:1", "cpu", 1, VoxelType::U8, "back_to_front", "post");
  volumark::add("slices/u16/cpu/threads:1", "cpu", 1, VoxelType::U16, "back_to_front", "post");
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
