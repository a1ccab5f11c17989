#include "methods/texture3d_slices/slice_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "test_scene.h"

namespace volumark {
namespace {

double area(const std::vector<glm::dvec2>& polygon) {
  double twice = 0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return twice / 2;
}

bool contains(const std::vector<glm::dvec2>& polygon, const glm::dvec2& p, double slack) {
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) < -slack) return false;
  }
  return polygon.size() >= 3;
}

// A unit cube at the origin.
Volume unit_cube() {
  Volume volume = testing::volume_of<uint8_t>({3, 3, 3}, VoxelType::U8, std::vector<uint8_t>(27, 1));
  volume.spacing = glm::dvec3(0.5);
  volume.origin = glm::dvec3(-0.5);
  return volume;
}
ViewRays rays_from(const Volume& volume, const glm::dvec3& eye, bool perspective) {
  return view_rays(volume, testing::view_at(eye, {0, 0, 0}, perspective), 100, 100);
}

TEST(SliceGeometry, SectionsOfACubeAlongItsDiagonal) {
  const Volume cube = unit_cube();
  const ViewRays rays = rays_from(cube, {3, 3, 3}, false);
  const Body body = visible_body(cube.extent(), rays, {});
  EXPECT_EQ(body.edges.size(), 12U);
  EXPECT_NEAR(body.z_last - body.z_first, std::sqrt(3), 1e-12);
  const auto hexagon = hull_of_slab(body, rays, 0, 0);
  EXPECT_EQ(hexagon.size(), 6U);
  EXPECT_NEAR(area(hexagon) * 4, 3 * std::sqrt(3) / 4, 1e-12);  // half height 2: NDC unit = 2 world units
  const auto triangle = hull_of_slab(body, rays, body.z_first + 0.1, body.z_first + 0.1);
  EXPECT_EQ(triangle.size(), 3U);
  EXPECT_NEAR(area(triangle) * 4, 0.5 * 3 * std::sqrt(3) * 0.1 * 0.1, 1e-12);
  EXPECT_TRUE(hull_of_slab(body, rays, body.z_last + 0.1, body.z_last + 0.2).empty());
}

TEST(SliceGeometry, SectionsAlongAnAxisAreTheFace) {
  const Volume cube = unit_cube();
  View view = testing::view_at({0, 0, 3}, {0, 0, 0}, false);
  view.up = {0, 1, 0};
  const ViewRays rays = view_rays(cube, view, 100, 100);
  const Body body = visible_body(cube.extent(), rays, {});
  const Slabs slabs = slabs_of(body, 0.125);
  EXPECT_EQ(slabs.count, 8);
  double volume = 0;
  for (int k = 0; k < slabs.count; ++k) {
    const auto section = hull_of_slab(body, rays, slabs.middle(k), slabs.middle(k));
    EXPECT_EQ(section.size(), 4U);
    volume += area(section) * 4 * slabs.step;
  }
  EXPECT_NEAR(volume, 1, 1e-12);
}

TEST(SliceGeometry, SlabsAddUpToTheVolumeOfTheBox) {
  const Volume volume = testing::skewed_volume();
  const glm::dvec3 extent = volume.extent();
  const glm::dvec3 middle = glm::dvec3(volume.box_to_world() * glm::dvec4(0.5, 0.5, 0.5, 1));
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20; ++i) {
    const glm::dvec3 eye = middle + 5. * glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const ViewRays rays = view_rays(volume, testing::view_at(eye, middle, false), 100, 100);
    const Body body = visible_body(extent, rays, {});
    // Sections are piecewise quadratic in z: the midpoint rule of 1000 slabs is good to about 1e-6.
    const Slabs slabs = slabs_of(body, (body.z_last - body.z_first) / 1000);
    double sum = 0;
    for (int k = 0; k < slabs.count; ++k) {
      const auto section = hull_of_slab(body, rays, slabs.middle(k), slabs.middle(k));
      EXPECT_GE(section.size(), 3U);
      EXPECT_LE(section.size(), 6U);
      sum += area(section) * 4 * slabs.step;
    }
    EXPECT_NEAR(sum / (extent.x * extent.y * extent.z), 1, 1e-5);
  }
}

TEST(SliceGeometry, WholeSlabCoversEverySectionInIt) {
  const Volume cube = unit_cube();
  for (const bool perspective : {true, false}) {
    const ViewRays rays = rays_from(cube, {1.5, 1.1, 2.3}, perspective);
    const Body body = visible_body(cube.extent(), rays, {});
    const Slabs slabs = slabs_of(body, 0.21);
    for (int k = 0; k < slabs.count; ++k) {
      const double z0 = slabs.middle(k) - 0.105, z1 = z0 + 0.21;
      const auto hull = hull_of_slab(body, rays, z0, z1);
      for (int part = 0; part <= 8; ++part) {
        const double z = z0 + (z1 - z0) * part / 8;
        for (const glm::dvec2& p : hull_of_slab(body, rays, z, z)) EXPECT_TRUE(contains(hull, p, 1e-12));
      }
    }
  }
}

TEST(SliceGeometry, EyeInsideIsCutAtTheNearPlane) {
  const Volume cube = unit_cube();
  View view = testing::view_at({0.1, 0.05, 0.2}, {0, 0, 0}, true);
  const ViewRays rays = view_rays(cube, view, 100, 100);
  const Body body = visible_body(cube.extent(), rays, {});
  EXPECT_NEAR(body.z_first, rays.z_near, 1e-12);
  EXPECT_GT(rays.reference_depth + body.z_first, 0);
  for (const glm::dvec2& p : hull_of_slab(body, rays, body.z_first, body.z_first + 0.1)) {
    EXPECT_LE(std::abs(p.x), 1);
    EXPECT_LE(std::abs(p.y), 1);
  }
  view.near = 100;
  EXPECT_TRUE(visible_body(cube.extent(), view_rays(cube, view, 100, 100), {}).edges.empty());
}

TEST(SliceGeometry, ClipPlanesCutTheBody) {
  const Volume cube = unit_cube();
  const ViewRays rays = rays_from(cube, {0.4, 0.3, 3}, false);
  // A corner cut off: 12 edges and the three of the new triangle.
  const LocalPlane corner{glm::normalize(glm::dvec3(-1, -1, -1)), -0.5};
  EXPECT_EQ(visible_body(cube.extent(), rays, {corner}).edges.size(), 15U);
  // Half of it left.
  const Body half = visible_body(cube.extent(), rays, {{{1, 0, 0}, 0}});
  EXPECT_EQ(half.edges.size(), 12U);
  const Slabs slabs = slabs_of(half, (half.z_last - half.z_first) / 500);
  double sum = 0;
  for (int k = 0; k < slabs.count; ++k) {
    sum += area(hull_of_slab(half, rays, slabs.middle(k), slabs.middle(k))) * 4 * slabs.step;
  }
  EXPECT_NEAR(sum, 0.5, 1e-5);
  const Body none = visible_body(cube.extent(), rays, {{{1, 0, 0}, 2}});
  EXPECT_TRUE(none.edges.empty());
  EXPECT_EQ(slabs_of(none, 0.1).count, 0);
}

TEST(SliceGeometry, EdgeWhereTwoCutsMeetInside) {
  const Volume cube = unit_cube();
  View view = testing::view_at({0, 0, 3}, {0, 0, 0}, false);
  view.up = {0, 1, 0};
  const ViewRays rays = view_rays(cube, view, 100, 100);
  // What is left is the prism y >= |x|: its lower edge, along the view, is on no face of the box.
  const Body body = visible_body(cube.extent(), rays,
                                 {{glm::normalize(glm::dvec3(1, 1, 0)), 0}, {glm::normalize(glm::dvec3(-1, 1, 0)), 0}});
  for (const double z : {-0.4, 0., 0.3}) EXPECT_NEAR(area(hull_of_slab(body, rays, z, z)) * 4, 0.25, 1e-12);
}

TEST(SliceGeometry, VerticesLieOnTheirPlane) {
  const Volume cube = unit_cube();
  for (const bool perspective : {true, false}) {
    const ViewRays rays = rays_from(cube, {1.5, 1.1, 2.3}, perspective);
    const Body body = visible_body(cube.extent(), rays, {});
    const Slabs slabs = slabs_of(body, 0.25);
    SliceMesh near_first, far_first;
    build_slices(body, rays, slabs, false, true, near_first);
    build_slices(body, rays, slabs, false, false, far_first);
    EXPECT_EQ(near_first.polygons, slabs.count);
    EXPECT_EQ(near_first.vertices.size(), far_first.vertices.size());
    double last = -1e9;
    for (size_t i = 0; i < near_first.indices.size(); i += 3) {
      const SliceVertex& v = near_first.vertices[near_first.indices[i]];
      const glm::dvec3 box = rays.at(v.x, v.y, v.z) / cube.extent() + 0.5;
      const double slice = (v.z - slabs.first) / slabs.step - 0.5;
      EXPECT_NEAR(slice, std::round(slice), 1e-5);
      EXPECT_GE(slice, last - 1e-5);
      last = slice;
      // Inside of the box: the section, not the slab's outline.
      for (const double u : {box.x, box.y, box.z}) EXPECT_NEAR(u, 0.5, 0.5 + 1e-6);
    }
  }
}

}  // namespace
}  // namespace volumark
