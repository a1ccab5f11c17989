// Hard cases with answers in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>

#include "methods/reference/reference.h"
#include "tests/unit/reference/brute_force.h"

namespace volumark::test {
namespace {

constexpr double kTolerance = 1e-10;

std::vector<TransferPoint> uniform(double extinction, const glm::dvec3& colour = glm::dvec3(1)) {
  return {{0, colour, extinction}};
}

RayIntegral along_x(const Scene& scene, double y = 0.4, double z = 0.3, double from = -3) {
  return integrate_ray(scene, View{}, {{from, y, z}, {1, 0, 0}, 0}, kTolerance);
}

TEST(ClosedForm, HomogeneousSlab) {
  for (const int n : {2, 3, 17, 129}) {
    const RayIntegral ray = along_x(scene_of(unit_ramp({n, 3, 3}), uniform(1, {0.5, 0.25, 1})));
    const double alpha = 1 - std::exp(-1.0);
    EXPECT_NEAR(alpha, 0.6321205588, 1e-10);
    EXPECT_NEAR(ray.rgba[3], alpha, 1e-14);
    EXPECT_NEAR(ray.rgba[0], 0.5 * alpha, 1e-14);
    EXPECT_NEAR(ray.rgba[1], 0.25 * alpha, 1e-14);
    EXPECT_LT(ray.bound, 1e-11);
  }
}

// Williams and Max; Moreland and Angel: I = Lf (1 - Psi) + Lb (Psi - zeta).
TEST(ClosedForm, LinearExtinctionAndEmission) {
  const struct {
    double front, back, psi;
  } cases[] = {{0, 2, 0.746824132812}, {2, 0, 0.538079506913}, {1, 1, 0.632120558829}};
  for (const auto& c : cases) {
    const glm::dvec3 near_colour(1, 0, 0.3), far_colour(0, 1, 0.8);
    const Scene scene = scene_of(unit_ramp({5, 2, 2}), {{0, near_colour, c.front}, {1, far_colour, c.back}});
    const RayIntegral ray = along_x(scene);
    const double zeta = std::exp(-(c.front + c.back) / 2);
    for (int ch = 0; ch < 3; ++ch)
      EXPECT_NEAR(ray.rgba[ch], near_colour[ch] * (1 - c.psi) + far_colour[ch] * (c.psi - zeta), 1e-11 + ray.bound);
    EXPECT_NEAR(ray.rgba[3], 1 - zeta, 1e-14);
  }
}

// A step on a linear field is a plane, exact under trilinear interpolation, also for oblique rays.
TEST(ClosedForm, StepOnARampIsAHalfSpace) {
  const Scene scene = scene_of(unit_ramp({8, 8, 8}), {{0.37, {1, 1, 1}, 0}, {0.37, {1, 1, 1}, 2.5}});
  const RayIntegral straight = along_x(scene);
  EXPECT_NEAR(straight.rgba[3], -std::expm1(-2.5 * 0.63), 1e-7) << "float samples of the ramp";
  const glm::dvec3 direction = glm::normalize(glm::dvec3(3, 1, 0.5));
  const RayIntegral oblique = integrate_ray(scene, View{}, {glm::dvec3(0, 0.2, 0.2), direction, 0}, kTolerance);
  EXPECT_NEAR(oblique.rgba[3], -std::expm1(-2.5 * 0.63 / direction.x), 1e-7);
  EXPECT_LT(oblique.bound, 1e-9);
}

// The interpolated distance lies above the true one by at most h^2 / (4 r): the sphere shrinks by at most that.
TEST(ClosedForm, HomogeneousSphere) {
  const int n = 65;
  const double radius = 0.8, tau = 1.25, h = 2.0 / (n - 1);
  const Scene scene = scene_of(distance_volume(n, 1), {{radius, glm::dvec3(1), tau}, {radius, glm::dvec3(1), 0}});
  const double shrunk = radius - h * h / (4 * (radius - h));
  for (const double b : {0.0, 0.1, 0.45, 0.7, 0.79, 0.85}) {
    const RayIntegral ray = integrate_ray(scene, View{}, {{-3, b * 0.6, b * 0.8}, {1, 0, 0}, 0}, kTolerance);
    auto alpha = [&](double r) { return b < r ? -std::expm1(-2 * tau * std::sqrt(r * r - b * b)) : 0.0; };
    EXPECT_LE(ray.rgba[3], alpha(radius) + 1e-6 + ray.bound) << b;  // 1e-6: float samples
    EXPECT_GE(ray.rgba[3], alpha(shrunk) - 1e-6 - ray.bound) << b;
  }
}

TEST(ClosedForm, GrazingShell) {
  const int n = 129;
  const double inner = 1, outer = 1.1, b = inner, tau = 0.7, h = 2.4 / (n - 1);
  EXPECT_NEAR(2 * std::sqrt(outer * outer - b * b), 0.9165151390, 1e-10);
  const glm::dvec3 white(1);
  const Scene scene = scene_of(distance_volume(n, 1.2),
                               {{inner, white, 0}, {inner, white, tau}, {outer, white, tau}, {outer, white, 0}});
  const RayIntegral ray = integrate_ray(scene, View{}, {{-3, b * 0.28, b * 0.96}, {1, 0, 0}, 0}, kTolerance);
  auto alpha = [&](double r) { return -std::expm1(-tau * 2 * std::sqrt(r * r - b * b)); };
  EXPECT_LE(ray.rgba[3], alpha(outer) + 1e-6);
  EXPECT_GE(ray.rgba[3], alpha(outer - h * h / (4 * (outer - h))) - 1e-6);
}

TEST(ClosedForm, ClipPlaneShortensThePath) {
  Scene scene = scene_of(unit_ramp({5, 5, 5}), uniform(1.5));
  for (const double z0 : {0.0, 0.1, 0.25, 0.999, 1.0, 1.5}) {
    scene.effects.clip_planes = {{{1, 0, 0}, z0}};
    const RayIntegral ray = along_x(scene);
    EXPECT_NEAR(ray.rgba[3], -std::expm1(-1.5 * std::max(0.0, 1 - z0)), 1e-13) << z0;
  }
  scene.effects.clip_planes = {{{1, 0, 0}, 0.3}, {{-1, 0, 0}, -0.8}, {{0, 1, 0}, -1}};
  EXPECT_NEAR(along_x(scene).rgba[3], -std::expm1(-1.5 * 0.5), 1e-13);
  scene.effects.clip_planes = {{{0, 1, 0}, 0.5}};  // parallel to the ray, which lies on its far side
  EXPECT_EQ(along_x(scene).rgba[3], 0);
  EXPECT_GT(along_x(scene, 0.6).rgba[3], 0.5);
}

TEST(ClosedForm, EyeInsideAndNearPlane) {
  const Scene scene = scene_of(unit_ramp({5, 5, 5}), uniform(2));
  EXPECT_NEAR(along_x(scene, 0.4, 0.3, 0.25).rgba[3], -std::expm1(-2 * 0.75), 1e-13);
  const RayIntegral cut = integrate_ray(scene, View{}, {{0.25, 0.4, 0.3}, {1, 0, 0}, 0.5}, kTolerance);
  EXPECT_NEAR(cut.rgba[3], -std::expm1(-2 * 0.25), 1e-13);
  EXPECT_EQ(along_x(scene, 0.4, 0.3, 1.5).rgba[3], 0) << "behind the eye";
  EXPECT_EQ(along_x(scene, 1.4).rgba[3], 0) << "beside the box";
}

// An axis with one sample spans one spacing, centred on the sample.
TEST(ClosedForm, SingleSampleAxes) {
  for (const glm::ivec3 size : {glm::ivec3(1, 4, 3), glm::ivec3(4, 1, 3), glm::ivec3(1, 1, 3), glm::ivec3(1, 1, 1)}) {
    Volume volume = constant_volume(size, 0.5);
    volume.spacing = {0.5, 0.7, 0.9};
    const Scene scene = scene_of(volume, uniform(1.1));
    for (int a = 0; a < 3; ++a) {
      glm::dvec3 direction(0), origin(0.1);
      direction[a] = 1;
      origin[a] = -10;
      const double path = volume.spacing[a] * std::max(size[a] - 1, 1);
      const RayIntegral ray = integrate_ray(scene, View{}, {origin, direction, 0}, kTolerance);
      EXPECT_NEAR(ray.rgba[3], -std::expm1(-1.1 * path), 1e-13) << size.x << size.y << size.z << " axis " << a;
      origin[(a + 1) % 3] = -0.1;  // inside the half spacing of an axis with one sample, outside of any other
      EXPECT_EQ(integrate_ray(scene, View{}, {origin, direction, 0}, kTolerance).rgba[3] > 0, size[(a + 1) % 3] == 1);
    }
  }
}

TEST(ClosedForm, ConstantFieldOnAJumpTakesTheUpperValue) {
  const Scene scene = scene_of(constant_volume({3, 3, 3}, 0.5), {{0.5, glm::dvec3(1), 0}, {0.5, glm::dvec3(1), 1}});
  EXPECT_NEAR(along_x(scene).rgba[3], -std::expm1(-2.0), 1e-13);
}

TEST(ClosedForm, NothingWhereThereIsNoExtinction) {
  const RayIntegral ray = along_x(scene_of(unit_ramp({4, 4, 4}), uniform(0)));
  for (const double channel : ray.rgba) EXPECT_EQ(channel, 0);
  EXPECT_LT(ray.bound, 1e-13);
}

TEST(ClosedForm, OpaqueFromTheFirstVoxel) {
  const RayIntegral ray = along_x(scene_of(unit_ramp({4, 4, 4}), {{0, {1, 0, 0}, 1e8}, {1, {0, 1, 0}, 1e8}}));
  EXPECT_NEAR(ray.rgba[3], 1, kTolerance);
  EXPECT_NEAR(ray.rgba[0], 1, 1e-7);
  EXPECT_LE(ray.bound, 1e-5) << "an extinction of 1e8 times the rounding of the entry";
}

}  // namespace
}  // namespace volumark::test
