#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "scenes/scene.h"

namespace volumark {
namespace {

constexpr int kWidth = 320, kHeight = 200;
constexpr double kFar = 50;

View oblique(bool perspective) {
  View view;
  view.eye = {3, -2, 5};
  view.target = {0.5, 0.25, -1};
  view.up = {0.2, 1, 0.1};
  view.perspective = perspective;
  view.fov_y = 0.8;
  view.half_height = 2.5;
  view.near = 0.5;
  return view;
}

TEST(View, FrameIsOrthonormalAndRightHanded) {
  const ViewFrame f = frame_of(oblique(true));
  EXPECT_NEAR(glm::length(f.right), 1, 1e-15);
  EXPECT_NEAR(glm::length(f.up), 1, 1e-15);
  EXPECT_NEAR(glm::dot(f.right, f.up), 0, 1e-15);
  EXPECT_NEAR(glm::length(glm::cross(f.right, f.up) + f.forward), 0, 1e-15);
  EXPECT_GT(glm::dot(f.up, oblique(true).up), 0);
}

// A point on a pixel's ray must project to that pixel, at the depth of its distance along the view direction.
TEST(View, PixelRayAgreesWithWorldToClip) {
  for (const bool perspective : {true, false}) {
    const View view = oblique(perspective);
    const glm::dmat4 m = world_to_clip(view, kWidth, kHeight, kFar);
    const glm::dvec3 forward = frame_of(view).forward;
    for (const double x : {0.0, 17.25, 319.0}) {
      for (const double y : {0.0, 88.5, 199.0}) {
        const Ray ray = pixel_ray(view, kWidth, kHeight, x, y);
        EXPECT_NEAR(glm::length(ray.direction), 1, 1e-15);
        for (const double t : {ray.t_near, ray.t_near + 3, ray.t_near + 20}) {
          const glm::dvec3 p = ray.origin + ray.direction * t;
          const glm::dvec4 clip = m * glm::dvec4(p, 1);
          const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
          EXPECT_NEAR((ndc.x + 1) / 2 * kWidth, x + 0.5, 1e-9);
          EXPECT_NEAR((1 - ndc.y) / 2 * kHeight, y + 0.5, 1e-9);
          const double d = glm::dot(p - view.eye, forward);
          const double depth =
              perspective ? kFar / (kFar - view.near) * (1 - view.near / d) : (d - view.near) / (kFar - view.near);
          EXPECT_NEAR(ndc.z, depth, 1e-12);
        }
      }
    }
  }
}

TEST(View, NearPlaneCutsEveryRayAtTheSameDepth) {
  const View view = oblique(true);
  for (const double x : {0.0, 160.0}) {
    const Ray ray = pixel_ray(view, kWidth, kHeight, x, 10);
    const glm::dvec3 p = ray.origin + ray.direction * ray.t_near;
    EXPECT_NEAR(glm::dot(p - view.eye, frame_of(view).forward), view.near, 1e-14);
  }
}

TEST(View, FarPlaneIsDepthOne) {
  for (const bool perspective : {true, false}) {
    const View view = oblique(perspective);
    const glm::dvec3 p = view.eye + frame_of(view).forward * kFar;
    const glm::dvec4 clip = world_to_clip(view, kWidth, kHeight, kFar) * glm::dvec4(p, 1);
    EXPECT_NEAR(clip.z / clip.w, 1, 1e-14);
  }
}

TEST(View, RowZeroIsOnTop) {
  View view;
  view.eye = {0, 0, 2};
  view.near = 0.1;
  EXPECT_GT(pixel_ray(view, 64, 64, 31.5, 0).direction.y, 0);
  EXPECT_LT(pixel_ray(view, 64, 64, 0, 31.5).direction.x, 0);
  EXPECT_NEAR(glm::length(pixel_ray(view, 64, 64, 31.5, 31.5).direction - glm::dvec3(0, 0, -1)), 0, 1e-15);
}

}  // namespace
}  // namespace volumark
