// Sections of prisms and planes against exact rational arithmetic: corners, order, area, at random and in every
// degenerate position (hard cases 13 and 15 of docs/stability.md's list, without drawing).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "methods/shell_slices/prisms.h"
#include "methods/shell_slices/section.h"
#include "methods/shell_slices/shell_frame.h"
#include "scenes/prism_faults.h"

namespace volumark {
namespace {

__extension__ typedef __int128 Wide;
using Point = std::array<int64_t, 3>;

int64_t dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
glm::dvec3 real(const Point& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

struct TestPrism {
  std::array<Point, 6> corner;
};
struct TestPlane {
  Point normal;
  int64_t offset;  // depth of a point: normal . p - offset
  const char* kind;
};

// The point of an edge on the plane: numerators over a common positive denominator.
struct Rational3 {
  std::array<Wide, 3> p;
  Wide over;
};
Rational3 crossing(const TestPrism& prism, const TestPlane& plane, size_t edge) {
  const Point &a = prism.corner[kEdgeEnds[edge][0]], &b = prism.corner[kEdgeEnds[edge][1]];
  const Wide da = dot(plane.normal, a) - plane.offset, db = dot(plane.normal, b) - plane.offset;
  const Wide wa = db < 0 ? -db : db, wb = da < 0 ? -da : da;
  return {{wa * a[0] + wb * b[0], wa * a[1] + wb * b[1], wa * a[2] + wb * b[2]}, wa + wb};
}

// Twice the signed area of a closed chain of points, as seen from where `axis` of the normal is positive: the sum of
// p x q over its segments along the axis, exact in rationals; and where it lies.
struct Fraction {
  Wide up, over;
};
Wide gcd(Wide a, Wide b) {
  if (a < 0) a = -a;
  while (b != 0) {
    const Wide rest = a % b;
    a = b;
    b = rest;
  }
  return a == 0 ? 1 : a;
}
Fraction sum(const Fraction& a, const Fraction& b) {
  const Wide common = gcd(a.over, b.over);
  const Fraction out{a.up * (b.over / common) + b.up * (a.over / common), a.over / common * b.over};
  const Wide divisor = gcd(out.up, out.over);
  return {out.up / divisor, out.over / divisor};
}
Fraction segment_area(const Rational3& p, const Rational3& q, size_t axis) {
  const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Fraction out{p.p[u] * q.p[v] - p.p[v] * q.p[u], p.over * q.over};
  const Wide divisor = gcd(out.up, out.over);
  return {out.up / divisor, out.over / divisor};
}

// The section by another way than the table's: each face by itself. Walking around a face, counter-clockwise as seen
// from outside, sides change at crossed edges; the segment runs from where it goes far -> near to where it goes near ->
// far, which turns counter-clockwise around the section as seen from the far side.
const std::array<std::vector<std::array<int, 2>>, 5> kFaces = {{
    // (corner, edge to the next corner)
    {{0, 2}, {2, 1}, {1, 0}},
    {{3, 3}, {4, 4}, {5, 5}},
    {{0, 0}, {1, 7}, {4, 3}, {3, 6}},
    {{1, 1}, {2, 8}, {5, 4}, {4, 7}},
    {{2, 2}, {0, 6}, {3, 5}, {5, 8}},
}};
std::map<int, int> chain_of_faces(unsigned sides) {
  std::map<int, int> next;
  for (const auto& face : kFaces) {
    int from = -1, to = -1;
    for (size_t i = 0; i < face.size(); ++i) {
      const int next_corner = face[(i + 1) % face.size()][0];
      const bool here = ((sides >> face[i][0]) & 1) != 0, there = ((sides >> next_corner) & 1) != 0;
      if (here && !there) from = face[i][1];
      if (!here && there) to = face[i][1];
    }
    if (from >= 0) next[from] = to;
  }
  return next;
}

struct Tally {
  int64_t pairs = 0, by_corners[6] = {}, on_plane = 0, excluded = 0;
  std::array<bool, 64> seen{};
};

double area_in_float(const TestPrism& prism, const TestPlane& plane, const Section& section, size_t axis) {
  ShellUniforms u;
  for (size_t i = 0; i < 3; ++i) u.depth[i] = static_cast<float>(plane.normal[i]);
  u.depth[3] = static_cast<float>(-plane.offset);
  std::vector<glm::vec3> points;
  for (size_t k = 0; k < section.corners; ++k) {
    const auto& ends = kEdgeEnds[section.edges[k]];
    const glm::vec3 a(real(prism.corner[ends[0]])), b(real(prism.corner[ends[1]]));
    const EdgeWeights weights = edge_weights(plane_depth(u, a), plane_depth(u, b));
    // From either end the same bits: neighbours may ask either way.
    const EdgeWeights back = edge_weights(plane_depth(u, b), plane_depth(u, a));
    EXPECT_EQ(on_edge(weights, a, b), on_edge(back, b, a));
    points.push_back(on_edge(weights, a, b));
  }
  double area = 0;
  const int x = static_cast<int>(axis + 1) % 3, y = static_cast<int>(axis + 2) % 3;
  for (size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 p(points[i]), q(points[(i + 1) % points.size()]);
    area += p[x] * q[y] - p[y] * q[x];
  }
  return area;
}

void check(const TestPrism& prism, const TestPlane& plane, Tally& tally) {
  ++tally.pairs;
  unsigned sides = 0;
  bool touches = false;
  ShellUniforms u;
  for (size_t i = 0; i < 3; ++i) u.depth[i] = static_cast<float>(plane.normal[i]);
  u.depth[3] = static_cast<float>(-plane.offset);
  for (unsigned i = 0; i < 6; ++i) {
    const int64_t depth = dot(plane.normal, prism.corner[i]) - plane.offset;
    ASSERT_LT(std::abs(depth), int64_t{1} << 24);  // else floats are not exact, and this test says nothing
    ASSERT_EQ(static_cast<float>(depth), plane_depth(u, glm::vec3(real(prism.corner[i]))));
    sides |= static_cast<unsigned>(depth >= 0) << i;
    touches = touches || depth == 0;
  }
  tally.on_plane += touches ? 1 : 0;
  tally.seen[sides] = true;
  const Section& section = kSections[sides];
  ++tally.by_corners[section.corners];
  if (section.twisted || section.corners == 0) return;

  // Order: the table's cycle is the faces' chain, or its reverse where it turns the other way.
  const std::map<int, int> next = chain_of_faces(sides);
  ASSERT_EQ(next.size(), section.corners) << plane.kind << ", sides " << sides;
  size_t axis = 0;
  for (size_t i = 1; i < 3; ++i) {
    if (std::abs(plane.normal[i]) > std::abs(plane.normal[axis])) axis = i;
  }
  const int64_t up = plane.normal[axis] > 0 ? 1 : -1;
  Fraction area{0, 1}, by_faces{0, 1};
  double reach = 0;
  for (size_t k = 0; k < section.corners; ++k) {
    const int here = section.edges[k], there = section.edges[(k + 1U) % section.corners];
    ASSERT_EQ(section.turn > 0 ? next.at(here) : next.at(there), section.turn > 0 ? there : here)
        << plane.kind << ", sides " << sides;
    const Rational3 p = crossing(prism, plane, static_cast<size_t>(here)),
                    q = crossing(prism, plane, static_cast<size_t>(there));
    ASSERT_GT(p.over, 0) << plane.kind;  // a crossed edge is never parallel to the plane
    area = sum(area, segment_area(p, q, axis));
    for (const Wide c : p.p) reach = std::max(reach, std::abs(static_cast<double>(c) / static_cast<double>(p.over)));
  }
  for (const auto& [from, to] : next) {
    by_faces = sum(by_faces, segment_area(crossing(prism, plane, static_cast<size_t>(from)),
                                          crossing(prism, plane, static_cast<size_t>(to)), axis));
  }
  ASSERT_TRUE(area.up == section.turn * by_faces.up && area.over == by_faces.over) << plane.kind;
  // The exact area, from the far side, is not negative on the way of the faces.
  ASSERT_TRUE(by_faces.up * up >= 0) << plane.kind << ", sides " << sides;

  // Floats: every coordinate is off by at most 4 roundings of the largest, and so each of the up to five cross products
  // by 4 * 4 of its square and the double arithmetic after it.
  const double exact = static_cast<double>(area.up) / static_cast<double>(area.over);
  const double bound = 5 * 16 * 6e-8 * reach * reach;
  ASSERT_NEAR(area_in_float(prism, plane, section, axis), exact, bound) << plane.kind;
}

class Pairs {
 public:
  explicit Pairs(uint32_t seed) : random_(seed) {}

  // Corners on a lattice; normals lean at random, also to both sides, and corners may have no thickness.
  TestPrism prism() {
    TestPrism out;
    do {
      for (size_t i = 0; i < 3; ++i) {
        out.corner[i] = {number(-12, 12), number(-12, 12), number(-3, 3)};
        const int64_t thick = number(0, 9) == 0 ? 0 : number(1, 8);
        const int64_t lean = thick == 0 ? 0 : number(0, 1) * number(1, 4);
        out.corner[i + 3] = {out.corner[i][0] + number(-lean, lean), out.corner[i][1] + number(-lean, lean),
                             out.corner[i][2] + thick};
      }
    } while (!valid(out));
    return out;
  }

  TestPlane plane(const TestPrism& prism) {
    const auto corner = [&] { return prism.corner[static_cast<size_t>(number(0, 5))]; };
    Point normal{};
    Point through = corner();
    const char* kind = "random";
    const auto parallel_to = [&](const Point& a, const Point& b) {
      normal = cross(minus(b, a), {number(-7, 7), number(-7, 7), number(-7, 7)});
      through = a;
    };
    switch (number(0, 7)) {
      case 0:
        kind = "through a vertex";
        break;
      case 1: {
        kind = "through an edge";
        const auto& ends = kEdgeEnds[static_cast<size_t>(number(0, 8))];
        parallel_to(prism.corner[ends[0]], prism.corner[ends[1]]);
        break;
      }
      case 2: {
        kind = "through three corners: a face, or across";
        const Point a = corner(), b = corner(), c = corner();
        normal = cross(minus(b, a), minus(c, a));
        through = a;
        break;
      }
      case 3: {
        kind = "through a face";
        const size_t layer = number(0, 1) == 0 ? 0 : 3;
        normal = cross(minus(prism.corner[layer + 1], prism.corner[layer]),
                       minus(prism.corner[layer + 2], prism.corner[layer]));
        through = prism.corner[layer];
        break;
      }
      case 4: {
        kind = "through two vertices";
        parallel_to(corner(), corner());
        break;
      }
      case 5: {
        kind = "parallel to a normal edge";
        const auto i = static_cast<size_t>(number(0, 2));
        parallel_to(prism.corner[i], prism.corner[i + 3]);
        through = {number(-12, 12), number(-12, 12), number(-3, 12)};
        break;
      }
      default:
        through = {number(-12, 12), number(-12, 12), number(-3, 12)};
    }
    while (normal == Point{}) normal = {number(-9, 9), number(-9, 9), number(-9, 9)};
    if (number(0, 1) == 0) normal = {-normal[0], -normal[1], -normal[2]};
    return {normal, dot(normal, through), kind};
  }

  int64_t rejected() const { return rejected_; }

 private:
  int64_t number(int64_t lo, int64_t hi) { return std::uniform_int_distribution<int64_t>(lo, hi)(random_); }
  bool valid(const TestPrism& prism) {
    const std::array<glm::dvec3, 3> lower = {real(prism.corner[0]), real(prism.corner[1]), real(prism.corner[2])};
    const std::array<glm::dvec3, 3> upper = {real(prism.corner[3]), real(prism.corner[4]), real(prism.corner[5])};
    const bool keep = jacobian_sign(lower, upper) > 0;
    rejected_ += keep ? 0 : 1;
    return keep;
  }
  std::mt19937 random_;
  int64_t rejected_ = 0;
};

TEST(ExactSection, CornersOrderAndAreaAtRandomAndInDegeneratePositions) {
  Pairs pairs(20020);
  Tally tally;
  for (int i = 0; i < 20000; ++i) {
    const TestPrism prism = pairs.prism();
    for (int k = 0; k < 10; ++k) {
      check(prism, pairs.plane(prism), tally);
      if (HasFatalFailure()) return;
    }
  }
  std::printf("%ld pairs, %ld with a corner on the plane; 0/3/4/5 corners: %ld %ld %ld %ld\n", tally.pairs,
              tally.on_plane, tally.by_corners[0], tally.by_corners[3], tally.by_corners[4], tally.by_corners[5]);
  EXPECT_GE(tally.pairs, 100000);
  EXPECT_GE(tally.on_plane, 50000);
  for (unsigned sides = 0; sides < 64; ++sides) EXPECT_TRUE(tally.seen[sides]) << sides << " never occurred";
}

}  // namespace
}  // namespace volumark
