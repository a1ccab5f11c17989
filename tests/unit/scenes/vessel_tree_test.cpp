#include "scenes/vessel_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/procedural.h"

namespace volumark {
namespace {

using Segment = VesselTree::Segment;
const glm::dvec3 kHalf(1, 1, 0.5);

TEST(VesselTree, IsSeededAndUsesItsRange) {
  const auto tree = [](uint32_t seed) {
    VesselTreeField field;
    field.seed = seed;
    return make_volume({field, {48, 48, 24}, VoxelType::U8, 2});
  };
  const Volume a = tree(3);
  EXPECT_EQ(a.voxels, tree(3).voxels);
  EXPECT_NE(a.voxels, tree(4).voxels);
  EXPECT_EQ(a.min_value, 0);
  EXPECT_EQ(a.max_value, 1);
}

// The value by its definition, of all segments: the look-up grid leaves none out.
TEST(VesselTree, TheGridLosesNoSegment) {
  const VesselTreeField field;
  const VesselTree tree(field, kHalf);
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {  // a Kronecker sequence: spread evenly, also outside of the box
    const glm::dvec3 u = glm::fract(glm::dvec3(0.8191725134, 0.6710436067, 0.5497004779) * static_cast<double>(i));
    const glm::dvec3 p = (u * 2.1 - 1.05) * kHalf;
    double distance = 1e9;
    for (const Segment& s : tree.segments()) {
      const glm::dvec3 along = s.to - s.from;
      const double squared = glm::dot(along, along);
      const double t = squared > 0 ? std::clamp(glm::dot(p - s.from, along) / squared, 0.0, 1.0) : 0;
      distance =
          std::min(distance, glm::length(p - s.from - along * t) - (s.radius_from + t * (s.radius_to - s.radius_from)));
    }
    const double x = std::clamp((distance + field.softness) / (2 * field.softness), 0.0, 1.0);
    const double expected = 1 - x * x * (3 - 2 * x);
    EXPECT_NEAR(tree.value(p), expected, 1e-12) << i;
    inside += expected > 0.5 ? 1 : 0;
  }
  EXPECT_GT(inside, 50);
}

// Where a vessel ends two begin, and the cubes of their radii add up to the cube of its own.
TEST(VesselTree, ForksFollowMurraysLaw) {
  VesselTreeField field;
  field.aneurysm = 0;
  field.generations = 6;
  const VesselTree tree(field, kHalf);
  int forks = 0, tips = 0;
  for (const Segment& s : tree.segments()) {
    double cubes = 0;
    int children = 0;
    for (const Segment& child : tree.segments()) {
      if (child.from != s.to) continue;
      ++children;
      cubes += std::pow(child.radius_from, 3);
    }
    tips += children == 0 ? 1 : 0;
    forks += children == 2 ? 1 : 0;
    ASSERT_LE(children, 2);
    if (children > 0) {
      EXPECT_NEAR(cubes, std::pow(s.radius_to, 3), 1e-12);
    }
  }
  EXPECT_EQ(forks, 63);  // 2^6 - 1
  EXPECT_EQ(tips, 64);
}

TEST(VesselTree, AnAneurysmBulgesAndTheTreeStaysInItsBox) {
  const VesselTreeField field;
  const VesselTree tree(field, kHalf);
  const auto ball =
      std::find_if(tree.segments().begin(), tree.segments().end(), [](const Segment& s) { return s.from == s.to; });
  ASSERT_NE(ball, tree.segments().end());
  EXPECT_GT(ball->radius_from, 1.2 * field.radius);
  EXPECT_EQ(tree.value(ball->from), 1);
  for (const Segment& s : tree.segments()) {
    EXPECT_LE(std::abs(s.to.x), 1.0);
    EXPECT_LE(std::abs(s.to.z), 0.55);
  }
}

}  // namespace
}  // namespace volumark
