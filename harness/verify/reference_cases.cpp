// The reference against an integrator that shares nothing with it: its stated bound must hold on rays chosen to be
// hard.
#include <fmt/format.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "harness/verify/brute_force.h"
#include "harness/verify/cases.h"
#include "harness/verify/test_scenes.h"
#include "methods/reference/reference.h"

namespace volumark::hard_cases {
namespace {

// The worst of many rays, as share of what each may be off.
class WorstRay {
 public:
  explicit WorstRay(const Scene& scene) : scene_(scene) {}

  void try_ray(const Ray& ray) {
    const RayIntegral integral = integrate_ray(scene_, View{}, ray, 1e-9);
    const auto truth = brute::brute_force(scene_, ray);
    ++rays_;
    for (size_t channel = 0; channel < 4; ++channel) {
      const double expected = static_cast<double>(truth[channel]);
      const double error = std::abs(integral.rgba[channel] - expected);
      // 2e-14: the integrator rounds data values to double for the transfer function.
      const double allowed = integral.bound + 2e-14;
      // A ray that is not finite stays the worst.
      const double share = std::isfinite(error / allowed) ? error / allowed : std::numeric_limits<double>::infinity();
      if (share > share_) {
        share_ = share;
        worst_ = {
            .check = "", .expected = expected, .measured = integral.rgba[channel], .bound = allowed, .source = ""};
      }
    }
  }
  void add_to(CaseRun& run, const std::string& name) {
    worst_.check = fmt::format("{}: worst of {} rays", name, rays_);
    worst_.source = "the reference's own bound of that ray";
    run.add(worst_);
  }

 private:
  const Scene& scene_;
  int rays_ = 0;
  double share_ = -1;
  Check worst_;
};

using Random = std::mt19937_64;

// Rays in the index space of n cells an axis: anything, along an axis, in a face between cells, along an edge of cells,
// through two vertices, grazing a face.
Ray hard_ray(const glm::dvec3& n, int kind, Random& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto inside = [&] { return n * glm::dvec3(uniform(random), uniform(random), uniform(random)); };
  const auto on_vertex = [&] { return glm::clamp(glm::round(inside()), glm::dvec3(1), n - 1.0); };
  const int axis = static_cast<int>(random() % 3);
  glm::dvec3 target = inside(), direction(0);
  direction[axis] = random() % 2 == 0 ? 1 : -1;
  if (kind == 0) direction = inside() - target + 1e-3;
  if (kind == 2) {
    direction = inside() - target + 1e-3;
    target[axis] = on_vertex()[axis];
    direction[axis] = 0;
  }
  if (kind == 3) target = on_vertex();
  if (kind == 4) {
    target = on_vertex();
    const glm::dvec3 other = on_vertex();
    if (other != target) direction = other - target;
  }
  if (kind == 5) {
    target[axis] = on_vertex()[axis];
    direction = glm::dvec3(0);
    direction[(axis + 1) % 3] = 1;
    direction[axis] = 1e-7 * uniform(random);
  }
  direction = glm::normalize(direction);
  return {target - 20.0 * direction, direction, 0};
}

Volume levels_volume(const glm::ivec3& size, int levels, Random& random) {
  std::vector<float> values(static_cast<size_t>(size.x) * static_cast<size_t>(size.y) * static_cast<size_t>(size.z));
  for (float& value : values) value = static_cast<float>(random() % static_cast<unsigned>(levels));
  Volume volume = volume_of(values, size, glm::dvec3(1));
  volume.origin = glm::dvec3(0);
  return volume;
}

}  // namespace

void reference_on_levels(CaseRun& run) {
  // The jump lies exactly on a level of the data, so that whole edges and faces of cells lie on it, and rays run along
  // them; the value at a jump is the second point's.
  Random random(23);
  const glm::ivec3 size(6, 5, 7);
  const glm::dvec3 cells(5, 4, 6);
  const char* const kinds[] = {"any", "along an axis", "in faces", "along edges", "through vertices", "grazing faces"};
  for (int kind = 0; kind < 6; ++kind) {
    const Scene scene = scene_of(levels_volume(size, 3, random),
                                 transfer_of({{1, {1, 0.5, 0}, 0}, {1, {0, 0.5, 1}, 0.9}, {2, {1, 1, 1}, 0.4}}, 0, 2));
    WorstRay worst(scene);
    for (int i = 0; i < 60; ++i) worst.try_ray(hard_ray(cells, kind, random));
    worst.add_to(run, fmt::format("a jump on a level of the data, rays {}", kinds[kind]));
  }
}

void reference_bound(CaseRun& run) {
  Random random(7);
  const glm::ivec3 size(6, 5, 7);
  const struct {
    const char* name;
    std::vector<TransferPoint> points;
  } transfers[] = {
      {"extinction 50 a voxel", {{0.2, {0, 0, 1}, 0}, {0.4, {0, 1, 0}, 50}, {0.6, {1, 0, 0}, 10}, {1, {1, 1, 1}, 50}}},
      {"narrow peak", {{0.49, {0, 0.3, 1}, 0}, {0.5, {1, 0.8, 0.2}, 30}, {0.51, {0.9, 0, 0.1}, 0}}},
      {"two steps", {{0.35, {1, 0, 0}, 0}, {0.35, {1, 0.5, 0}, 1.5}, {0.7, {0, 1, 0.5}, 0.5}, {0.7, {0, 0, 1}, 3}}},
  };
  for (const auto& [name, points] : transfers) {
    Scene scene = scene_of(brute::random_volume(size, VoxelType::F32, random), transfer_of(points));
    WorstRay worst(scene);
    for (int i = 0; i < 180; ++i) worst.try_ray(hard_ray({5, 4, 6}, i % 6, random));
    worst.add_to(run, name);
  }
  // A step of extinction 40 whose surface rays pass at 1 down to 1e-15.
  const Scene ball =
      scene_of(brute::distance_volume(9, 1), transfer_of({{0.6, glm::dvec3(1), 40}, {0.6, glm::dvec3(0), 0}}));
  WorstRay worst(ball);
  for (int i = 0; i < 60; ++i)
    for (const double sign : {-1., 1.})
      for (const double z : {0., 0.03}) worst.try_ray({{-3, 0.6 + sign * std::pow(10., -i / 4.), z}, {1, 0, 0}, 0});
  worst.add_to(run, "a step tangent to the ray, extinction 40");
}

}  // namespace volumark::hard_cases
