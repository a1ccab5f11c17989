#include "methods/shell_slices/prisms.h"

#include <gtest/gtest.h>

#include "scenes/prism_faults.h"
#include "tests/unit/shell_slices/hand_made.h"

namespace volumark {
namespace {

int64_t kept(const Shell& shell) { return static_cast<int64_t>(shell_prisms(shell).prisms.size()); }

// Hard case 15.
TEST(Prisms, CornersWithoutThicknessAreKeptUntilNoneIsLeft) {
  EXPECT_EQ(kept(one_prism(1, {.1, .1, .1})), 1);
  EXPECT_EQ(kept(one_prism(1, {0, .1, .1})), 1);
  EXPECT_EQ(kept(one_prism(1, {0, 0, .1})), 1);
  const ShellPrisms flat = shell_prisms(one_prism(1, {0, 0, 0}));
  EXPECT_TRUE(flat.prisms.empty());
  EXPECT_EQ(flat.degenerate, 1);
  EXPECT_EQ(flat.self_intersecting, 0);
}

TEST(Prisms, VeryThinAndVeryThickOnesAreKept) {
  EXPECT_EQ(kept(one_prism(1, {1e-6, 1e-6, 1e-6})), 1);
  EXPECT_EQ(kept(one_prism(1, {1e6, 1e6, 1e6})), 1);
  EXPECT_EQ(kept(one_prism(1, {1e6, 1e6, 1e6}, .1)), 1);
}

TEST(Prisms, SliversAndNeedlesAreKeptButTrianglesWithoutAreaAreNot) {
  Shell sliver = one_prism(1, {.1, .1, .1});
  auto mesh = std::make_shared<Mesh>(*sliver.mesh);
  mesh->positions[2] = {.5, 1e-6, 0};
  sliver.mesh = mesh;
  EXPECT_EQ(kept(sliver), 1);
  mesh->positions[2] = {1e6, 1, 0};
  mesh->positions[1] = {1e6, 0, 0};
  EXPECT_EQ(kept(sliver), 1);
  mesh->positions[2] = {2e6, 0, 0};  // on the line of the others
  const ShellPrisms flat = shell_prisms(sliver);
  EXPECT_TRUE(flat.prisms.empty());
  EXPECT_EQ(flat.degenerate, 1);
}

TEST(Prisms, NormalsThatCrossAreExcludedAndCounted) {
  EXPECT_EQ(kept(one_prism(1, {.4, .4, .4}, -1)), 1);  // lean inwards, but do not meet
  const ShellPrisms crossed = shell_prisms(one_prism(1, {2, 2, 2}, -1));
  EXPECT_TRUE(crossed.prisms.empty());
  EXPECT_EQ(crossed.self_intersecting, 1);
  EXPECT_EQ(crossed.degenerate, 0);
  // One normal through the triangle's plane.
  Shell flipped = one_prism(1, {.1, .1, .1});
  auto mesh = std::make_shared<Mesh>(*flipped.mesh);
  mesh->normals[1] = -mesh->normals[1];
  flipped.mesh = mesh;
  EXPECT_EQ(shell_prisms(flipped).self_intersecting, 1);
  // All three: the map is turned inside out, but is still one to one.
  mesh->normals[0] = -mesh->normals[0];
  mesh->normals[2] = -mesh->normals[2];
  EXPECT_EQ(kept(flipped), 1);
}

// The Jacobian of the map, by differences, at many points: the sign that jacobian_sign() proves, or both signs.
TEST(Prisms, JacobianSignAgreesWithTheJacobian) {
  int kept_ones = 0, others = 0;
  uint32_t seed = 1;
  const auto random = [&] {
    seed = seed * 1664525U + 1013904223U;
    return static_cast<double>(seed >> 8) / (1 << 24);
  };
  for (int trial = 0; trial < 5000; ++trial) {
    std::array<glm::dvec3, 3> lower, upper;
    for (size_t i = 0; i < 3; ++i) {
      lower[i] = {random(), random(), .2 * random()};
      upper[i] = lower[i] + glm::dvec3(random() - .5, random() - .5, random());
    }
    const int sign = jacobian_sign(lower, upper);
    double least = 1e30, largest = -1e30;
    for (int k = 0; k <= 32; ++k) {
      const double w = k / 32.;
      glm::dvec3 at[3];
      for (size_t i = 0; i < 3; ++i) at[i] = lower[i] + w * (upper[i] - lower[i]);
      const glm::dvec3 normal = glm::cross(at[1] - at[0], at[2] - at[0]);
      for (size_t i = 0; i < 3; ++i) {
        const double j = glm::dot(normal, upper[i] - lower[i]);
        least = std::min(least, j);
        largest = std::max(largest, j);
      }
    }
    EXPECT_TRUE(sign <= 0 || least > 0) << least;
    EXPECT_TRUE(sign >= 0 || largest < 0) << largest;
    // Refused: zero is reached, up to what 33 points in w can miss of a quadratic with coefficients below 12.
    const double missed = 12. / (64 * 64);
    EXPECT_TRUE(sign != 0 || (least < missed && largest > -missed)) << least << " " << largest;
    (sign != 0 ? kept_ones : others)++;
  }
  EXPECT_GT(kept_ones, 500);
  EXPECT_GT(others, 500);
}

// Hard case 16: the same prisms at any scale, and far from the origin.
TEST(Prisms, PositionsAreRelativeToTheMiddle) {
  const Shell torus = torus_shell(24, 12, 1, .4, .08);
  const ShellPrisms here = shell_prisms(torus);
  Shell far = torus;
  auto mesh = std::make_shared<Mesh>(*torus.mesh);
  for (glm::dvec3& p : mesh->positions) p += glm::dvec3(1e6, -2e6, 5e5);
  far.mesh = mesh;
  const ShellPrisms there = shell_prisms(far);
  ASSERT_EQ(here.prisms.size(), there.prisms.size());
  for (size_t i = 0; i < here.lower.size(); ++i) {
    // Double positions near 2e6 are 2.3e-10 apart.
    EXPECT_LT(glm::distance(here.upper[i], there.upper[i]), 1e-6F);
  }
}

TEST(EdgeTable, NineAPrismOrOneAnEdge) {
  const ShellPrisms shell = shell_prisms(torus_shell(24, 12, 1, .4, .08));
  ASSERT_EQ(shell.prisms.size(), 576U);
  const EdgeTable own = edge_table(shell, false);
  EXPECT_EQ(own.edges.size() * sizeof(FakeVertex), 576U * 9 * 48);  // lensch2002: 243 KiB
  EXPECT_EQ(own.edges.size() * sizeof(FakeVertex), 243U * 1024);
  const EdgeTable shared = edge_table(shell, true);
  // 864 edges of the mesh twice and 288 normals; the texture's two seams have 24 and 12 edges across which they are
  // doubled, twice, and as many normals, and one more where the seams cross.
  EXPECT_EQ(shared.edges.size(), 2U * (864 + 36) + 288 + 37);
  for (size_t i = 0; i < shell.prisms.size(); ++i) {
    for (size_t e = 0; e < 9; ++e) {
      const FakeVertex &a = own.edges[own.of_prism[i][e]], &b = shared.edges[shared.of_prism[i][e]];
      EXPECT_TRUE(a.a == b.a && a.b == b.b && a.texture_a == b.texture_a && a.texture_b == b.texture_b);
    }
  }
}

}  // namespace
}  // namespace volumark
