// Which edges of a prism a plane crosses, and in which order: lensch2002, sections 3 and 4. Pure functions of signs, so
// that nothing here can be inexact.
//
// Corners: 0..2 of the triangle ("lower"), 3..5 of the offset triangle ("upper"), i and i + 3 the ends of normal edge
// i. A corner is on the far side of a plane where its depth is at least the plane's (>=), so that a corner on the plane
// has a side too; an edge is crossed where its ends are on different sides.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace volumark {

// Edges: 0..2 lower (i to i + 1), 3..5 upper (the same), 6..8 normal (i to i + 3).
inline constexpr int kPrismEdges = 9;
inline constexpr int kLowerEdge = 0, kUpperEdge = 3, kNormalEdge = 6;
inline constexpr std::array<std::array<uint8_t, 2>, kPrismEdges> kEdgeEnds = {
    {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};

// The sides of the six corners: bit i is set where corner i is on the far side.
using Sides = uint8_t;

// The paper's classes of a normal edge, by where a plane meets its line (above: a, within: b, below: c), say which of
// the lower and upper edges are crossed as long as all three normals lead the same way through the plane. Sides say it
// always, so that they are what is used; this is for the 27 classes by name. `away`: normals lead to the far side.
enum class NormalClass : uint8_t { Above, Within, Below };
// The sides of corners whose normal edges have these classes.
constexpr Sides sides_of(const std::array<NormalClass, 3>& classes, bool away) {
  Sides sides = 0;
  for (unsigned i = 0; i < 3; ++i) {
    const bool lower_far = away ? classes[i] == NormalClass::Below : classes[i] != NormalClass::Below;
    const bool upper_far = away ? classes[i] != NormalClass::Above : classes[i] == NormalClass::Above;
    sides = static_cast<Sides>(sides | (lower_far ? 1U << i : 0U) | (upper_far ? 8U << i : 0U));
  }
  return sides;
}

// A polygon as the edges that its corners lie on. It is drawn as a fan of triangles around its first corner, which is
// the corner that lensch2002's vertex v0l would take.
struct Section {
  uint8_t corners = 0;  // 0, 3, 4 or 5
  std::array<uint8_t, 5> edges{};
  // +1: counter-clockwise as seen from the far side, if the prism's Jacobian is positive; -1: clockwise (the way of the
  // triangle as seen from where the normals lead, as in the paper). 0: a twisted section.
  int8_t turn = 0;
  // Two normal edges cross the plane in opposite directions. Then all four edges of the quadrilateral between them are
  // crossed, the true section is a hexagon or two triangles, and the paper's rules draw an approximation.
  bool twisted = false;
};

namespace section_detail {

constexpr bool far_side(Sides sides, int corner) { return ((sides >> corner) & 1) != 0; }
constexpr bool within(Sides sides, int normal) { return far_side(sides, normal) != far_side(sides, normal + 3); }

// Figure 4, by sides: appends the crossings of the quadrilateral between normal edges i and i + 1 that are its to draw.
constexpr void add_quadrilateral(Sides sides, int i, bool upper_first, Section& section) {
  const int j = (i + 1) % 3;
  const auto add = [&](int edge) { section.edges[section.corners++] = static_cast<uint8_t>(edge); };
  const bool lower = far_side(sides, i) != far_side(sides, j), upper = far_side(sides, i + 3) != far_side(sides, j + 3);
  if (within(sides, i)) {
    add(kNormalEdge + i);
    if (within(sides, j)) return;
  }
  if (upper && upper_first) add(kUpperEdge + i);
  if (lower) add(kLowerEdge + i);
  if (upper && !upper_first) add(kUpperEdge + i);
}

constexpr Section section_of(Sides sides) {
  Section section;
  int outward = 0, inward = 0;  // normal edges that lead to the far side, and to the near side
  for (int i = 0; i < 3; ++i) {
    if (within(sides, i)) ++(far_side(sides, i + 3) ? outward : inward);
  }
  section.twisted = outward > 0 && inward > 0;
  const bool away = inward == 0;
  std::array<uint8_t, 3> starts{};
  for (int i = 0; i < 3; ++i) {
    starts[static_cast<size_t>(i)] = section.corners;
    // Where both edges of a quadrilateral are crossed between a far and a near normal edge, the way around the section
    // says which is met first.
    add_quadrilateral(sides, i, far_side(sides, i) != away, section);
  }
  if (section.corners > 0 && !section.twisted) section.turn = away ? 1 : -1;
  // v0l: on normal edge 0, or else the last crossing of the quadrilateral that leads to it.
  if (!within(sides, 0) && section.corners > starts[2]) {
    const uint8_t last = section.edges[section.corners - 1U];
    for (unsigned k = section.corners - 1U; k > 0; --k) section.edges[k] = section.edges[k - 1];
    section.edges[0] = last;
  }
  return section;
}

constexpr std::array<Section, 64> all_sections() {
  std::array<Section, 64> sections{};
  for (unsigned sides = 0; sides < 64; ++sides) sections[sides] = section_of(static_cast<Sides>(sides));
  return sections;
}

}  // namespace section_detail

inline constexpr std::array<Section, 64> kSections = section_detail::all_sections();

// The edge that vertex `vertex` of lensch2002's hardware variant lies on (Figure 5; 0..5 = v0l, v0r, v1l, v1r, v2l,
// v2r), or -1 for "nowhere". In the order of the vertices these are the edges of kSections with repeats.
//
// The figure takes, of an upper and a lower crossing, the one nearer to the normal edge. That is the wrong one where
// the normals lean to both sides of the plane (a polygon that crosses itself), and none on a tie. Here sides decide:
// the lower crossing belongs to the far normal edge of a section that turns counter-clockwise.
constexpr int hardware_edge(Sides sides, int vertex) {
  using section_detail::far_side, section_detail::within;
  const int own = vertex / 2;
  const bool right = vertex % 2 == 1;
  if (within(sides, own)) return kNormalEdge + own;
  for (int turn = 0; turn < 2; ++turn) {  // primary, then secondary
    const bool to_next = right == (turn == 0);
    const int other = (own + (to_next ? 1 : 2)) % 3, third = 3 - own - other, edge = to_next ? own : other;
    const bool lower = far_side(sides, own) != far_side(sides, other);
    const bool upper = far_side(sides, own + 3) != far_side(sides, other + 3);
    const bool reversed = within(sides, third) && far_side(sides, third);
    const bool prefer_lower = far_side(sides, own) != reversed;
    if (lower && (!upper || prefer_lower)) return kLowerEdge + edge;
    if (upper) return kUpperEdge + edge;
  }
  return -1;
}

}  // namespace volumark
