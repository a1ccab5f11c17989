#include "methods/volume/volume_uniforms.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "test_scene.h"

namespace volumark {
namespace {

glm::dvec3 vec3(const Float4& v) { return {v[0], v[1], v[2]}; }

// The rays of the uniforms are those of scenes/scene.h, for a scene of any size and place.
TEST(VolumeUniforms, RaysAreThePixelRays) {
  for (const double scale : {1e-6, 1., 1e6}) {
    for (const glm::dvec3 moved : {glm::dvec3(0), glm::dvec3(1e6, -2e6, 3e5) * scale}) {
      const Volume volume = testing::skewed_volume(scale, moved);
      const glm::dmat4 to_box = volume.world_to_box();
      const glm::dvec3 middle = glm::dvec3(volume.box_to_world() * glm::dvec4(0.5, 0.5, 0.5, 1));
      const Scene scene = testing::scene_of(volume);
      for (const bool perspective : {true, false}) {
        View view =
            testing::view_at(middle + glm::dvec3(2, 1.5, -3) * scale, middle + glm::dvec3(0.1 * scale), perspective);
        view.half_height *= scale;
        view.near *= scale;
        const int width = 160, height = 90;
        const VolumeUniforms u = volume_uniforms(scene, view, width, height);
        for (const auto& [x, y] : {std::pair{0, 0}, {159, 89}, {80, 45}, {13, 77}}) {
          const Ray ray = pixel_ray(view, width, height, x, y);
          const double nx = (x + 0.5) / width * 2 - 1, ny = 1 - (y + 0.5) / height * 2;
          const glm::dvec3 origin = vec3(u.ray_origin) + nx * vec3(u.ray_origin_x) + ny * vec3(u.ray_origin_y);
          const glm::dvec3 direction =
              vec3(u.ray_direction) + nx * vec3(u.ray_direction_x) + ny * vec3(u.ray_direction_y);
          const double length = glm::length(direction * vec3(u.extent));  // per unit of z
          // Where the near plane cuts the ray, and a scene's size further on.
          for (const double further : {0., 2. * scale}) {
            const glm::dvec3 expected =
                glm::dvec3(to_box * glm::dvec4(ray.origin + (ray.t_near + further) * ray.direction, 1));
            const glm::dvec3 found = origin + (u.depth[0] + further / length) * direction;
            // A place 1e6 sizes away is known to 1e6 * 2^-53 of a size in double.
            EXPECT_LT(glm::length(found - expected), moved == glm::dvec3(0) ? 5e-6 : 1e-5)
                << scale << " " << perspective << " " << x << " " << y;
          }
        }
      }
    }
  }
}

TEST(VolumeUniforms, TextureCoordinatesAreTexelCentres) {
  const Volume volume = testing::skewed_volume();
  const VolumeUniforms u =
      volume_uniforms(testing::scene_of(volume), testing::view_at({5, 5, 5}, {0, 0, 0}, true), 10, 10);
  for (size_t axis = 0; axis < 3; ++axis) {
    const int n = volume.size[static_cast<int>(axis)];
    for (int i = 0; i < n; ++i) {
      const double box = static_cast<double>(i) / (n - 1);
      EXPECT_NEAR(box * u.texture_scale[axis] + u.texture_offset[axis], (i + 0.5) / n, 1e-6);
    }
    EXPECT_FLOAT_EQ(u.texel[axis], 1.F / static_cast<float>(n));
  }
  EXPECT_FLOAT_EQ(u.extent[3], 0.2F);
}

TEST(VolumeUniforms, SingleSampleAxisIsConstant) {
  const Volume volume = testing::volume_of<uint8_t>({1, 2, 1}, VoxelType::U8, {3, 4});
  const VolumeUniforms u =
      volume_uniforms(testing::scene_of(volume), testing::view_at({5, 5, 5}, {0, 0, 0}, true), 10, 10);
  EXPECT_EQ(u.texture_scale[0], 0.F);
  EXPECT_EQ(u.texture_offset[0], 0.5F);
  EXPECT_EQ(u.extent[0], 1.F);
  EXPECT_EQ(u.texture_offset[1], 0.25F);
}

TEST(VolumeUniforms, ClipPlanesAndLightsInTheVolumesFrame) {
  const Volume volume = testing::skewed_volume();
  Scene scene = testing::scene_of(volume);
  scene.effects.clip_planes.push_back({glm::normalize(glm::dvec3(1, -2, 0.5)), 0.3});
  Lighting lighting;
  lighting.specular = 0.5;
  lighting.lights.push_back({Light::Kind::Directional, glm::normalize(glm::dvec3(1, 1, 0)), {1, 2, 3}});
  lighting.lights.push_back({Light::Kind::Point, {4, 5, 6}, {1, 1, 1}});
  scene.effects.lighting = lighting;
  const View view = testing::view_at({5, 5, 5}, {0, 0, 0}, true);
  const VolumeUniforms u = volume_uniforms(scene, view, 10, 10);
  for (const glm::dvec3 box : {glm::dvec3(0, 0, 0), glm::dvec3(1, 0.25, 0.5), glm::dvec3(0.1, 0.9, 1)}) {
    const glm::dvec3 world = glm::dvec3(volume.box_to_world() * glm::dvec4(box, 1));
    const double expected = glm::dot(scene.effects.clip_planes[0].normal, world) - 0.3;
    EXPECT_NEAR(glm::dot(vec3(u.clip_planes[0]), box) - u.clip_planes[0][3], expected, 1e-6);
    // Distances and angles are those of the world.
    const glm::dvec3 local = (box - 0.5) * vec3(u.extent);
    EXPECT_NEAR(glm::length(vec3(u.lights[1].vector) - local), glm::length(glm::dvec3(4, 5, 6) - world), 1e-5);
    EXPECT_NEAR(glm::length(vec3(u.eye) - local), glm::length(view.eye - world), 1e-5);
  }
  EXPECT_NEAR(glm::dot(vec3(u.lights[0].vector), vec3(u.forward)),
              glm::dot(scene.effects.lighting->lights[0].vector, frame_of(view).forward), 1e-6);
  EXPECT_EQ(u.lights[0].vector[3], 0.F);
  EXPECT_EQ(u.lights[1].vector[3], 1.F);
  EXPECT_EQ(u.counts, (Float4{2, 1, 1, 0}));
}

}  // namespace
}  // namespace volumark
