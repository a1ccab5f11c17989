#include "methods/shell_slices/plane_pairs.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/shell_slices/hand_made.h"

namespace volumark {
namespace {

View view_from(const glm::dvec3& eye) {
  View view;
  view.eye = eye;
  view.up = {.1, 1, .2};
  view.fov_y = .7;
  view.near = .01;
  return view;
}

using PairSet = std::set<std::pair<int, uint32_t>>;

struct Swept {
  PairSet crossed;
  int64_t touched = 0;  // not crossed, but a corner is on the plane, or within the rounding of its depth
  PairCounts counts;
};
Swept sweep(const ShellPrisms& shell, const ShellFrame& frame, Reject reject) {
  CornerDepths depths;
  corner_depths(shell, frame, depths);
  Swept out;
  PlanePairs pairs;
  int last = frame.planes;
  out.counts = pairs.visit(shell, frame, depths, reject, [&](int plane, uint32_t prism) {
    EXPECT_LE(plane, last);  // back to front
    last = plane;
    if (kSections[sides_of(depths, shell.prisms[prism], static_cast<float>(plane))].corners > 0) {
      EXPECT_TRUE(out.crossed.insert({plane, prism}).second);
      return;
    }
    bool touches = false;
    for (const uint32_t position : shell.prisms[prism].position) {
      for (const float depth : {depths.lower[position], depths.upper[position]}) {
        touches = touches || std::abs(depth - static_cast<float>(plane)) <= depths.slack;
      }
    }
    out.touched += touches ? 1 : 0;
  });
  return out;
}

TEST(PlanePairs, NoWayOfRejectingLosesAnIntersection) {
  const ShellPrisms shell = shell_prisms(torus_shell(24, 12, 1, .4, .08));
  for (const glm::dvec3& eye : {glm::dvec3(3, 2, 2.5), glm::dvec3(0, 0, 4), glm::dvec3(1.2, 0, .1)}) {
    for (const int planes : {1, 7, 100, 500}) {
      const ShellFrame frame = shell_frame(shell, view_from(eye), 512, 512, planes);
      ASSERT_EQ(frame.planes, planes);
      const Swept all = sweep(shell, frame, Reject::None), spheres = sweep(shell, frame, Reject::Spheres),
                  active = sweep(shell, frame, Reject::ActiveList);
      EXPECT_EQ(all.crossed, spheres.crossed);
      EXPECT_EQ(all.crossed, active.crossed);
      EXPECT_EQ(all.counts.tests, static_cast<int64_t>(planes) * 576);
      EXPECT_EQ(all.counts.rejected, 0);
      EXPECT_EQ(spheres.counts.tests, all.counts.tests);
      // The entries of the active lists are the intersections, and prisms that a plane only touches.
      EXPECT_EQ(active.counts.tests, static_cast<int64_t>(all.crossed.size()) + all.touched);
      EXPECT_EQ(active.counts.rejected, 0);
    }
  }
}

TEST(PlanePairs, PlanesLieBetweenTheNearestAndTheFarthestCorner) {
  const ShellPrisms shell = shell_prisms(torus_shell(24, 12, 1, .4, .08));
  const ShellFrame frame = shell_frame(shell, view_from({0, 0, 4}), 64, 64, 48);
  EXPECT_NEAR(frame.step, .96 / 48, 1e-6);
  EXPECT_NEAR(frame.first, -.48 + .5 * frame.step, 1e-6);
  View inside = view_from({0, 0, 4});
  inside.near = 4;  // cuts off the near half
  const ShellFrame half = shell_frame(shell, inside, 64, 64, 48);
  EXPECT_NEAR(half.step, .48 / 48, 1e-6);
  inside.near = 5;
  EXPECT_EQ(shell_frame(shell, inside, 64, 64, 48).planes, 0);
}

// Depths that are used must be those of the plane's own equation: the point where an edge is met lies on the plane.
TEST(PlanePairs, PointsOnEdgesLieOnThePlane) {
  const ShellPrisms shell = shell_prisms(torus_shell(24, 12, 1, .4, .08));
  const ShellFrame frame = shell_frame(shell, view_from({3, 2, 2.5}), 512, 512, 1000);
  CornerDepths depths;
  corner_depths(shell, frame, depths);
  float worst = 0;
  for (const Prism& prism : shell.prisms) {
    for (const auto& ends : kEdgeEnds) {
      const glm::vec3 &a = shell.corner(prism, ends[0]), &b = shell.corner(prism, ends[1]);
      const float da = plane_depth(frame.uniforms, a), db = plane_depth(frame.uniforms, b);
      const float plane = std::ceil(std::min(da, db));
      if (!(plane <= std::max(da, db))) continue;
      const glm::vec3 p = on_edge(edge_weights(da - plane, db - plane), a, b);
      worst = std::max(worst, std::abs(plane_depth(frame.uniforms, p) - plane));
    }
  }
  // The slack allows for twice the rounding of a depth; the point has its own rounding and that of its depth.
  EXPECT_LT(worst, 2 * depths.slack);
  EXPECT_LT(depths.slack, .01F);
}

}  // namespace
}  // namespace volumark
