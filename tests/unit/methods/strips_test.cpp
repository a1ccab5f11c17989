// Polygons cut into strips at stored slices: nothing is lost or covered twice, and weights are those of the plane.
#include "methods/slices2d/strips.h"

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "methods/slices2d/plane_section.h"

namespace volumark {
namespace {

using Between = StripBuilder::Between;

StackLayout one_page(int slices) { return *stack_layout({8, 8, slices}, 2, 4096); }

// Regular polygon of radius 1 whose place among the slices is `middle` + slope . (x, y).
std::vector<PlanePoint> polygon(int corners, double middle, const glm::dvec2& slope) {
  std::vector<PlanePoint> out;
  for (int i = 0; i < corners; ++i) {
    const double angle = 6.283185307179586 * i / corners + 0.3, x = std::cos(angle), y = std::sin(angle);
    out.push_back({{x, y, 1}, middle + slope.x * x + slope.y * y});
  }
  return out;
}

double area(const StripBuilder& strips) {
  double sum = 0;
  for (size_t i = 0; i < strips.indices().size(); i += 3) {
    const StripVertex &a = strips.vertices()[strips.indices()[i]], &b = strips.vertices()[strips.indices()[i + 1]],
                      &c = strips.vertices()[strips.indices()[i + 2]];
    sum += 0.5 * ((static_cast<double>(b.x) - a.x) * (static_cast<double>(c.y) - a.y) -
                  (static_cast<double>(b.y) - a.y) * (static_cast<double>(c.x) - a.x));
  }
  return sum;
}
double area_of_regular(int corners) { return 0.5 * corners * std::sin(6.283185307179586 / corners); }

// Edges of triangles that have no counterpart of the same bits in the opposite direction.
size_t open_edges(const StripBuilder& strips) {
  std::map<std::array<float, 4>, int> count;
  for (size_t i = 0; i < strips.indices().size(); i += 3) {
    for (size_t k = 0; k < 3; ++k) {
      const StripVertex& a = strips.vertices()[strips.indices()[i + k]];
      const StripVertex& b = strips.vertices()[strips.indices()[i + (k + 1) % 3]];
      ++count[{a.x, a.y, b.x, b.y}];
      --count[{b.x, b.y, a.x, a.y}];
    }
  }
  size_t open = 0;
  for (const auto& [edge, n] : count) open += n > 0 ? 1 : 0;
  return open;
}

TEST(Strips, CoverThePolygonOnceAndShareTheirEdges) {
  for (const int corners : {3, 4, 6, 9}) {
    for (const glm::dvec2& slope : {glm::dvec2(4.3, 1.7), glm::dvec2(0, -7), glm::dvec2(1e-3, 0), glm::dvec2(7.5, 0)}) {
      StripBuilder strips;
      strips.add(polygon(corners, 7.6, slope), Between::TwoSlices, 0.25, one_page(16), 0);
      // Corners are rounded to floats.
      EXPECT_NEAR(area(strips), area_of_regular(corners), 1e-6);
      // The rim is cut by each of the strips - 1 lines in two points, which may be corners.
      const size_t cuts = static_cast<size_t>(strips.strips() - 1);
      EXPECT_LE(open_edges(strips), static_cast<size_t>(corners) + 2 * cuts);
      EXPECT_GE(open_edges(strips), static_cast<size_t>(corners));
      for (const StripVertex& v : strips.vertices()) {
        EXPECT_NEAR(v.first + v.weight, 7.6 + slope.x * v.x + slope.y * v.y, 2e-5);
        EXPECT_GE(v.weight, 0);
        EXPECT_LE(v.weight, 1);
        EXPECT_EQ(v.depth, 0.25F);
      }
    }
  }
}

TEST(Strips, OfAPlaneAlongTheSlicesAreOne) {
  for (const double noise : {0., 1e-13, -1e-13}) {
    StripBuilder strips;
    strips.add(polygon(5, 6 + noise, {noise, 0}), Between::TwoSlices, 0, one_page(16), 0);
    ASSERT_EQ(strips.strips(), 1);
    for (const StripVertex& v : strips.vertices()) EXPECT_NEAR(v.first + v.weight, 6, 1e-6);
  }
  StripBuilder at_end;
  at_end.add(polygon(5, 15, {0, 0}), Between::TwoSlices, 0, one_page(16), 0);
  ASSERT_EQ(at_end.strips(), 1);
  EXPECT_EQ(at_end.vertices()[0].first, 14) << "between the last two";
  EXPECT_EQ(at_end.vertices()[0].weight, 1);
}

TEST(Strips, CornersAndEdgesOnASliceMakeNoEmptyStrips) {
  const std::vector<PlanePoint> square = {{{0, 0, 1}, 3}, {{1, 0, 1}, 5}, {{1, 1, 1}, 5}, {{0, 1, 1}, 3}};
  StripBuilder edges;
  edges.add(square, Between::TwoSlices, 0, one_page(16), 0);
  EXPECT_EQ(edges.strips(), 2);
  EXPECT_EQ(edges.vertices().size(), 8U);
  const std::vector<PlanePoint> diamond = {{{0, 0, 1}, 3}, {{1, -1, 1}, 4}, {{2, 0, 1}, 5}, {{1, 1, 1}, 4}};
  StripBuilder corners;
  corners.add(diamond, Between::TwoSlices, 0, one_page(16), 0);
  EXPECT_EQ(corners.strips(), 2);
  EXPECT_EQ(corners.vertices().size(), 6U) << "cut through two corners";
  EXPECT_NEAR(area(corners), 2, 1e-6);
}

TEST(Strips, BeyondTheStackTheOutermostGoOn) {
  StripBuilder strips;
  strips.add(polygon(4, 1.5, {4, 0}), Between::TwoSlices, 0, one_page(4), 0);
  EXPECT_EQ(strips.strips(), 3);
  EXPECT_NEAR(area(strips), 2, 1e-6);
  StripBuilder single;
  single.add(polygon(4, 0, {0, 0}), Between::TwoSlices, 0, one_page(1), 0);
  ASSERT_EQ(single.strips(), 1);
  EXPECT_EQ(single.vertices()[0].first, 0);
}

TEST(Strips, HalfWaysAreCutBetweenTheSlices) {
  StripBuilder strips;
  strips.add(polygon(6, 2, {1.2, 0.4}), Between::HalfWays, 0, one_page(5), 0);
  EXPECT_EQ(strips.strips(), 3);
  EXPECT_NEAR(area(strips), area_of_regular(6), 1e-6);
  for (const StripVertex& v : strips.vertices()) {
    EXPECT_EQ(v.weight, 0);
    EXPECT_LE(std::abs(2 + 1.2 * v.x + 0.4 * v.y - v.first), 0.5 + 1e-6) << "the nearest slice";
  }
}

// A stack of many pages of a few slices each.
StackLayout pages_of_four(int slices) {
  StackLayout layout;
  layout.slices = slices;
  for (int first = 0;; first += 2) {
    layout.pages.push_back({first, std::min(first + 3, slices - 1), 2, 2});
    if (layout.pages.back().last == slices - 1) return layout;
  }
}

TEST(Strips, EachIsDrawnFromOnePageThatHasBothSlices) {
  const StackLayout layout = pages_of_four(12);
  for (const Between between : {Between::TwoSlices, Between::HalfWays}) {
    StripBuilder strips;
    for (int i = 0; i < 2; ++i) strips.add(polygon(6, 5.5, {5, 2}), between, 0, layout, 0);
    EXPECT_NEAR(area(strips), 2 * area_of_regular(6), 1e-6) << "each strip once a polygon";
    EXPECT_EQ(strips.runs().size(), 2 * layout.pages.size() - 1) << "up, and down again";
    for (const SliceRun& run : strips.runs()) {
      const StackPage& page = layout.pages[static_cast<size_t>(run.page)];
      for (uint32_t i = run.first_index; i < run.first_index + run.index_count; ++i) {
        const int first = static_cast<int>(strips.vertices()[strips.indices()[i]].first);
        EXPECT_GE(first, page.first);
        EXPECT_LE(first + (between == Between::TwoSlices ? 1 : 0), page.last);
      }
    }
  }
  StripBuilder far;
  far.add(polygon(6, 5.5, {0.1, 0}), Between::TwoSlices, 0, layout, 100);
  EXPECT_EQ(far.runs().size(), layout.pages.size()) << "all pages within reach";
}

// ---- Sections ----

ViewRays looking_along(const glm::dvec3& forward, bool perspective, double distance = 4) {
  ViewRays rays{};
  rays.forward = glm::normalize(forward);
  const glm::dvec3 right = glm::normalize(glm::cross(rays.forward, glm::dvec3(0.1, 1, 0.2)));
  const glm::dvec3 up = glm::cross(right, rays.forward);
  rays.perspective = perspective;
  rays.direction = rays.forward;
  rays.eye = -distance * rays.forward;
  rays.reference_depth = distance;
  rays.z_near = 0.01 - distance;
  if (perspective) {
    rays.direction_x = right;
    rays.direction_y = up;
  }
  rays.origin_x = right * 4.;
  rays.origin_y = up * 4.;
  return rays;
}

double area_of(const std::vector<glm::dvec3>& polygon) {
  glm::dvec3 sum(0);
  for (size_t i = 2; i < polygon.size(); ++i) sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return 0.5 * glm::length(sum);
}

TEST(PlaneSection, HasTheAreaOfItsClosedForm) {
  const glm::dvec3 extent(2, 2, 2);
  const glm::dvec3 diagonal = glm::normalize(glm::dvec3(1));
  for (const bool perspective : {false, true}) {
    const ViewRays rays = looking_along({0.3, -0.5, 1}, perspective);
    const auto section = [&](const glm::dvec3& n, double d) { return visible_section(extent, rays, {n, d}); };
    EXPECT_NEAR(area_of(section(diagonal, 0)), 3 * std::sqrt(3.), 1e-9) << "the hexagon";
    EXPECT_NEAR(area_of(section({0, 0, 1}, 0.3)), 4, 1e-9);
    EXPECT_NEAR(area_of(section({0, 0, 1}, 1)), 4, 1e-9) << "on a face";
    EXPECT_NEAR(area_of(section(glm::normalize(glm::dvec3(1, 1, 0)), 0)), 4 * std::sqrt(2.), 1e-9) << "two edges";
    EXPECT_NEAR(area_of(section(diagonal, 1 / std::sqrt(3.))), 2 * std::sqrt(3.), 1e-9) << "three corners";
    EXPECT_NEAR(area_of(section(diagonal, std::sqrt(3.))), 0, 1e-9) << "a corner alone";
    EXPECT_EQ(section({0, 0, 1}, 1.001).size(), 0U);
    EXPECT_EQ(section({0, 0, 1}, 50).size(), 0U);
  }
}

TEST(PlaneSection, SeenFromItsEdgeIsNothing) {
  const glm::dvec3 extent(2, 2, 2);
  const ViewRays flat = looking_along({0, 0, 1}, false), deep = looking_along({0, 0, 1}, true);
  EXPECT_TRUE(visible_section(extent, flat, {{1, 0, 0}, 0.25}).empty()) << "along the rays";
  EXPECT_TRUE(visible_section(extent, deep, {{1, 0, 0}, 0}).empty()) << "through the eye";
  EXPECT_GE(visible_section(extent, deep, {{1, 0, 0}, 0.25}).size(), 3U);
}

TEST(PlaneSection, EndsAtTheNearPlaneAndTheFrame) {
  const glm::dvec3 extent(2, 2, 2);
  const ViewRays inside = looking_along({0.2, 0.1, 1}, true, 0.2);
  const std::vector<glm::dvec3> section = visible_section(extent, inside, {{0, 1, 0}, -0.3});
  ASSERT_GE(section.size(), 3U);
  for (const glm::dvec3& p : section) {
    const glm::dvec3 place = clip_place(inside, p);
    EXPECT_GE(place.z, 0.01 - 1e-12);
    EXPECT_LE(std::abs(place.x / place.z), 1 + 1e-9);
    EXPECT_LE(std::abs(place.y / place.z), 1 + 1e-9);
  }
}

}  // namespace
}  // namespace volumark
