// Shells in the reference: chords against closed polyhedra, and everything else against brute force.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "methods/reference/reference.h"
#include "methods/reference/shell_prism.h"
#include "methods/reference/shell_tracer.h"
#include "scenes/noise.h"
#include "tests/unit/shell_slices/hand_made.h"

namespace volumark {
namespace {

Scene scene_of(const Shell& shell) {
  Scene scene;
  scene.display = Display::Shell;
  scene.shell = std::make_shared<const Shell>(shell);
  return scene;
}

Ray ray_between(const glm::dvec3& from, const glm::dvec3& to) { return {from, glm::normalize(to - from), 0}; }

// Where the ray leaves a closed surface less where it enters it: its length inside, by the triangles' planes and the
// signed volumes of tetrahedra, so that two triangles agree about a ray that passes their edge but for rounding.
double chord(const Shell& shell, int layer, const Ray& ray) {
  double sum = 0;
  for (size_t i = 0; i < shell.prisms(); ++i) {
    const glm::dvec3 a = shell.corner(i, layer) - ray.origin, b = shell.corner(i, layer + 1) - ray.origin,
                     c = shell.corner(i, layer + 2) - ray.origin;
    const double u = glm::dot(ray.direction, glm::cross(b, c)), v = glm::dot(ray.direction, glm::cross(c, a)),
                 w = glm::dot(ray.direction, glm::cross(a, b));
    if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0))) continue;
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double facing = glm::dot(n, ray.direction);
    if (facing != 0) sum += (facing > 0 ? 1 : -1) * glm::dot(n, a) / facing;
  }
  return sum;
}

TEST(ReferenceShell, ChordsOfNeighboursAddUp) {
  const float tau = 0.75F;
  const Shell shell = torus_shell(24, 12, 1, 0.4, 0.2, glm::vec4(0.5F * tau, 0.25F * tau, tau, tau));
  const Scene scene = scene_of(shell);
  std::mt19937_64 random(14);
  std::uniform_real_distribution<double> unit(-1, 1);
  const ShellTracer tracer(scene);
  double worst = 0;
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    // At a random point, through a vertex of the mesh, or through a point of a shared edge. Closed surfaces count a
    // ray through an edge twice or not at all; a chord of theirs is taken from a ray a hair beside it.
    const size_t prism = random() % shell.prisms();
    glm::dvec3 target(unit(random), unit(random), 0.4 * unit(random));
    if (i % 3 == 1) target = shell.corner(prism, 0);
    if (i % 3 == 2) target = glm::mix(shell.corner(prism, 0), shell.corner(prism, 4), 0.5 + 0.4 * unit(random));
    const glm::dvec3 eye = 5. * glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)));
    const Ray ray = ray_between(eye, target);
    double length = 0, least = 1e30, most = -1e30;
    const bool at_edge = i % 3 != 0;
    const std::array<glm::dvec3, 3> hairs = {glm::dvec3(2e-10, -1e-10, 3e-10), glm::dvec3(-3e-10, 1e-10, 2e-10),
                                             glm::dvec3(1e-10, 3e-10, -2e-10)};
    for (const glm::dvec3& hair : hairs) {
      Ray beside = ray;
      if (at_edge) beside.origin += hair;
      length = chord(shell, 3, beside) - chord(shell, 0, beside);
      least = std::min(least, length);
      most = std::max(most, length);
    }
    const RayResult out = tracer.trace(ray, 1e-10);
    if (length > 0) ++met;
    const double alpha = -std::expm1(-static_cast<double>(tau) * length);
    // What a hair changes is known from three of them.
    const double allowed = 1e-10 + (at_edge ? 4 * (most - least) : 0);
    EXPECT_LT(most - least, 1e-4);  // faces are met at an angle of 1e-5 or more
    EXPECT_NEAR(out.alpha, alpha, allowed);
    EXPECT_NEAR(out.rgb.x, alpha / 2, allowed);
    if (!at_edge) worst = std::max(worst, std::abs(out.alpha - alpha));
  }
  EXPECT_GT(met, 1000);
  RecordProperty("worst", std::to_string(worst));
}

// Midpoint rule over many points, the map inverted at each from scratch.
glm::dvec4 brute_force(const Scene& scene, const Ray& ray, double t1, int steps) {
  const Shell& shell = *scene.shell;
  std::array<glm::dvec3, 6> corners;
  for (int k = 0; k < 6; ++k) corners[static_cast<size_t>(k)] = shell.corner(0, k);
  const PrismMap map(corners);
  const auto slopes = cotangents(shell);
  const double h = t1 / steps;
  glm::dvec3 rgb(0);
  double depth = 0;
  for (int i = 0; i < steps; ++i) {
    const glm::dvec3 at = ray.origin + (i + 0.5) * h * ray.direction;
    PrismPoint point(0);
    if (map.locate(at, point) < 0) continue;
    EXPECT_NEAR(glm::distance(map.at(point), at), 0, 1e-12);
    const glm::dvec3 uvw = over_prism(shell.texture[0], point);
    const glm::dvec4 texel = shell.colours->at(uvw);
    glm::dvec3 emission(texel);
    if (scene.effects.lighting) {
      const Lighting& lighting = *scene.effects.lighting;
      const glm::dvec3 g = over_prism(slopes[0], point) * shell.colours->gradient(uvw);
      const glm::dvec3 n = g / -std::max(glm::length(g), gradient_floor(lighting, shell));
      const glm::dvec3 l = lighting.lights[0].vector, half = glm::normalize(l - ray.direction);
      const double n_l = std::max(glm::dot(n, l), 0.), n_h = n_l > 0 ? std::max(glm::dot(n, half), 0.) : 0;
      emission = emission * (lighting.ambient + lighting.diffuse * n_l * lighting.lights[0].colour) +
                 texel.w * lighting.specular * std::pow(n_h, lighting.shininess) * lighting.lights[0].colour;
    }
    rgb += h * std::exp(-depth - 0.5 * h * texel.w) * emission;
    depth += h * texel.w;
  }
  return {rgb, -std::expm1(-depth)};
}

TEST(ReferenceShell, EqualsBruteForceInALeaningPrism) {
  Shell shell = one_prism(1, {0.5, 0.9, 0.7}, 0.6);
  auto colours = std::make_shared<ShellTexture>();
  colours->size = {5, 4, 6};
  uint64_t state = 3;
  for (int i = 0; i < 5 * 4 * 6; ++i) {
    const auto tau = static_cast<float>(8 * next_unit(state));
    colours->texels.emplace_back(tau * static_cast<float>(next_unit(state)), tau * static_cast<float>(next_unit(state)),
                                 tau * static_cast<float>(next_unit(state)), tau);
  }
  shell.colours = colours;
  Scene plain = scene_of(shell), lit = plain;
  Lighting lighting;
  lighting.specular = 0.4;
  lighting.lights = {{Light::Kind::Directional, glm::normalize(glm::dvec3(1, 2, 2)), glm::dvec3(1, 0.8, 0.6)}};
  lit.effects.lighting = lighting;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 24; ++i) {
    const Ray ray = ray_between({3 * unit(random) - 1, 3 * unit(random) - 1, 2.5}, {0.4 * unit(random), 0.4, 0.2});
    for (const Scene* scene : {&plain, &lit}) {
      const RayIntegral out = integrate_ray(*scene, View{}, ray, 1e-8);
      const glm::dvec4 expected = brute_force(*scene, ray, 6, 40000);
      // The midpoint rule errs by the ends of the chord, h tau each, before all else: 6 / 40000 * 8.
      for (int c = 0; c < 4; ++c) EXPECT_NEAR(out.rgba[c], expected[c], 1.3e-3) << i << " " << c;
      EXPECT_LT(out.bound, 1e-5);
      // A tighter tolerance moves it by no more than the bounds say.
      const RayIntegral finer = integrate_ray(*scene, View{}, ray, 1e-11);
      for (int c = 0; c < 4; ++c) EXPECT_NEAR(out.rgba[c], finer.rgba[c], out.bound + finer.bound) << i << " " << c;
    }
  }
}

TEST(ReferenceShell, ARayAlongASharedFaceMeetsOnePrism) {
  // Two triangles over a unit square, straight up; the diagonal's face is shared.
  Shell shell = one_prism(1, {1, 1, 1});
  Mesh mesh = *shell.mesh;
  mesh.positions.push_back({1, 1, 0});
  mesh.normals.assign(4, {0, 0, 1});
  mesh.triangles.push_back({1, 3, 2});
  shell.mesh = std::make_shared<const Mesh>(mesh);
  shell.thickness.assign(4, 1);
  shell.texture.push_back(shell.texture[0]);
  const Scene scene = scene_of(shell);
  for (const glm::dvec3 from : {glm::dvec3(0.5, 0.5, 3), glm::dvec3(1.5, -0.5, 0.5)}) {
    const Ray ray = ray_between(from, {0.5, 0.5, 0.5});
    const double length = from.z > 1 ? 1 : std::sqrt(2.);
    EXPECT_NEAR(integrate_ray(scene, View{}, ray).rgba[3], -std::expm1(-length), 1e-12);
  }
}

TEST(ReferenceShell, TheEyeMayBeInside) {
  const Shell shell = one_prism(1, {1, 1, 1});
  const Ray ray{{0.25, 0.25, 0.5}, {0, 0, 1}, 0};
  EXPECT_NEAR(integrate_ray(scene_of(shell), View{}, ray).rgba[3], -std::expm1(-0.5), 1e-12);
}

}  // namespace
}  // namespace volumark
