// Brick ranges and distances against brute force.
#include "methods/raycast/bricks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

namespace volumark {
namespace {

Volume random_volume(glm::ivec3 size, unsigned seed) {
  Volume volume;
  volume.size = size;
  volume.type = VoxelType::U8;
  volume.slope = -0.5;
  volume.intercept = 3;
  volume.voxels.resize(static_cast<size_t>(size.x) * static_cast<size_t>(size.y) * static_cast<size_t>(size.z));
  std::mt19937 random(seed);
  for (std::byte& voxel : volume.voxels) voxel = static_cast<std::byte>(random() % 256);
  return volume;
}

TransferFunction peak(double lo, double top, double hi) {
  TransferFunction transfer;
  transfer.lo = -125;
  transfer.hi = 5;
  transfer.points = {{lo, glm::dvec3(1), 0}, {top, glm::dvec3(1), 4}, {hi, glm::dvec3(1), 0}};
  return transfer;
}

TEST(Bricks, RangesHoldTheSamplesOfTheirCells) {
  for (const glm::ivec3 size : {glm::ivec3(9, 10, 13), glm::ivec3(1, 5, 2), glm::ivec3(8, 8, 8), glm::ivec3(1, 1, 1)}) {
    const Volume volume = random_volume(size, 5);
    for (const int edge : {1, 2, 4, 7}) {
      const BrickRanges ranges = brick_ranges(volume, edge);
      for (int z = 0; z < ranges.count.z; ++z) {
        for (int y = 0; y < ranges.count.y; ++y) {
          for (int x = 0; x < ranges.count.x; ++x) {
            double lo = INFINITY, hi = -INFINITY;
            for (int k = z * edge; k <= std::min((z + 1) * edge, size.z - 1); ++k) {
              for (int j = y * edge; j <= std::min((y + 1) * edge, size.y - 1); ++j) {
                for (int i = x * edge; i <= std::min((x + 1) * edge, size.x - 1); ++i) {
                  lo = std::min(lo, volume.at(i, j, k));
                  hi = std::max(hi, volume.at(i, j, k));
                }
              }
            }
            ASSERT_EQ(static_cast<double>(ranges.lo[ranges.index(x, y, z)]), lo) << edge;
            ASSERT_EQ(static_cast<double>(ranges.hi[ranges.index(x, y, z)]), hi) << edge;
          }
        }
      }
      EXPECT_GE(ranges.count.x * edge, size.x - 1);
      EXPECT_LT((ranges.count.x - 1) * edge, std::max(size.x - 1, 1));
    }
  }
}

TEST(Bricks, DistancesAreTheChebyshevDistances) {
  BrickRanges ranges;
  ranges.edge = 4;
  ranges.count = {11, 7, 9};
  std::mt19937 random(3);
  const size_t bricks = 11 * 7 * 9;
  for (size_t i = 0; i < bricks; ++i) {
    const float value = random() % 60 == 0 ? 0.f : -50.f;
    ranges.lo.push_back(value);
    ranges.hi.push_back(value);
  }
  const BrickDistances found = brick_distances(ranges, OpaqueValues(peak(-2, 0, 2), Classification::Post, 1021), 0);
  for (int z = 0; z < 9; ++z) {
    for (int y = 0; y < 7; ++y) {
      for (int x = 0; x < 11; ++x) {
        int nearest = 255;
        for (int k = 0; k < 9; ++k) {
          for (int j = 0; j < 7; ++j) {
            for (int i = 0; i < 11; ++i) {
              if (ranges.lo[ranges.index(i, j, k)] != 0.f) continue;
              nearest = std::min(nearest, std::max({std::abs(i - x), std::abs(j - y), std::abs(k - z)}));
            }
          }
        }
        ASSERT_EQ(found.distance[ranges.index(x, y, z)], nearest) << x << " " << y << " " << z;
      }
    }
  }
  EXPECT_EQ(found.occupied, std::count(ranges.lo.begin(), ranges.lo.end(), 0.f));
}

TEST(OpaqueValues, NoOpaqueValueIsMissed) {
  const TransferFunction transfer = peak(-60.2, -59.9, -57.3);
  for (const auto classification : {Classification::Post, Classification::Preintegrated}) {
    for (const int nodes : {2, 7, 64, 1021}) {
      const OpaqueValues opaque(transfer, classification, nodes);
      for (double value = -130; value < 10; value += 0.05) {
        // What a linear look-up reads in the post-classification table, or an exact segment of one value.
        const double node = std::clamp((value + 125) / 130 * (nodes - 1), 0.0, nodes - 1.0);
        const double below = -125 + std::floor(node) * 130 / (nodes - 1),
                     above = -125 + std::ceil(node) * 130 / (nodes - 1);
        const bool visible = transfer.at(below).a > 0 || transfer.at(above).a > 0;
        if (visible) {
          EXPECT_TRUE(opaque.any(value, value)) << value << " nodes " << nodes;
        }
        if (transfer.at(value).a > 0 && classification == Classification::Preintegrated) {
          EXPECT_TRUE(opaque.any(value, value)) << value << " nodes " << nodes;
        }
        if (opaque.any(value, value)) {
          const double normalised = (value + 125) / 130;
          EXPECT_GT(normalised, static_cast<double>(opaque.window().lo));
          EXPECT_LT(normalised, static_cast<double>(opaque.window().hi));
        }
      }
      // Coarse tables spread the peak, and point samples at the window's two ends miss it.
      const bool missed = nodes == 2 && classification == Classification::Post;
      EXPECT_EQ(opaque.any(-125, -62), nodes < 64 && !missed) << nodes;
    }
  }
}

TEST(OpaqueValues, ValuesBeyondTheWindowReadItsEnds) {
  TransferFunction ramp;
  ramp.points = {{0, glm::dvec3(1), 0}, {1, glm::dvec3(1), 1}};
  const OpaqueValues opaque(ramp, Classification::Post, 11);
  EXPECT_TRUE(opaque.any(7, 9));
  EXPECT_FALSE(opaque.any(-7, -1));
  EXPECT_FALSE(opaque.any(0, 0));
  EXPECT_TRUE(opaque.any(0, 0.01));
  EXPECT_EQ(opaque.window().hi, INFINITY);
}

TEST(OpaqueValues, AnEmptyTableHasAnEmptyWindow) {
  TransferFunction clear;
  clear.points = {{0, glm::dvec3(1), 0}};
  const OpaqueValues opaque(clear, Classification::Post, 11);
  EXPECT_FALSE(opaque.any(-10, 10));
  EXPECT_GE(opaque.window().lo, opaque.window().hi);
}

}  // namespace
}  // namespace volumark
