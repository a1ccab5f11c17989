// The stated bound against an independent integrator, on rays and transfer functions chosen to be hard.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "methods/reference/reference.h"
#include "tests/unit/reference/brute_force.h"

namespace volumark::test {
namespace {

using Points = std::vector<TransferPoint>;

Points smooth() { return {{0.1, {0.1, 0.2, 0.9}, 0.05}, {0.5, {0.9, 0.5, 0.1}, 1.2}, {0.9, {0.2, 1.0, 0.3}, 0.4}}; }
Points narrow() { return {{0.49, {0, 0.3, 1}, 0}, {0.5, {1, 0.8, 0.2}, 30}, {0.51, {0.9, 0, 0.1}, 0}}; }
Points step() { return {{0.35, {1, 0, 0}, 0}, {0.35, {1, 0.5, 0}, 1.5}, {0.7, {0, 1, 0.5}, 0.5}, {0.7, {0, 0, 1}, 3}}; }
Points opaque() {  // 50 a voxel, the colour changing fast
  return {{0.2, {0, 0, 1}, 0}, {0.4, {0, 1, 0}, 50}, {0.6, {1, 0, 0}, 10}, {1.0, {1, 1, 1}, 50}};
}

// Rays in the index space of a volume of n cells an axis, spacing 1 and origin 0. Those along faces, edges and vertices
// keep off the outer ones, unless asked.
Ray random_ray(const glm::dvec3& n, int kind, std::mt19937_64& random, bool outer = false) {
  std::uniform_real_distribution<double> uniform(0, 1);
  auto inside = [&] { return n * glm::dvec3(uniform(random), uniform(random), uniform(random)); };
  auto on_plane = [&](const glm::dvec3& p) {
    return outer ? glm::round(p) : glm::clamp(glm::round(p), glm::dvec3(1), n - 1.0);
  };
  auto whole = [&] { return on_plane(inside()); };
  const int axis = static_cast<int>(random() % 3);
  glm::dvec3 target = inside(), direction(0);
  switch (kind) {
    case 0:  // anything
      direction = glm::normalize(inside() - target + 1e-3);
      break;
    case 1:  // along an axis
      direction[axis] = random() % 2 ? 1 : -1;
      break;
    case 2:  // in the face between two cells
      direction = glm::normalize(inside() - target + 1e-3);
      target[axis] = on_plane(target)[axis];
      direction[axis] = 0;
      direction = glm::normalize(direction);
      break;
    case 3:  // along an edge of cells
      target = whole();
      direction[axis] = random() % 2 ? 1 : -1;
      break;
    case 4: {  // through two vertices
      target = whole();
      const glm::dvec3 other = whole();
      direction = other == target ? glm::dvec3(0, 0, 1) : glm::normalize(other - target);
      break;
    }
    default:  // grazing a face at a tiny angle
      direction[(axis + 1) % 3] = 1;
      direction[axis] = 1e-7 * uniform(random);
      target[axis] = on_plane(target)[axis];
      direction = glm::normalize(direction);
  }
  return {target - 20.0 * direction, direction, 0};
}

struct Tally {
  int rays = 0, violations = 0;
  double worst_ratio = 0, worst_error = 0;
  std::vector<double> bounds;
};

void check_ray(const Scene& scene, const Ray& ray, double tolerance, Tally& tally) {
  const RayIntegral integral = integrate_ray(scene, View{}, ray, tolerance);
  const auto truth = brute_force(scene, ray);
  double error = 0;
  for (size_t c = 0; c < 4; ++c)
    error = std::max(error, static_cast<double>(std::abs(static_cast<long double>(integral.rgba[c]) - truth[c])));
  ++tally.rays;
  // The independent integrator's own error: it rounds data values to double for the transfer function.
  const double allowed = integral.bound + 2e-14;
  if (!(error <= allowed)) {
    ++tally.violations;
    if (tally.violations <= 3)
      ADD_FAILURE() << "error " << error << " over bound " << integral.bound << " on the ray from " << ray.origin.x
                    << ", " << ray.origin.y << ", " << ray.origin.z << " towards " << ray.direction.x << ", "
                    << ray.direction.y << ", " << ray.direction.z;
  }
  tally.worst_ratio = std::max(tally.worst_ratio, error / allowed);
  tally.worst_error = std::max(tally.worst_error, error);
  tally.bounds.push_back(integral.bound);
}

struct Case {
  const char* name;
  Points (*points)();
  bool jumps;
};

class Bound : public ::testing::TestWithParam<Case> {};

// Rays within an outer face of the box: rounding decides between all and nothing, and the bound must know.
TEST_P(Bound, HoldsInOuterFaces) {
  std::mt19937_64 random(8);
  Tally tally;
  const Scene scene = scene_of(random_volume({3, 4, 3}, VoxelType::F32, random), GetParam().points());
  for (int i = 0; i < 200; ++i) check_ray(scene, random_ray({2, 3, 2}, 2 + i % 4, random, true), 1e-9, tally);
  EXPECT_EQ(tally.violations, 0);
}

TEST_P(Bound, HoldsOnEveryRay) {
  std::mt19937_64 random(7);
  const double tolerance = 1e-9;
  Tally tally;
  for (const VoxelType type : {VoxelType::F32, VoxelType::U8}) {
    const Scene scene = scene_of(random_volume({6, 5, 7}, type, random), GetParam().points());
    for (int i = 0; i < 300; ++i) check_ray(scene, random_ray({5, 4, 6}, i % 6, random), tolerance, tally);
  }
  EXPECT_EQ(tally.violations, 0) << "of " << tally.rays;
  std::sort(tally.bounds.begin(), tally.bounds.end());
  const size_t n = tally.bounds.size();
  std::printf("%s: %d rays, worst error %.2e, worst error/bound %.2g, bound median %.2e p95 %.2e max %.2e\n",
              GetParam().name, tally.rays, tally.worst_error, tally.worst_ratio, tally.bounds[n / 2],
              tally.bounds[n * 95 / 100], tally.bounds.back());
  // A bound must also say something. A jump may be touched by a whole edge or a tangent; nothing else may spoil it.
  EXPECT_LT(tally.bounds[n * 8 / 10], tolerance);
  if (!GetParam().jumps) {
    EXPECT_LT(tally.bounds.back(), 20 * tolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(TransferFunctions, Bound,
                         ::testing::Values(Case{"smooth", smooth, false}, Case{"narrow", narrow, false},
                                           Case{"step", step, true}, Case{"opaque", opaque, false}),
                         [](const auto& test) { return test.param.name; });

TEST(BoundOfTransformed, HoldsForRotatedAnisotropicReflectedVolumes) {
  std::mt19937_64 random(11);
  Volume volume = random_volume({4, 6, 5}, VoxelType::U16, random);
  volume.spacing = {0.7, 1.3, 2.1};
  volume.origin = {-310.5, 42.25, 17.125};
  const glm::dvec3 x = glm::normalize(glm::dvec3(2, 1, -0.5)), y = glm::normalize(glm::cross(x, glm::dvec3(0.3, 1, 2)));
  volume.axes = glm::dmat3(x, y, -glm::cross(x, y));
  for (const Points& points : {smooth(), narrow(), step()}) {
    Scene scene = scene_of(volume, points);
    scene.effects.clip_planes.push_back({glm::normalize(glm::dvec3(1, 2, 3)), -100});
    scene.effects.clip_planes.push_back({x, glm::dot(x, volume.origin) + 0.4});
    Tally tally;
    for (int i = 0; i < 400; ++i) {
      Ray ray = random_ray({3, 5, 4}, i % 6, random, i % 5 == 0);
      auto to_world = [&](const glm::dvec3& v) { return volume.axes * (volume.spacing * v); };
      ray.origin = volume.origin + to_world(ray.origin);
      ray.direction = glm::normalize(to_world(ray.direction));
      ray.t_near = i % 4 == 0 ? 24 : 0;
      check_ray(scene, ray, 1e-9, tally);
    }
    EXPECT_EQ(tally.violations, 0);
  }
}

// A step seen by rays that pass the iso-surface of a saddle and of a ball at tiny distances.
TEST(BoundAtTangents, HoldsForAStepTangentToTheRay) {
  Volume volume = distance_volume(9, 1);
  const Scene scene = scene_of(volume, {{0.6, {1, 1, 1}, 40}, {0.6, {0, 0, 0}, 0}});
  Tally tally;
  for (int i = 0; i < 60; ++i) {
    const double offset = std::pow(10.0, -i / 4.0);
    for (const double sign : {-1.0, 1.0}) {
      // Along x through grid nodes the interpolated distance at y = 0.6 is found on the edge between two nodes.
      const double y = 0.6 + sign * offset;
      check_ray(scene, {{-3, y, 0}, {1, 0, 0}, 0}, 1e-9, tally);
      check_ray(scene, {{-3, y, 0.03}, {1, 0, 0}, 0}, 1e-9, tally);
    }
  }
  EXPECT_EQ(tally.violations, 0);
}

TEST(Bound, TighterToleranceTightensIt) {
  std::mt19937_64 random(3);
  const Scene scene = scene_of(random_volume(glm::ivec3(8), VoxelType::F32, random), smooth());
  const Ray ray = ray_between({-5, -4, -3}, {4, 3.5, 3});
  double last = 1;
  for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const double bound = integrate_ray(scene, View{}, ray, tolerance).bound;
    EXPECT_LE(bound, tolerance + 1e-12);
    EXPECT_LT(bound, last);
    last = bound;
  }
}

}  // namespace
}  // namespace volumark::test
