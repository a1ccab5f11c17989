// The classification of lensch2002 (sections 3, 4 and 6) over all of its inputs.
#include "methods/shell_slices/section.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace volumark {
namespace {

std::vector<int> edges_of(const Section& section) {
  return {section.edges.begin(), section.edges.begin() + section.corners};
}

bool is_crossed(unsigned sides, int edge) {
  const auto& ends = kEdgeEnds[static_cast<size_t>(edge)];
  return ((sides >> ends[0]) & 1) != ((sides >> ends[1]) & 1);
}

// Whether two edges of a prism bound a common face.
bool share_face(int a, int b) {
  static const std::vector<std::set<int>> faces = {{0, 1, 2}, {3, 4, 5}, {0, 3, 6, 7}, {1, 4, 7, 8}, {2, 5, 8, 6}};
  return std::any_of(faces.begin(), faces.end(), [&](const auto& face) { return face.count(a) && face.count(b); });
}

// L11.
TEST(Section, The27ClassesGivePolygonsWith034Or5Corners) {
  std::vector<int> counts(6, 0);
  for (const bool away : {false, true}) {
    for (int code = 0; code < 27; ++code) {
      const std::array<NormalClass, 3> classes = {static_cast<NormalClass>(code % 3),
                                                  static_cast<NormalClass>(code / 3 % 3),
                                                  static_cast<NormalClass>(code / 9)};
      const Section& section = kSections[sides_of(classes, away)];
      EXPECT_FALSE(section.twisted);
      ++counts[section.corners];
      // Figure 4 as printed, pair by pair.
      std::vector<int> figure;
      for (int i = 0; i < 3; ++i) {
        const NormalClass a = classes[static_cast<size_t>(i)], b = classes[static_cast<size_t>((i + 1) % 3)];
        const auto isect = [&](int first) { figure.push_back(first + i); };
        if (a == NormalClass::Within) isect(kNormalEdge);
        if (a == NormalClass::Above && b != NormalClass::Above) isect(kUpperEdge);
        if (a == NormalClass::Below && b != NormalClass::Below) isect(kLowerEdge);
        if (a != NormalClass::Above && b == NormalClass::Above) isect(kUpperEdge);
        if (a != NormalClass::Below && b == NormalClass::Below) isect(kLowerEdge);
      }
      std::vector<int> ours = edges_of(section);
      ASSERT_EQ(ours.size(), figure.size()) << code;
      if (ours.empty()) continue;
      // The same cycle; the way round is the triangle's as seen from where the normals lead, which is the far side
      // if they lead there. Where no normal edge is crossed, ours turns counter-clockwise as seen from the far side.
      if (!away && std::none_of(ours.begin(), ours.end(), [](int e) { return e >= kNormalEdge; })) {
        std::reverse(ours.begin(), ours.end());
      }
      std::rotate(figure.begin(), std::find(figure.begin(), figure.end(), ours.front()), figure.end());
      EXPECT_EQ(ours, figure) << code << (away ? " away" : " towards");
    }
  }
  EXPECT_EQ(counts, (std::vector<int>{4, 0, 0, 14, 24, 12}));
}

TEST(Section, EveryCornerIsOnACrossedEdgeOnceAndNeighboursShareAFace) {
  for (unsigned sides = 0; sides < 64; ++sides) {
    const Section& section = kSections[sides];
    const std::vector<int> edges = edges_of(section);
    EXPECT_TRUE(edges.empty() || (edges.size() >= 3 && edges.size() <= 5)) << sides;
    EXPECT_EQ(std::set<int>(edges.begin(), edges.end()).size(), edges.size());
    for (const int edge : edges) EXPECT_TRUE(is_crossed(sides, edge)) << sides;
    int crossed = 0;
    for (int edge = 0; edge < kPrismEdges; ++edge) crossed += is_crossed(sides, edge) ? 1 : 0;
    if (section.twisted) {
      EXPECT_GT(crossed, static_cast<int>(edges.size())) << sides;
      continue;
    }
    EXPECT_EQ(crossed, static_cast<int>(edges.size())) << sides;
    for (size_t i = 0; i < edges.size(); ++i) {
      EXPECT_TRUE(share_face(edges[i], edges[(i + 1) % edges.size()])) << sides << " corner " << i;
    }
  }
}

// The six vertices of section 6 take the corners in the order in which section 4 draws them, from the same first one.
TEST(Section, HardwareVerticesTakeTheSameCornersInTheSameOrder) {
  for (unsigned sides = 0; sides < 64; ++sides) {
    std::vector<int> taken;
    for (int vertex = 0; vertex < 6; ++vertex) {
      const int edge = hardware_edge(static_cast<Sides>(sides), vertex);
      if (edge < 0) continue;
      if (taken.empty() || taken.back() != edge) taken.push_back(edge);
    }
    if (taken.size() > 1 && taken.back() == taken.front()) taken.pop_back();
    EXPECT_EQ(taken, edges_of(kSections[sides])) << sides;
  }
}

TEST(Section, NothingIsCrossedWhereAllCornersAreOnOneSide) {
  EXPECT_EQ(kSections[0].corners, 0);
  EXPECT_EQ(kSections[63].corners, 0);
  for (int vertex = 0; vertex < 6; ++vertex) {
    EXPECT_EQ(hardware_edge(0, vertex), -1);
    EXPECT_EQ(hardware_edge(63, vertex), -1);
  }
}

}  // namespace
}  // namespace volumark
