// Isosurfaces and slice planes: closed forms, and a march in long double that shares no code with the reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>

#include "methods/reference/reference.h"
#include "tests/unit/reference/brute_force.h"

namespace volumark::test {
namespace {

using Real = long double;

Scene surface_of(Volume volume, double value, const glm::dvec3& colour = {0.8, 0.5, 0.25}) {
  Scene scene = scene_of(std::move(volume), {{0, {1, 1, 1}, 1}});
  scene.display = Display::Isosurface;
  scene.isosurface = {value, colour, colour};
  return scene;
}

RayIntegral cast(const Scene& scene, const glm::dvec3& origin, const glm::dvec3& direction, double t_near = 0) {
  return integrate_ray(scene, View{}, {origin, glm::normalize(direction), t_near});
}

Real field(const Volume& volume, const Ray& ray, Real t) {
  Real index[3];
  for (int a = 0; a < 3; ++a) {
    index[a] = (static_cast<Real>(ray.origin[a]) + t * static_cast<Real>(ray.direction[a]) -
                static_cast<Real>(volume.origin[a])) /
               static_cast<Real>(volume.spacing[a]);
    index[a] = std::clamp(index[a], Real(0), static_cast<Real>(volume.size[a] - 1));
  }
  const int i = static_cast<int>(index[0]), j = static_cast<int>(index[1]), k = static_cast<int>(index[2]);
  Real sum = 0;
  for (int c = 0; c < 8; ++c) {
    const int d[3] = {c & 1, (c >> 1) & 1, c >> 2};
    Real weight = 1;
    const Real f[3] = {index[0] - i, index[1] - j, index[2] - k};
    for (int a = 0; a < 3; ++a) weight *= d[a] != 0 ? f[a] : 1 - f[a];
    sum += weight * static_cast<Real>(volume.at(i + d[0], j + d[1], k + d[2]));
  }
  return sum;
}

// First t in [t0, t1] where the field reaches the value: a march of many steps, refined by bisection; < 0: none. Misses
// double roots closer than a step: `closest` tells how far below the value the field stayed.
Real march(const Volume& volume, const Ray& ray, Real value, Real t0, Real t1, int steps, Real& closest) {
  closest = 1e30L;
  Real before = t0;
  for (int i = 0; i <= steps; ++i) {
    const Real t = t0 + (t1 - t0) * i / steps, s = field(volume, ray, t);
    if (s >= value) {
      if (i == 0) return t;
      Real a = before, b = t;
      for (int k = 0; k < 80; ++k) {
        const Real middle = (a + b) / 2;
        (field(volume, ray, middle) >= value ? b : a) = middle;
      }
      return b;
    }
    closest = std::min(closest, value - s);
    before = t;
  }
  return -1;
}

// Where the ray is in the volume's box.
bool box_span(const Volume& volume, const Ray& ray, Real& t0, Real& t1) {
  t0 = ray.t_near;
  t1 = 1e30L;
  const glm::dvec3 extent = volume.extent();
  for (int a = 0; a < 3; ++a) {
    const Real o = static_cast<Real>(ray.origin[a] - volume.origin[a]), d = ray.direction[a];
    const Real u = -o / d, v = (static_cast<Real>(extent[a]) - o) / d;
    t0 = std::max(t0, std::min(u, v));
    t1 = std::min(t1, std::max(u, v));
  }
  return t0 < t1;
}

TEST(Isosurface, TheFirstPointIsThatOfABruteForceMarch) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  int hits = 0, misses = 0;
  for (const VoxelType type : {VoxelType::U8, VoxelType::F32}) {
    const Volume volume = random_volume({6, 5, 7}, type, random);
    const glm::dvec3 extent = volume.extent();
    for (int i = 0; i < 400; ++i) {
      const Scene scene = surface_of(volume, 0.5 + 0.5 * uniform(random));
      const glm::dvec3 at = extent * glm::dvec3(uniform(random), uniform(random), uniform(random));
      const glm::dvec3 way(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5);
      const Ray ray{at - 20. * glm::normalize(way), glm::normalize(way), 0};
      Real t0 = 0, t1 = 0, closest = 0;
      if (!box_span(volume, ray, t0, t1)) continue;
      const Real expected = march(volume, ray, scene.isosurface->value, t0, t1, 4000, closest);
      const RayIntegral got = integrate_ray(scene, View{}, ray);
      if (expected < 0) {
        if (closest < 1e-6L) continue;  // a double root between two steps
        EXPECT_EQ(got.rgba[3], 0);
        ++misses;
      } else {
        ASSERT_TRUE(got.distance);
        // Earlier only by a double root that the march stepped over.
        if (static_cast<Real>(*got.distance) < expected - 1e-9L) {
          const Real s = field(volume, ray, *got.distance);
          EXPECT_NEAR(static_cast<double>(s), scene.isosurface->value, 1e-12);
        } else {
          EXPECT_NEAR(*got.distance, static_cast<double>(expected), 1e-10);
        }
        EXPECT_EQ(got.rgba[0], 0.8);
        EXPECT_LT(got.bound, 1e-12);
        ++hits;
      }
    }
  }
  EXPECT_GT(hits, 300);
  EXPECT_GT(misses, 20);
}

// An isovalue on a level of the data, rays along edges of the grid and through its vertices: the field is followed
// from cell to cell, so none slips through.
TEST(Isosurface, RaysAlongEdgesAndThroughVerticesOnADataLevelHit) {
  constexpr int n = 6;
  std::mt19937_64 random(3);
  Volume volume = random_volume({n, n, n}, VoxelType::U8, random);
  volume.slope = 1;
  for (std::byte& voxel : volume.voxels) voxel = static_cast<std::byte>(static_cast<int>(voxel) % 4);
  volume.max_value = 3;
  const Scene scene = surface_of(volume, 2);
  int rays = 0;
  for (int a = 0; a < 3; ++a) {
    for (int j = 1; j < n - 1; ++j) {
      for (int k = 1; k < n - 1; ++k) {
        glm::dvec3 from(0), way(0);
        from[(a + 1) % 3] = j;
        from[(a + 2) % 3] = k;
        from[a] = -5;
        way[a] = 1;
        double expected = -1, last = 0;
        for (int i = 0; i < n; ++i) {
          glm::ivec3 at(from);
          at[a] = i;
          const double s = volume.at(at.x, at.y, at.z);
          if (s >= 2) {
            expected = 5 + (i == 0 ? 0 : i - (s - 2) / (s - last));
            break;
          }
          last = s;
        }
        const RayIntegral got = cast(scene, from, way);
        ++rays;
        if (expected < 0) {
          EXPECT_EQ(got.rgba[3], 0);
          continue;
        }
        ASSERT_TRUE(got.distance) << a << " " << j << " " << k;
        EXPECT_NEAR(*got.distance, expected, 1e-12);
      }
    }
  }
  // Diagonals through the vertices: at each of them the field is that vertex's, and where it reaches the value the ray
  // stops there at the latest.
  for (int j = 0; j < n; ++j) {
    const RayIntegral got = cast(scene, glm::dvec3(0, j, 0) - glm::dvec3(1), glm::dvec3(1));
    for (int i = 0; i + j < n; ++i) {
      if (volume.at(i, i + j, i) < 2) continue;
      ASSERT_TRUE(got.distance) << j;
      EXPECT_LE(*got.distance, (i + 1) * std::sqrt(3.0) + 1e-12);
      break;
    }
  }
  EXPECT_EQ(rays, 48);
}

// A tent whose ridge has just the value: a double root in every ray. It counts as reached, and where the ridge lies
// within rounding of the value the bound says that hit or miss cannot be told.
TEST(Isosurface, DoubleRootsCountAndAreMarked) {
  Volume volume = constant_volume({5, 3, 3}, 0);
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j) {
      const float ridge = 1;
      std::memcpy(volume.voxels.data() + 4 * ((k * 3 + j) * 5 + 2), &ridge, 4);
    }
  volume.max_value = 1;
  const Scene scene = surface_of(volume, 1);
  for (const double slant : {0.0, 0.1, 0.37}) {
    const RayIntegral got = cast(scene, {-1, 0.7, 0.4}, {1, slant, slant / 3});
    ASSERT_TRUE(got.distance) << slant;
    EXPECT_NEAR(*got.distance, 3 * std::sqrt(1 + slant * slant * 10 / 9), 1e-10);
    EXPECT_EQ(got.bound, 1);
  }
  const RayIntegral below = cast(surface_of(volume, 1 - 1e-9), {-1, 0.7, 0.4}, {1, 0.1, 0});
  EXPECT_EQ(below.rgba[3], 1);
  EXPECT_LT(below.bound, 1e-12);
  const RayIntegral above = cast(surface_of(volume, 1 + 1e-9), {-1, 0.7, 0.4}, {1, 0.1, 0});
  EXPECT_EQ(above.rgba[3], 0);
  EXPECT_EQ(above.bound, 0);
}

// A distance volume: the interpolated distance errs on one side only, by h^2 / (4 r) at most in the middle of a cell's
// edge, and so does the surface.
TEST(Isosurface, ASphereIsWithinTheErrorOfInterpolation) {
  for (const int n : {17, 33, 65}) {
    const double radius = 0.7, h = 2.0 / (n - 1);
    const Scene scene = surface_of(distance_volume(n, 1), radius);
    // Solid is where the distance is at least the radius: rays from the middle outwards.
    std::mt19937_64 random(11);
    std::normal_distribution<double> normal;
    double worst = 0;
    for (int i = 0; i < 500; ++i) {
      const glm::dvec3 way = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
      const RayIntegral got = cast(scene, glm::dvec3(0), way);
      ASSERT_TRUE(got.distance);
      EXPECT_LE(*got.distance, radius + 1e-6) << "floats in the volume";
      worst = std::max(worst, radius - *got.distance);
    }
    EXPECT_LE(worst, h * h / (4 * radius) * 1.05);
    EXPECT_GE(worst, h * h / (4 * radius) * 0.5);
  }
}

TEST(Isosurface, EntryIntoTheSolidShowsTheEntry) {
  Scene scene = surface_of(unit_ramp({9, 3, 3}), 0.5);  // solid for x >= 1/2
  EXPECT_NEAR(*cast(scene, {-1, 0.3, 0.3}, {1, 0, 0}).distance, 1.5, 1e-7);
  EXPECT_NEAR(*cast(scene, {3, 0.3, 0.3}, {-1, 0, 0}).distance, 2, 1e-12) << "the box's face";
  EXPECT_NEAR(*cast(scene, {3, 0.3, 0.3}, {-1, 0, 0}, 2.25).distance, 2.25, 1e-12) << "the near plane";
  EXPECT_EQ(cast(scene, {0.25, 0.3, 0.3}, {-1, 0, 0}).rgba[3], 0);
  scene.effects.clip_planes = {{{-1, 0, 0}, -0.75}};  // keeps x <= 3/4
  EXPECT_NEAR(*cast(scene, {3, 0.3, 0.3}, {-1, 0, 0}).distance, 2.25, 1e-12) << "a clip plane";
  scene.effects.clip_planes = {{{-1, 0, 0}, -0.25}};
  EXPECT_EQ(cast(scene, {3, 0.3, 0.3}, {-1, 0, 0}).rgba[3], 0);
  scene.effects.clip_planes.clear();
  scene.isosurface->value = -1;  // below the data: all of the box is solid
  EXPECT_NEAR(*cast(scene, {-1, 0.3, 0.3}, {1, 0, 0}).distance, 1, 1e-12);
  scene.isosurface->value = 2;  // above: nothing
  EXPECT_EQ(cast(scene, {-1, 0.3, 0.3}, {1, 0, 0}).rgba[3], 0);
  // Matter of one value, which is the surface's: solid for certain.
  const RayIntegral whole =
      cast(surface_of(constant_volume({4, 4, 4}, 0.1), constant_volume({4, 4, 4}, 0.1).at(0, 0, 0)), {-1, 0.5, 0.4},
           {1, 0.2, 0.3});
  EXPECT_EQ(whole.rgba[3], 1);
  EXPECT_LT(whole.bound, 1e-12);
}

TEST(Isosurface, IsLitAsDefined) {
  Scene scene = surface_of(unit_ramp({9, 3, 3}), 0.5);
  scene.isosurface->ambient_colour = {0.1, 0.6, 0.3};
  scene.transfer.lo = 0;
  scene.transfer.hi = 1;
  Lighting lighting;
  lighting.ambient = 0.3;
  lighting.diffuse = 0.7;
  lighting.specular = 0.4;
  lighting.shininess = 5;
  const glm::dvec3 l = glm::normalize(glm::dvec3(-2, 1, 0.5));
  lighting.lights = {{Light::Kind::Directional, l, {1, 0.9, 0.8}}};
  scene.effects.lighting = lighting;
  const glm::dvec3 way = glm::normalize(glm::dvec3(1, 0.1, 0.05)), n(-1, 0, 0), h = glm::normalize(l - way);
  const RayIntegral got = cast(scene, {-1, 0.2, 0.3}, way);
  for (int c = 0; c < 3; ++c) {
    const double expected = scene.isosurface->ambient_colour[c] * 0.3 +
                            lighting.lights[0].colour[c] * (scene.isosurface->colour[c] * 0.7 * glm::dot(n, l) +
                                                            0.4 * std::pow(glm::dot(n, h), 5));
    EXPECT_NEAR(got.rgba[c], expected, 1e-6) << "floats in the volume";
  }
  EXPECT_EQ(got.rgba[3], 1);
  EXPECT_LT(got.bound, 1e-10);
}

TEST(Isosurface, FewPixelsAreUndecidedAndBricksChangeNothing) {
  std::mt19937_64 random(5);
  Scene scene = surface_of(random_volume({13, 13, 13}, VoxelType::U8, random), 0.7501);
  Lighting lighting;
  lighting.lights = {{Light::Kind::Directional, glm::normalize(glm::dvec3(1, 2, 3)), {1, 1, 1}}};
  scene.effects.lighting = lighting;
  View view;
  view.eye = {20, 25, 40};
  view.target = {6, 6, 6};
  const Reference one = render_reference(scene, view, 48, 48, {1e-6, 1}), two = render_reference(scene, view, 48, 48);
  EXPECT_EQ(one.image.rgba, two.image.rgba);
  EXPECT_TRUE(one.estimate);
  EXPECT_EQ(one.undecided, 0);
  EXPECT_LT(one.max_bound, 1e-6);
  int shown = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 48; ++x) {
      const RayIntegral ray = integrate_ray(scene, view, pixel_ray(view, 48, 48, x, y));
      EXPECT_EQ(one.image.pixel(x, y)[0], static_cast<float>(ray.rgba[0]));
      EXPECT_EQ(one.image.pixel(x, y)[3], static_cast<float>(ray.rgba[3]));
      shown += ray.rgba[3] == 1;
    }
  EXPECT_GT(shown, 300);
  scene.effects.lighting.reset();
  EXPECT_FALSE(render_reference(scene, view, 8, 8).estimate);
}

TEST(SlicePlane, ShowsTheColourAtTheValueMet) {
  Scene scene = scene_of(unit_ramp({9, 3, 3}), {{0, {0, 0, 0}, 5}, {1, {1, 0.5, 0.25}, 9}});
  scene.display = Display::SlicePlane;
  scene.slice_plane = SlicePlane{{0.5, 0.5, 0.5}, glm::normalize(glm::dvec3(1, 1, 0))};
  // x + y = 1, met from (-1, 0.2, 0.5) along (1, 0, 0) at x = 0.8.
  const RayIntegral got = cast(scene, {-1, 0.2, 0.5}, {1, 0, 0});
  EXPECT_NEAR(*got.distance, 1.8, 1e-12);
  EXPECT_NEAR(got.rgba[0], 0.8, 1e-7);
  EXPECT_NEAR(got.rgba[1], 0.4, 1e-7);
  EXPECT_NEAR(got.rgba[2], 0.2, 1e-7);
  EXPECT_EQ(got.rgba[3], 1);
  EXPECT_LT(got.bound, 1e-12);
  EXPECT_EQ(cast(scene, {-1, 1.2, 0.5}, {1, 0, 0}).rgba[3], 0) << "beside the box";
  EXPECT_EQ(cast(scene, {-1, 0.2, 0.5}, {1, 0, 0}, 1.9).rgba[3], 0) << "nearer than the near plane";
  EXPECT_EQ(cast(scene, {0.9, 0.2, 0.5}, {1, 0, 0}).rgba[3], 0) << "behind the eye";
  scene.effects.clip_planes = {{{-1, 0, 0}, -0.75}};
  EXPECT_EQ(cast(scene, {-1, 0.2, 0.5}, {1, 0, 0}).rgba[3], 0) << "cut away";
  EXPECT_EQ(cast(scene, {-1, 0.2, 0.5}, {1, -1, 0}).rgba[3], 0) << "along the plane";
}

TEST(SlicePlane, JumpsOfTheTransferFunctionAreInTheBound) {
  Scene scene = scene_of(unit_ramp({5, 3, 3}), {{0.5, {0, 0, 0}, 1}, {0.5, {1, 1, 1}, 1}});
  scene.display = Display::SlicePlane;
  scene.slice_plane = SlicePlane{{0.5, 0.5, 0.5}, {1, 0, 0}};
  EXPECT_GE(cast(scene, {-1, 0.2, 0.5}, {1, 0.1, 0}).bound, 1);
  scene.slice_plane->point.x = 0.501;
  const RayIntegral beyond = cast(scene, {-1, 0.2, 0.5}, {1, 0.1, 0});
  EXPECT_EQ(beyond.rgba[0], 1);
  EXPECT_LT(beyond.bound, 1e-12);
}

TEST(SlicePlane, WhatAShellShowsIsRefused) {
  Scene scene = scene_of(unit_ramp({5, 3, 3}), {{0, {0, 0, 0}, 1}});
  scene.display = Display::Shell;
  EXPECT_THROW(render_reference(scene, View{}, 4, 4), std::invalid_argument);
}

}  // namespace
}  // namespace volumark::test
