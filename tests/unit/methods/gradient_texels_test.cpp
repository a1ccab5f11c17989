// Gradients as texels: those of scenes/scene.h at the samples, in every format, and turned in the stacks.
#include "methods/volume/gradient_texels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "test_scene.h"

namespace volumark {
namespace {

constexpr glm::ivec3 kSize(4, 3, 5);

// s = 10 i + 4 j - 3 k + 50, spacing (1, 2, 4): per world unit (10, 2, -3/4); window 0..200.
Scene plane_scene() {
  std::vector<float> values;
  for (int k = 0; k < kSize.z; ++k)
    for (int j = 0; j < kSize.y; ++j)
      for (int i = 0; i < kSize.x; ++i) values.push_back(static_cast<float>(10 * i + 4 * j - 3 * k + 50));
  Volume volume = testing::volume_of<float>(kSize, VoxelType::F32, values);
  volume.spacing = {1, 2, 4};
  Scene scene = testing::scene_of(volume, 0, 200);
  scene.effects.lighting = Lighting{};
  return scene;
}

glm::dvec4 float_texel(const GradientTexels& texels, glm::ivec3 at) {
  float v[4];
  const auto index = static_cast<size_t>(at.x + kSize.x * (at.y + kSize.y * at.z));
  std::memcpy(v, texels.texels.data() + index * sizeof(v), sizeof(v));
  return {v[0], v[1], v[2], v[3]};
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double bound) {
  EXPECT_LE(glm::length(a - b), bound) << a.x << " " << a.y << " " << a.z << ", expected " << b.x << " " << b.y << " "
                                       << b.z;
}

TEST(GradientTexels, GradientsOverTwoSpacingsAndValues) {
  const GradientTexels texels = gradient_texels(plane_scene(), {});
  ASSERT_EQ(texels.format, Format::RGBA32F);
  const glm::dvec3 slope = glm::dvec3(10, 2, -0.75) / 200. * 2.;  // smallest spacing 1
  expect_near(glm::dvec3(float_texel(texels, {1, 1, 2})), slope, 1e-7);
  // Clamped at the border: half the difference there.
  expect_near(glm::dvec3(float_texel(texels, {0, 1, 4})), slope * glm::dvec3(.5, 1, .5), 1e-7);
  const double value = float_texel(texels, {3, 0, 1}).w;
  EXPECT_NEAR((value - texels.value_origin) * texels.value_scale, 77. / 200, 1e-7);
}

TEST(GradientTexels, NormalsShortenBelowTheFloor) {
  Scene scene = plane_scene();
  GradientSettings settings;
  settings.normals = true;
  settings.alpha = GradientAlpha::None;
  const glm::dvec3 g = glm::dvec3(10, 2, -0.75) / 200.;
  expect_near(glm::dvec3(float_texel(gradient_texels(scene, settings), {1, 1, 2})), -glm::normalize(g), 1e-6);
  EXPECT_EQ(float_texel(gradient_texels(scene, settings), {1, 1, 2}).w, 0);
  scene.effects.lighting->gradient_floor = 1;  // window widths a smallest spacing: far above |g|
  expect_near(glm::dvec3(float_texel(gradient_texels(scene, settings), {1, 1, 2})), -g, 1e-6);
}

TEST(GradientTexels, BytesAreWithinHalfALevel) {
  const Scene scene = plane_scene();
  for (const bool normals : {false, true}) {
    GradientSettings settings;
    settings.normals = normals;
    const GradientTexels exact = gradient_texels(scene, settings);
    settings.format = "rgba8";
    const GradientTexels bytes = gradient_texels(scene, settings);
    ASSERT_EQ(bytes.format, Format::RGBA8);
    const auto level = [&](size_t i) { return std::to_integer<int>(bytes.texels[i]) / 255.; };
    const size_t texel = 1 + 4 * (1 + 3 * 2);  // sample (1, 1, 2)
    const glm::dvec4 want = float_texel(exact, {1, 1, 2});
    const double half_level = 0.5 / 255 * std::abs(bytes.scale) * (1 + 1e-6);
    for (size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(level(4 * texel + c) * bytes.scale + bytes.offset, want[static_cast<int>(c)], half_level);
    EXPECT_NEAR((level(4 * texel + 3) - bytes.value_origin) * bytes.value_scale, 58. / 200,
                0.5 / 255 * bytes.value_scale * (1 + 1e-6));
  }
}

TEST(GradientTexels, OpacityIsThatOfOneVoxel) {
  Scene scene = plane_scene();
  scene.transfer.points = {{0, glm::dvec3(1), 0}, {200, glm::dvec3(1), 2}};
  GradientSettings settings;
  settings.alpha = GradientAlpha::Opacity;
  const double extinction = 2 * 77. / 200;
  EXPECT_NEAR(float_texel(gradient_texels(scene, settings), {3, 0, 1}).w, -std::expm1(-extinction), 1e-6);
}

}  // namespace
}  // namespace volumark
