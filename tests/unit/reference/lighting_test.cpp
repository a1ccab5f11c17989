#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "methods/reference/reference.h"
#include "tests/unit/reference/brute_force.h"

namespace volumark::test {
namespace {

Lighting lights(bool two_sided, double shininess) {
  Lighting lighting;
  lighting.specular = 0.4;
  lighting.shininess = shininess;
  lighting.two_sided = two_sided;
  lighting.lights = {{Light::Kind::Directional, glm::normalize(glm::dvec3(1, 2, -1)), {1, 0.9, 0.8}},
                     {Light::Kind::Point, {-4, 7, 2.5}, {0.2, 0.3, 0.5}}};
  return lighting;
}

// A ramp has the same gradient everywhere: shading is one constant factor.
TEST(Lighting, ConstantGradientInClosedForm) {
  const double tau = 1.3;
  const glm::dvec3 colour(0.8, 0.5, 0.2), light_colour(1, 0.5, 0.25);
  Scene scene = scene_of(unit_ramp({9, 4, 4}), {{0, colour, tau}});
  Lighting lighting;
  lighting.ambient = 0.15;
  lighting.diffuse = 0.7;
  lighting.specular = 0.3;
  lighting.shininess = 5;
  const glm::dvec3 to_light = glm::normalize(glm::dvec3(-2, 1, 0.5));
  lighting.lights = {{Light::Kind::Directional, to_light, light_colour}};
  scene.effects.lighting = lighting;
  const Ray ray{{-2, 0.4, 0.3}, {1, 0, 0}, 0};
  const RayIntegral lit = integrate_ray(scene, View{}, ray, 1e-9);
  const glm::dvec3 normal(-1, 0, 0), half = glm::normalize(to_light - ray.direction);
  const double alpha = -std::expm1(-tau);
  for (int c = 0; c < 3; ++c) {
    const double expected = colour[c] * (0.15 + light_colour[c] * 0.7 * glm::dot(normal, to_light)) +
                            light_colour[c] * 0.3 * std::pow(glm::dot(normal, half), 5);
    EXPECT_NEAR(lit.rgba[c], expected * alpha, 1e-9);
  }
  EXPECT_NEAR(lit.rgba[3], alpha, 1e-13);

  lighting.lights[0].vector = -to_light;  // from behind: ambient only, and the same as before when two-sided
  scene.effects.lighting = lighting;
  const RayIntegral behind = integrate_ray(scene, View{}, ray, 1e-9);
  EXPECT_NEAR(behind.rgba[0], colour.x * 0.15 * alpha, 1e-9);
  lighting.two_sided = true;
  lighting.specular = 0;
  scene.effects.lighting = lighting;
  EXPECT_NEAR(integrate_ray(scene, View{}, ray, 1e-9).rgba[0],
              colour.x * (0.15 + 0.7 * glm::dot(normal, to_light)) * alpha, 1e-9);
}

TEST(Lighting, NoGradientLeavesAmbient) {
  Scene scene = scene_of(constant_volume({3, 3, 3}, 0.5), {{0, {1, 0.5, 0.25}, 1}});
  scene.effects.lighting = lights(false, 8);
  const RayIntegral ray = integrate_ray(scene, View{}, {{-2, 1, 1}, {1, 0, 0}, 0}, 1e-9);
  EXPECT_NEAR(ray.rgba[0], 0.2 * -std::expm1(-2.0), 1e-9);
}

TEST(Lighting, MatchesAnIndependentIntegrator) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  double worst = 0, worst_ratio = 0, largest_bound = 0;
  int rays = 0;
  for (const bool two_sided : {false, true}) {
    for (const double shininess : {1.0, 20.0, 12.5}) {
      Volume volume = random_volume({5, 4, 1 + 4 * (rays % 2)}, VoxelType::F32, random);
      volume.spacing = {1, 0.8, 1.25};
      const glm::dvec3 x = glm::normalize(glm::dvec3(1, 0.2, 0.1));
      const glm::dvec3 y = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), x));
      volume.axes = glm::dmat3(x, y, glm::cross(x, y));
      Scene scene = scene_of(volume, {{0.2, {0.1, 0.2, 0.9}, 0}, {0.5, {0.9, 0.5, 0.1}, 1}, {1, {1, 1, 0.3}, 0.6}});
      scene.effects.lighting = lights(two_sided, shininess);
      const glm::dvec3 extent = volume.extent();
      for (int i = 0; i < 12; ++i) {
        auto point = [&] {
          return volume.axes * (extent * glm::dvec3(uniform(random), uniform(random), uniform(random)));
        };
        const glm::dvec3 target = point(), direction = glm::normalize(point() - target + 1e-3);
        const Ray ray{target - 12.0 * direction, direction, 0};
        const RayIntegral integral = integrate_ray(scene, View{}, ray, 1e-7);
        const auto truth = brute_force(scene, ray, 40);
        for (size_t c = 0; c < 4; ++c) {
          const double error = static_cast<double>(std::abs(static_cast<long double>(integral.rgba[c]) - truth[c]));
          worst = std::max(worst, error);
          // An estimate a hundredth of the tolerance asked for is not judged: nothing was refined for its sake.
          worst_ratio = std::max(worst_ratio, error / std::max(integral.bound, 1e-9));
        }
        largest_bound = std::max(largest_bound, integral.bound);
        ++rays;
      }
    }
  }
  std::printf("%d lit rays, worst error %.2e, worst error/estimate %.2g, largest estimate %.2e\n", rays, worst,
              worst_ratio, largest_bound);
  EXPECT_LT(worst, 1e-7) << "the tolerance asked for";
  EXPECT_LT(worst_ratio, 10) << "an estimate, not a bound";
  EXPECT_LT(largest_bound, 1e-7);
}

}  // namespace
}  // namespace volumark::test
