#include "scenes/procedural.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scenes/sha256.h"

namespace volumark {
namespace {

TEST(Procedural, LatticeIsCentredWithTheLongestAxisOnTheExtent) {
  const Volume v = make_volume({ConstantField{}, {65, 33, 1}, VoxelType::F32, 2});
  EXPECT_EQ(v.spacing, glm::dvec3(2.0 / 64));
  EXPECT_EQ(v.extent(), glm::dvec3(2, 1, 2.0 / 64));
  const glm::dvec3 centre(v.box_to_world() * glm::dvec4(0.5, 0.5, 0.5, 1));
  EXPECT_NEAR(glm::length(centre), 0, 1e-15);
}

TEST(Procedural, OneSampleIsAllowed) {
  const Volume v = make_volume({ConstantField{3}, {1, 1, 1}, VoxelType::U8, 2});
  EXPECT_EQ(v.extent(), glm::dvec3(2));
  EXPECT_NEAR(v.at(0, 0, 0), 3, 1e-12);
}

TEST(Procedural, ConstantKeepsItsValueInEveryType) {
  for (const VoxelType type : {VoxelType::U8, VoxelType::U16, VoxelType::I16, VoxelType::F32}) {
    const Volume v = make_volume({ConstantField{-2.5}, {2, 3, 4}, type, 2});
    EXPECT_NEAR(v.min_value, -2.5, 1e-12);
    EXPECT_NEAR(v.max_value, -2.5, 1e-12);
  }
}

TEST(Procedural, RampIsLinearAndHitsItsEnds) {
  const Volume v = make_volume({RampField{1, 10, -6}, {2, 9, 3}, VoxelType::F32, 2});
  for (int j = 0; j < 9; ++j) EXPECT_EQ(v.at(1, j, 2), 10 - 2 * j);
}

TEST(Procedural, DistanceInWorldUnits) {
  const Volume v = make_volume({DistanceField{}, glm::ivec3(9), VoxelType::F32, 6});
  EXPECT_EQ(v.at(4, 4, 4), 0);
  EXPECT_EQ(v.at(8, 4, 4), 3);
  EXPECT_NEAR(v.at(0, 0, 0), 3 * std::sqrt(3.0), 1e-6);
  EXPECT_NEAR(field_range({DistanceField{}, glm::ivec3(9), VoxelType::F32, 6}).hi, 3 * std::sqrt(3.0), 1e-12);
}

// Trilinear interpolation of a distance lies above it, by at most h^2 / (4 r).
TEST(Procedural, DistanceInterpolationErrorIsOneSidedAndBounded) {
  const int n = 33;
  const Volume v = make_volume({DistanceField{}, glm::ivec3(n), VoxelType::F32, 2});
  const double h = v.spacing.x, rounding = 1e-7;
  double worst = 0;
  for (int k = 0; k < n - 1; ++k) {
    for (int j = 0; j < n - 1; ++j) {
      for (int i = 0; i < n - 1; ++i) {
        double mean = 0;
        for (int c = 0; c < 8; ++c) mean += v.at(i + (c & 1), j + ((c >> 1) & 1), k + (c >> 2)) / 8;
        const double r = glm::length(v.origin + (glm::dvec3(i, j, k) + 0.5) * h);
        if (r < 4 * h) continue;
        EXPECT_GE(mean, r - rounding);
        EXPECT_LE(mean, r + h * h / (4 * r) * 1.02 + rounding);
        worst = std::max(worst, (mean - r) / (h * h / (4 * r)));
      }
    }
  }
  EXPECT_GT(worst, 0.9);  // the bound is not idle
}

TEST(Procedural, MarschnerLobbKnownValues) {
  const MarschnerLobbField f;
  // At the axis cos(pi r / 2) = 1: rho_r = cos(12 pi) = 1.
  EXPECT_NEAR(marschner_lobb(f, {0, 0, 0}), (1 + 0.25 * 2) / 2.5, 1e-12);
  EXPECT_NEAR(marschner_lobb(f, {0, 0, 1}), 0.25 * 2 / 2.5, 1e-12);
  EXPECT_NEAR(marschner_lobb(f, {0, 0, -1}), 1, 1e-12);
  // r = 1: cos(pi / 2) = 0, rho_r = cos(0) = 1. r = 1/2: rho_r = cos(12 pi cos(pi / 4)).
  EXPECT_NEAR(marschner_lobb(f, {1, 0, 0}), 0.6, 1e-12);
  const double rho = std::cos(12 * std::numbers::pi * std::sqrt(0.5));
  EXPECT_NEAR(marschner_lobb(f, {0.3, 0.4, 0}), (1 + 0.25 * (1 + rho)) / 2.5, 1e-12);
}

TEST(Procedural, IntegerTypesKeepTheFieldsUnits) {
  const ProceduralSpec exact{MarschnerLobbField{}, glm::ivec3(17), VoxelType::F32, 2};
  const Volume reference = make_volume(exact);
  for (const auto& [type, levels] : {std::pair(VoxelType::U8, 255), std::pair(VoxelType::I16, 32767)}) {
    ProceduralSpec spec = exact;
    spec.type = type;
    const Volume v = make_volume(spec);
    double worst = 0;
    for (int i = 0; i < 17 * 17 * 17; ++i) {
      const int x = i % 17, y = i / 17 % 17, z = i / 289;
      worst = std::max(worst, std::abs(v.at(x, y, z) - reference.at(x, y, z)));
    }
    EXPECT_LE(worst, 0.5 / levels + 1e-7);
    EXPECT_GT(worst, 0.4 / levels);
  }
}

TEST(Procedural, CloudIsSeededAndInRange) {
  const auto cloud = [](uint32_t seed) {
    PerlinCloudField field;
    field.seed = seed;
    return make_volume({field, glm::ivec3(24), VoxelType::F32, 2});
  };
  EXPECT_EQ(cloud(5).voxels, cloud(5).voxels);
  EXPECT_NE(cloud(5).voxels, cloud(6).voxels);
  EXPECT_GT(cloud(5).min_value, 0);
  EXPECT_LT(cloud(5).max_value, 1);
  EXPECT_GT(cloud(5).max_value - cloud(5).min_value, 0.5);
}

// Quintic fade: value and gradient go through lattice planes without a step.
TEST(Procedural, CloudIsSmoothAcrossLatticePlanes) {
  PerlinCloudField f;
  f.frequency = 4;
  const double plane = 0.25, e = 1e-6;  // frequency * plane = 1
  const auto at = [&](double x) { return perlin_cloud(f, {x, 0.13, -0.21}); };
  EXPECT_NEAR(at(plane - 1e-9), at(plane + 1e-9), 1e-6);
  const double before = (at(plane - e) - at(plane - 2 * e)) / e, after = (at(plane + 2 * e) - at(plane + e)) / e;
  EXPECT_NEAR(before, after, 1e-2);
}

}  // namespace
}  // namespace volumark
