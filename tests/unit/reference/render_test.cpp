#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "methods/reference/reference.h"
#include "tests/unit/reference/brute_force.h"

namespace volumark::test {
namespace {

Scene small_scene(bool lit = false) {
  std::mt19937_64 random(9);
  Scene scene = scene_of(random_volume({12, 9, 10}, VoxelType::U8, random),
                         {{0.55, {0.2, 0.4, 1}, 0}, {0.8, {1, 0.6, 0.1}, 0.9}, {0.8, {0, 1, 0}, 0.3}});
  if (lit) {
    Lighting lighting;
    lighting.specular = 0.3;
    lighting.lights = {{Light::Kind::Directional, {0, 0, 1}, glm::dvec3(1)}};
    scene.effects.lighting = lighting;
  }
  return scene;
}

View perspective_view() {
  View view;
  view.eye = {20, 16, 25};
  view.target = {5.5, 4, 4.5};
  view.near = 0.1;
  return view;
}

TEST(Render, DoesNotDependOnTheNumberOfThreads) {
  for (const bool lit : {false, true}) {
    const Scene scene = small_scene(lit);
    const Reference one = render_reference(scene, perspective_view(), 53, 37, {1e-6, 1});
    for (const int threads : {2, 3, 8, 0}) {
      const Reference many = render_reference(scene, perspective_view(), 53, 37, {1e-6, threads});
      EXPECT_EQ(one.image.rgba, many.image.rgba);
      EXPECT_EQ(one.bound, many.bound);
      EXPECT_EQ(one.cells, many.cells);
      EXPECT_EQ(one.pieces, many.pieces);
    }
    EXPECT_EQ(one.estimate, lit);
  }
}

// Skipping bricks must change nothing; the float image is the ray's value rounded, and its bound says so.
TEST(Render, PixelsAreTheRaysIntegrals) {
  const Scene scene = small_scene();
  View view = perspective_view();
  for (const bool perspective : {true, false}) {
    view.perspective = perspective;
    view.half_height = 7;
    const Reference reference = render_reference(scene, view, 24, 20);
    int drawn = 0;
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 24; ++x) {
        const RayIntegral ray = integrate_ray(scene, view, pixel_ray(view, 24, 20, x, y), 1e-6);
        const double bound = static_cast<double>(reference.bound[static_cast<size_t>(y) * 24 + static_cast<size_t>(x)]);
        for (int c = 0; c < 4; ++c) {
          EXPECT_EQ(reference.image.pixel(x, y)[c], static_cast<float>(ray.rgba[c]));
          EXPECT_GE(bound,
                    std::abs(ray.rgba[c] - static_cast<double>(reference.image.pixel(x, y)[c])) + ray.bound * 0.999);
        }
        EXPECT_LE(bound, reference.max_bound);
        drawn += ray.rgba[3] > 0;
      }
    }
    EXPECT_GT(drawn, 60);
    EXPECT_GT(reference.cells, drawn);
  }
}

TEST(Render, EyeInsideTheVolume) {
  Scene scene = scene_of(constant_volume({5, 5, 5}, 1), {{0, {1, 1, 1}, 0.5}});
  View view;
  view.eye = {2, 2, 2};
  view.target = {2, 2, 0};
  view.near = 0.25;
  const Reference reference = render_reference(scene, view, 3, 3);
  EXPECT_NEAR(static_cast<double>(reference.image.pixel(1, 1)[3]), -std::expm1(-0.5 * 1.75), 1e-7);
}

TEST(Render, VoxelTypesGiveOneImage) {
  std::mt19937_64 random(4);
  const Volume bytes = random_volume({6, 7, 5}, VoxelType::U8, random);
  Volume shorts = bytes, words = bytes, floats = bytes;
  shorts.type = VoxelType::I16;
  words.type = VoxelType::U16;
  floats.type = VoxelType::F32;
  shorts.voxels.clear();
  words.voxels.clear();
  floats.voxels.clear();
  auto append = [](std::vector<std::byte>& to, auto value) {
    const auto* from = reinterpret_cast<const std::byte*>(&value);
    to.insert(to.end(), from, from + sizeof(value));
  };
  for (const std::byte b : bytes.voxels) {
    append(shorts.voxels, static_cast<int16_t>(std::to_integer<int>(b) - 128));
    append(words.voxels, static_cast<uint16_t>(std::to_integer<int>(b) * 256));
    append(floats.voxels, static_cast<float>(std::to_integer<int>(b)));
  }
  // Slopes and intercepts that give the same data values exactly: multiples of 1/256.
  Volume exact = bytes;
  exact.slope = floats.slope = 1.0 / 256;
  shorts.slope = 1.0 / 256;
  shorts.intercept = 0.5;
  words.slope = 1.0 / 65536;
  const std::vector<TransferPoint> points{{0.3, {1, 0.5, 0}, 0}, {0.6, {0, 0.5, 1}, 1}};
  View view = perspective_view();
  const Reference expected = render_reference(scene_of(exact, points), view, 20, 20);
  EXPECT_GT(*std::max_element(expected.image.rgba.begin(), expected.image.rgba.end()), 0.1f);
  for (const Volume& volume : {shorts, words, floats})
    EXPECT_EQ(render_reference(scene_of(volume, points), view, 20, 20).image.rgba, expected.image.rgba);
}

TEST(Render, RefusesNonsense) {
  Scene scene = small_scene();
  EXPECT_THROW(render_reference(scene, perspective_view(), 0, 4), std::invalid_argument);
  EXPECT_THROW(render_reference(scene, perspective_view(), 4, 4, {0, 1}), std::invalid_argument);
  scene.volume = nullptr;
  EXPECT_THROW(render_reference(scene, perspective_view(), 4, 4), std::invalid_argument);
  EXPECT_THROW(integrate_ray(scene, View{}, {{0, 0, -1}, {0, 0, 1}, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace volumark::test
