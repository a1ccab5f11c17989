#include "scenes/volume.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "helpers.h"
#include "scenes/data/orientation.h"
#include "scenes/errors.h"

namespace volumark {
namespace {

Volume small() {
  Volume v;
  v.size = {3, 2, 1};
  v.type = VoxelType::I16;
  v.voxels = test::encode<int16_t>({-1, 2, 3, 4, 5, 600});
  v.spacing = {2, 3, 5};
  v.origin = {10, 20, 30};
  v.slope = 0.5;
  v.intercept = 1;
  return v;
}

TEST(Volume, ValuesAreScaledAndClampedToTheLattice) {
  const Volume v = small();
  EXPECT_EQ(v.at(0, 0, 0), 0.5);
  EXPECT_EQ(v.at(2, 1, 0), 301);
  EXPECT_EQ(v.at(99, 99, -5), 301);
  EXPECT_EQ(v.at(-1, -1, 7), 0.5);
}

// n samples span n - 1 cells; a single sample spans one spacing, centred on it.
TEST(Volume, BoxFollowsTheSamples) {
  const Volume v = small();
  EXPECT_EQ(v.extent(), glm::dvec3(4, 3, 5));
  const glm::dmat4 m = v.box_to_world();
  EXPECT_EQ(glm::dvec3(m * glm::dvec4(0, 0, 0.5, 1)), glm::dvec3(10, 20, 30));
  EXPECT_EQ(glm::dvec3(m * glm::dvec4(0, 0, 0, 1)), glm::dvec3(10, 20, 27.5));
  EXPECT_EQ(glm::dvec3(m * glm::dvec4(1, 1, 1, 1)), glm::dvec3(14, 23, 32.5));
  EXPECT_EQ(v.box_to_index({1, 1, 1}), glm::dvec3(2, 1, 0));
}

TEST(Volume, WorldToBoxIsTheInverse) {
  Volume v = small();
  v.axes = orthonormal({glm::dvec3(1, 2, 3), glm::dvec3(-2, 1, 0), glm::dvec3(3, 6, -5)});
  const glm::dmat4 product = v.world_to_box() * v.box_to_world();
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) EXPECT_NEAR(product[c][r], c == r ? 1 : 0, 1e-14);
  }
}

TEST(Volume, AllTypesReadBack) {
  Volume v;
  v.size = {2, 1, 1};
  const auto expect = [&](VoxelType type, test::Bytes voxels, double a, double b) {
    v.type = type;
    v.voxels = std::move(voxels);
    EXPECT_EQ(v.voxels.size(), 2 * voxel_bytes(type)) << to_string(type);
    EXPECT_EQ(v.at(0, 0, 0), a) << to_string(type);
    EXPECT_EQ(v.at(1, 0, 0), b) << to_string(type);
  };
  expect(VoxelType::U8, test::encode<uint8_t>({0, 255}), 0, 255);
  expect(VoxelType::U16, test::encode<uint16_t>({7, 65535}), 7, 65535);
  expect(VoxelType::I16, test::encode<int16_t>({-32768, 32767}), -32768, 32767);
  expect(VoxelType::F32, test::encode<float>({-0.25f, 1e30f}), -0.25, static_cast<double>(1e30f));
}

TEST(Orientation, StepsGiveSpacingAndAxes) {
  Volume v;
  set_steps(v, {glm::dvec3(0, 2, 0), glm::dvec3(-3, 0, 0), glm::dvec3(0, 0, -4)}, "file");
  EXPECT_EQ(v.spacing, glm::dvec3(2, 3, 4));
  EXPECT_EQ(v.axes[0], glm::dvec3(0, 1, 0));
  EXPECT_EQ(v.axes[1], glm::dvec3(-1, 0, 0));
  EXPECT_EQ(v.axes[2], glm::dvec3(0, 0, -1));  // a reflection stays one
}

TEST(Orientation, ShearAndZeroStepsAreRefused) {
  Volume v;
  EXPECT_THAT(test::message_of<DataError>([&] {
                set_steps(v, {{1, 0, 0}, {0.5, 1, 0}, {0, 0, 1}}, "sheared.nii");
              }),
              testing::AllOf(testing::HasSubstr("sheared.nii"), testing::HasSubstr("right angles")));
  EXPECT_THAT(test::message_of<DataError>([&] {
                set_steps(v, {{1, 0, 0}, {0, 0, 0}, {0, 0, 1}}, "flat.nii");
              }),
              testing::HasSubstr("axis 1"));
}

}  // namespace
}  // namespace volumark
