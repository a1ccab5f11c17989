// Stacks, the choice among them, and the polygons of slices2d: host code, no driver.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "backends/backend.h"
#include "methods/slices2d/slice_polygons.h"
#include "test_scene.h"

namespace volumark {
namespace {

// ---- Pages ----

TEST(StackLayout, PagesHoldEverySliceAndShareTwo) {
  for (const glm::ivec3 size : {glm::ivec3(256, 256, 256), glm::ivec3(300, 5, 2000), glm::ivec3(1, 1, 1),
                                glm::ivec3(1, 9, 70), glm::ivec3(3000, 2100, 3)}) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto layout = stack_layout(size, axis, 16384);
      ASSERT_TRUE(layout);
      EXPECT_EQ(layout->slices, size[axis]);
      EXPECT_EQ(layout->slice, glm::ivec2(size[(axis + 1) % 3], size[(axis + 2) % 3]));
      int next = 0;
      for (const StackPage& page : layout->pages) {
        EXPECT_EQ(page.first, next);
        EXPECT_GE(page.columns * page.rows, page.last - page.first + 1);
        EXPECT_LT((page.rows - 1) * page.columns, page.last - page.first + 1) << "no row is empty";
        const glm::ivec2 extent = layout->extent(page);
        EXPECT_LE(std::max(extent.x, extent.y), std::max(kPageExtent, 3 * (2100 + 2)));
        next = page.last - 1;
      }
      EXPECT_EQ(layout->pages.back().last, size[axis] - 1);
    }
  }
}

TEST(StackLayout, MoreThanOnePageWhereOneWouldBeTooLarge) {
  EXPECT_EQ(stack_layout({128, 128, 128}, 2, 16384)->pages.size(), 1U);
  EXPECT_EQ(stack_layout({256, 256, 256}, 2, 16384)->pages.size(), 2U);
  EXPECT_EQ(stack_layout({2100, 2100, 4}, 2, 16384)->pages.size(), 2U) << "three slices a page at least";
}

TEST(StackLayout, RefusesWhatDoesNotFit) {
  EXPECT_FALSE(stack_layout({5000, 5000, 4}, 2, 8192)) << "not three of these";
  EXPECT_TRUE(stack_layout({5000, 5000, 1}, 2, 8192)) << "but one";
  EXPECT_FALSE(stack_layout({9000, 10, 1}, 2, 8192));
}

// ---- Memory: what the pages hold, in bytes, is what the Device has been asked for ----

TEST(SliceStacks, ThreeStacksAreCounted) {
  Device device(make_null_backend({}));
  const Scene scene =
      testing::scene_of(testing::volume_of<uint8_t>({6, 10, 14}, VoxelType::U8, std::vector<uint8_t>(840, 1)));
  VolumeSettings settings;
  settings.table_size = 8;
  {
    const SliceStacks stacks(scene, settings, device);
    size_t tiles = 0;
    for (int axis = 0; axis < 3; ++axis) tiles += stacks.layout(axis).texels();
    // Tiles have a gutter of one texel all round; a page is full but for its last row.
    EXPECT_GE(tiles, 6U * 12 * 16 + 10U * 8 * 16 + 14U * 8 * 12);
    EXPECT_EQ(stacks.texture_bytes(), tiles + 8 * 16) << "and the transfer table";
    EXPECT_EQ(device.live_bytes(), stacks.texture_bytes());
  }
  EXPECT_EQ(device.live_bytes(), 0U);
}

// ---- Where slices lie ----

TEST(Slices, StoredOnesAtOneHundredPercent) {
  const Slices slices = slices_of(5, 100);
  ASSERT_EQ(slices.count, 5);
  for (int k = 0; k < 5; ++k) EXPECT_DOUBLE_EQ(slices.position(k), k / 4.);
}

TEST(Slices, FourHundredPercentIsThreeBetweenEachTwo) {
  const Slices slices = slices_of(5, 400);
  EXPECT_EQ(slices.count, 17);
  EXPECT_DOUBLE_EQ(slices.stored_at(3), 0.75);
  EXPECT_DOUBLE_EQ(slices.stored_at(16), 4);
  EXPECT_DOUBLE_EQ(slices.position(16), 1);
}

TEST(Slices, OneStoredSliceFillsTheBox) {
  const Slices slices = slices_of(1, 400);
  EXPECT_EQ(slices.count, 4);
  EXPECT_DOUBLE_EQ(slices.position(-0.5), 0);
  EXPECT_DOUBLE_EQ(slices.position(3.5), 1);
  EXPECT_DOUBLE_EQ(slices.stored_at(3), 0);
}

TEST(Slices, FewerThanTheStoredOnes) {
  const Slices one = slices_of(5, 10);
  EXPECT_EQ(one.count, 1);
  EXPECT_DOUBLE_EQ(one.stored_at(0), 2) << "in the middle";
  EXPECT_EQ(slices_of(5, 50).count, 3);
}

TEST(Slices, SlabsFillTheBoxForAnyPercentage) {
  for (const int64_t percent : {25, 100, 130, 470, 800}) {
    for (const int stored : {1, 2, 3, 64}) {
      const Slices slices = slices_of(stored, percent);
      EXPECT_LE(slices.position(-0.5), 1e-12);
      EXPECT_GE(slices.position(slices.count - 0.5), 1 - 1e-12);
    }
  }
}

// ---- Choice of the stack ----

Volume cube(const glm::dvec3& spacing = glm::dvec3(1)) {
  Volume volume = testing::volume_of<uint8_t>({9, 9, 9}, VoxelType::U8, std::vector<uint8_t>(729, 1));
  volume.spacing = spacing;
  volume.origin = -4. * spacing;
  return volume;
}
int stack_from(const Volume& volume, const glm::dvec3& eye, bool perspective = true) {
  return best_stack(volume, view_rays(volume, testing::view_at(eye, {0, 0, 0}, perspective), 100, 100));
}

TEST(BestStack, SmallestAngleToTheNormal) {
  for (const bool perspective : {true, false}) {
    EXPECT_EQ(stack_from(cube(), {-30, 2, 3}, perspective), 0);
    EXPECT_EQ(stack_from(cube(), {2, 30, 3}, perspective), 1);
    EXPECT_EQ(stack_from(cube(), {2, 3, -30}, perspective), 2);
  }
}

TEST(BestStack, TiesGoToTheOrderOfStorage) {
  for (const bool perspective : {true, false}) {
    EXPECT_EQ(stack_from(cube(), {20, 0, 20}, perspective), 2);
    EXPECT_EQ(stack_from(cube(), {-20, 20, 0}, perspective), 1);
    EXPECT_EQ(stack_from(cube(), {20, 20, 20}, perspective), 2);
  }
  EXPECT_EQ(stack_from(cube(), {20.001, 0, 20}), 0) << "just past the tie";
}

TEST(BestStack, ThickSlicesOnlyWhereTheViewMeetsThemSteeply) {
  const Volume thick = cube({1, 1, 5});
  EXPECT_EQ(stack_from(thick, {50, 0, 60}, false), 0) << "50 degrees to i, 40 to k: 1.6 voxels against 6.4";
  EXPECT_EQ(stack_from(thick, {10, 0, 60}, false), 2);
  EXPECT_EQ(stack_from(thick, {12, 0, 60}, false), 2) << "the tie: 1 / sin = 5 / cos";
  EXPECT_EQ(stack_from(thick, {12.01, 0, 60}, false), 0);
}

TEST(BestStack, FromInsideTheDirectionOfViewDecides) {
  View view = testing::view_at({0.1, 0.2, 0.3}, {0.1, 10, 0.3}, true);
  EXPECT_EQ(best_stack(cube(), view_rays(cube(), view, 100, 100)), 1);
  view = testing::view_at({30, 0, 0}, {30, 0, 10}, true);  // looks past the volume
  EXPECT_EQ(best_stack(cube(), view_rays(cube(), view, 100, 100)), 2);
}

// ---- Order and groups ----

struct Stack {
  Volume volume = cube();
  StackLayout layout = *stack_layout({9, 9, 9}, 2, 16384);
  glm::dvec3 extent{8};
  std::vector<SliceGroup> groups(const glm::dvec3& eye, bool perspective, int textures, int64_t percent = 100) const {
    const ViewRays rays = view_rays(volume, testing::view_at(eye, {0, 0, 0}, perspective), 100, 100);
    return slice_groups(slices_of(9, percent), layout, rays, extent, textures);
  }
};
std::vector<int> drawn(const std::vector<SliceGroup>& groups) {
  std::vector<int> out;
  for (const SliceGroup& group : groups)
    for (int i = 0; i < group.count; ++i) out.push_back(group.first + group.direction * i);
  return out;
}

TEST(SliceGroups, BackToFrontFromEitherSide) {
  const Stack stack;
  for (const bool perspective : {true, false}) {
    EXPECT_EQ(drawn(stack.groups({1, 2, 30}, perspective, 1)), (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
    EXPECT_EQ(drawn(stack.groups({1, 2, -30}, perspective, 1)), (std::vector<int>{8, 7, 6, 5, 4, 3, 2, 1, 0}));
  }
}

TEST(SliceGroups, FromInsideBothEndsFirstAndTheEyesSlabLast) {
  const Stack stack;
  EXPECT_EQ(drawn(stack.groups({1, 2, 0.6}, true, 2)), (std::vector<int>{8, 7, 6, 0, 1, 2, 3, 4, 5}));
  // The eye on a slice (z = 1 is slice 5) and on the face between two slabs.
  EXPECT_EQ(drawn(stack.groups({1, 2, 1}, true, 2)), (std::vector<int>{8, 7, 6, 0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(drawn(stack.groups({1, 2, 0.5}, true, 2)), (std::vector<int>{8, 7, 6, 5, 0, 1, 2, 3, 4}));
}

TEST(SliceGroups, EverySliceOnceInGroupsOfOnePage) {
  const auto layout = *stack_layout({256, 256, 256}, 2, 16384);
  Volume volume = cube();
  const ViewRays rays = view_rays(volume, testing::view_at({1, 2, 0.3}, {0, 0, 0}, true), 100, 100);
  const Slices slices = slices_of(256, 170);
  const auto groups = slice_groups(slices, layout, rays, glm::dvec3(8), 4);
  std::vector<int> all = drawn(groups);
  std::set<int> pages;
  for (const SliceGroup& group : groups) {
    EXPECT_LE(group.count, 4);
    pages.insert(group.page);
    const StackPage& page = layout.pages[static_cast<size_t>(group.page)];
    for (int i = 0; i < group.count; ++i) {
      // All that lies half a stored slice around it, as far as the stack goes.
      const double at = slices.stored_at(group.first + group.direction * i);
      EXPECT_GE(std::floor(std::max(at - 0.5, 0.) + 1e-9), page.first);
      EXPECT_LE(std::ceil(std::min(at + 0.5, 255.) - 1e-9), page.last);
    }
  }
  EXPECT_EQ(pages.size(), 2U);
  std::sort(all.begin(), all.end());
  ASSERT_EQ(all.size(), static_cast<size_t>(slices.count));
  for (int k = 0; k < slices.count; ++k) EXPECT_EQ(all[static_cast<size_t>(k)], k);
}

// Every point of a group's slabs that lies in front of the near plane is inside the group's polygon.
TEST(BuildGroups, PolygonsCoverTheirSlabs) {
  const Volume volume = cube();
  const StackLayout layout = *stack_layout({9, 9, 9}, 2, 16384);
  const glm::dvec3 extent(8);
  const Slices slices = slices_of(9, 100);
  for (const glm::dvec3 eye : {glm::dvec3(9, 4, 12), glm::dvec3(1, 2, 0.5), glm::dvec3(0.3, 3, 4)}) {
    const ViewRays rays = view_rays(volume, testing::view_at(eye, {0, 0, 0.2}, true), 100, 100);
    const auto groups = slice_groups(slices, layout, rays, extent, 2);
    int tested = 0;
    for (const SliceGroup& group : groups) {
      SliceGroupMesh mesh;
      build_groups(slices, {group}, rays, extent, true, {1e-9, 1e-9}, mesh);
      for (int i = 0; i < 500; ++i) {
        const double u = (i % 10) / 9., v = (i / 10 % 10) / 9., w = (i / 100) / 4.;
        const double last = group.first + group.direction * (group.count - 1);
        const double z = std::clamp(
            slices.position(std::min<double>(group.first, last) - 0.5) + w * group.count * slices.distance, 0., 1.);
        const glm::dvec3 p = (glm::dvec3(u, v, z) - 0.5) * extent;
        const double depth = glm::dot(p - rays.eye, rays.forward);
        if (depth < 0.02) continue;
        const glm::dvec3 q = (p - rays.eye) / depth;
        const glm::dvec2 ndc(glm::dot(q, rays.direction_x) / glm::dot(rays.direction_x, rays.direction_x),
                             glm::dot(q, rays.direction_y) / glm::dot(rays.direction_y, rays.direction_y));
        if (std::max(std::abs(ndc.x), std::abs(ndc.y)) > 1) continue;
        ++tested;
        ASSERT_FALSE(mesh.vertices.empty());
        for (size_t a = 0; a < mesh.vertices.size(); ++a) {
          const PolygonVertex &from = mesh.vertices[a], &to = mesh.vertices[(a + 1) % mesh.vertices.size()];
          const double side = (static_cast<double>(to.x) - from.x) * (ndc.y - from.y) -
                              (static_cast<double>(to.y) - from.y) * (ndc.x - from.x);
          EXPECT_GE(side, -1e-6);  // vertices are floats
        }
      }
    }
    EXPECT_GT(tested, 200);
  }
}

}  // namespace
}  // namespace volumark
