// The pieces that the reference is made of.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "methods/reference/lattice.h"
#include "methods/reference/polynomial.h"
#include "methods/reference/quadrature.h"
#include "methods/reference/transfer_pieces.h"
#include "tests/unit/reference/brute_force.h"

namespace volumark::test {
namespace {

TEST(Polynomial, FindsSignChangesInOrder) {
  const double cubic[] = {-0.006, 0.11, -0.6, 1};  // roots .1, .2, .3
  const Roots all = roots_between(cubic, 0, 1);
  ASSERT_EQ(all.count, 3);
  for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(all.at[i], 0.1 * static_cast<double>(i + 1), 1e-13);
  EXPECT_EQ(roots_between(cubic, 0.15, 0.25).count, 1);
  const double touching[] = {0.25, -1, 1};  // (u - 1/2)^2
  EXPECT_EQ(roots_between(touching, 0, 1).count, 0);
  const double quartic[] = {0.0024, -0.05, 0.35, -1, 1};  // roots .1, .2, .3, .4
  EXPECT_EQ(roots_between(quartic, 0, 1).count, 4);
  const double zero[] = {0, 0, 0, 0};
  EXPECT_EQ(roots_between(zero, 0, 1).count, 0);
  const double linear[] = {-0.25, 1, 0, 0};
  ASSERT_EQ(roots_between(linear, 0, 1).count, 1);
  EXPECT_DOUBLE_EQ(roots_between(linear, 0, 1).at[0], 0.25);
}

TEST(Polynomial, OneSignMeansNoZero) {
  std::mt19937_64 random(6);
  std::normal_distribution<double> normal;
  int one_sign = 0;
  for (int i = 0; i < 2000; ++i) {
    std::array<double, 5> c;
    for (double& k : c) k = normal(random);
    c[0] *= 4;
    const std::span<const double> polynomial(c.data(), i % 2 ? 4 : 5);
    if (!one_sign_on_unit(polynomial)) continue;
    ++one_sign;
    EXPECT_EQ(roots_between(polynomial, 0, 1).count, 0);
  }
  EXPECT_GT(one_sign, 500);
  const double above[] = {1, -1.5, 0.6, 0};
  EXPECT_TRUE(one_sign_on_unit(above));
}

TEST(Polynomial, SolvesMonotoneCubics) {
  const Cubic steep{0, 1e-9, 0, 1};  // nearly flat at 0
  for (const double value : {1e-12, 1e-6, 0.3, 0.999}) {
    const double u = solve_monotone(steep, value, 0, 1);
    EXPECT_NEAR(evaluate(steep, u), value, 1e-15);
  }
}

TEST(Quadrature, GaussRulesAreExactToTheirDegree) {
  for (int n = 1; n <= kMaxNodes; ++n) {
    const GaussRule& rule = gauss_rule(n);
    for (int degree = 0; degree < 2 * n; ++degree) {
      double sum = 0;
      for (size_t i = 0; i < static_cast<size_t>(n); ++i) sum += rule.weight[i] * std::pow(rule.node[i], degree);
      EXPECT_NEAR(sum, degree % 2 ? 0 : 2.0 / (degree + 1), 1e-14) << n << " nodes, degree " << degree;
    }
  }
}

TEST(Quadrature, PattersonRulesAreExactToTheirDegree) {
  for (int degree = 0; degree <= 22; degree += 2) {
    double sum3 = 0, sum7 = 0, sum15 = 0;
    for (const PattersonPoint& p : kPatterson) {
      const double power = std::pow(p.node, degree);
      sum3 += p.weight3 * power;
      sum7 += p.weight7 * power;
      sum15 += p.weight15 * power;
    }
    const double exact = 2.0 / (degree + 1);
    if (degree <= 5) {
      EXPECT_NEAR(sum3, exact, 1e-14);
    }
    if (degree <= 11) {
      EXPECT_NEAR(sum7, exact, 1e-14);
    }
    EXPECT_NEAR(sum15, exact, 1e-14) << degree;
  }
}

TEST(Quadrature, ChosenNodesKeepTheirPromise) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  int chosen = 0;
  for (int i = 0; i < 400; ++i) {
    const double scale = std::pow(10.0, -3 + i % 5);
    Quartic depth{};
    for (size_t k = 1; k < 5; ++k) depth[k] = scale * normal(random);
    const Quadratic p{normal(random), normal(random), normal(random)};
    auto integrate = [&](int nodes) {
      double sum = 0;
      const GaussRule& rule = gauss_rule(nodes);
      for (size_t k = 0; k < static_cast<size_t>(nodes); ++k) {
        const double v = rule.node[k];
        sum += rule.weight[k] * (p[0] + v * (p[1] + v * p[2])) * std::exp(-evaluate(depth, v));
      }
      return sum;
    };
    const double target = std::pow(10.0, -2 - i % 9);
    const int nodes = nodes_needed(p, depth, target);
    if (nodes == 0 || nodes > kMaxNodes / 2) continue;  // not enough nodes left to check with
    ++chosen;
    EXPECT_NEAR(integrate(nodes), integrate(kMaxNodes), target);
  }
  EXPECT_GT(chosen, 150);
}

TEST(TransferPieces, AgreesWithTheTransferFunction) {
  TransferFunction transfer;
  transfer.points = {
      {0.2, {1, 0, 0}, 0}, {0.4, {0, 1, 0}, 2}, {0.4, {0, 0, 1}, 1}, {0.6, {1, 1, 1}, 0}, {0.8, {0, 0, 0}, 0}};
  const TransferPieces pieces(transfer);
  EXPECT_EQ(pieces.value_count(), 4);
  EXPECT_TRUE(pieces.has_jumps());
  EXPECT_EQ(pieces.jump(1).extinction, 1);
  EXPECT_EQ(pieces.jump(0).extinction, 0);
  for (double s = -0.05; s < 1.05; s += 0.05) {
    const TransferSegment& segment = pieces.segment(pieces.segment_above(s));
    const glm::dvec4 expected = transfer.at(s);
    EXPECT_NEAR(segment.extinction + segment.extinction_slope * (s - segment.origin), expected.a, 1e-14) << s;
    const glm::dvec3 colour = segment.colour + (s - segment.origin) * segment.colour_slope;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(colour[c], expected[c], 1e-14) << s;
  }
  EXPECT_TRUE(pieces.empty_range(-1, 0.1));
  EXPECT_TRUE(pieces.empty_range(0.65, 2));
  EXPECT_FALSE(pieces.empty_range(0.1, 0.3));
  EXPECT_FALSE(pieces.empty_range(0.4, 0.4));
}

TEST(Lattice, ReadsEveryVoxelTypeAndMarksOnlyEmptyBricks) {
  std::mt19937_64 random(2);
  for (const VoxelType type : {VoxelType::U8, VoxelType::U16, VoxelType::I16, VoxelType::F32}) {
    const Volume volume = random_volume({11, 1, 7}, type, random);
    Lattice lattice(volume);
    Lattice::Corners corners;
    lattice.load({9, 0, 3}, corners);
    EXPECT_EQ(corners[0], volume.at(9, 0, 3));
    EXPECT_EQ(corners[1], volume.at(10, 0, 3));
    EXPECT_EQ(corners[2], volume.at(9, 0, 3)) << "one sample along y";
    EXPECT_EQ(corners[5], volume.at(10, 0, 4));

    TransferFunction transfer;
    transfer.points = {{0.97, {}, 0}, {1, {}, 1}};
    const TransferPieces pieces(transfer);
    lattice.mark_empty_bricks([&](double lo, double hi) { return pieces.empty_range(lo, hi); });
    int empty = 0;
    for (int bz = 0; bz < lattice.bricks().z; ++bz) {
      for (int bx = 0; bx < lattice.bricks().x; ++bx) {
        double most = 0;
        for (int k = 4 * bz; k <= std::min(4 * bz + 4, 6); ++k)
          for (int i = 4 * bx; i <= std::min(4 * bx + 4, 10); ++i) most = std::max(most, volume.at(i, 0, k));
        EXPECT_EQ(lattice.brick_empty({bx, 0, bz}), most < 0.97);
        empty += lattice.brick_empty({bx, 0, bz});
      }
    }
    EXPECT_LT(empty, 6);
  }
}

}  // namespace
}  // namespace volumark::test
