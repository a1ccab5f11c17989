// A vessel tree as angiography shows it, for scenes that need no file: branching tubes that taper after Murray's law
// (The Physiological Principle of Minimum Work, PNAS 1926: r0^3 = r1^3 + r2^3), with an aneurysm on one of its forks.
// Seeded: the same specification gives the same tree everywhere. Lengths are in units of half the longest axis of the
// box, as p of scenes/procedural.h.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace volumark {

// value = S((d + softness) / (2 softness)), in [0, 1]: d is the signed distance to the nearest vessel's wall (negative
// inside), S(x) falls from 1 at x <= 0 to 0 at x >= 1 as 1 - x^2 (3 - 2 x). So the wall lies at 1/2 where a vessel is
// wider than `softness`, and one that is thinner is dimmer, as where voxels are filled in part.
struct VesselTreeField {
  uint32_t seed = 1;
  int generations = 7;      // forks from the trunk to a tip
  double radius = 0.055;    // of the trunk
  double aneurysm = 3;      // radius of the bulge in radii of the vessel that bears it; 0: none
  double softness = 0.024;  // half the width of the wall's edge
};

// The tree grown into the box |p| <= half (the trunk enters through the face of -y); then a function of position.
class VesselTree {
 public:
  VesselTree(const VesselTreeField& field, const glm::dvec3& half);
  double value(const glm::dvec3& p) const;

  // A stretch of vessel: a cone between two balls.
  struct Segment {
    glm::dvec3 from, to;
    double radius_from, radius_to;
  };
  const std::vector<Segment>& segments() const { return segments_; }

 private:
  static constexpr int kCells = 24;  // of the look-up grid, a side
  void fill_grid(const glm::dvec3& half);
  size_t cell_of(const glm::dvec3& p) const;

  double softness_;
  glm::dvec3 lo_{0}, cell_{1};
  std::vector<Segment> segments_;
  std::vector<std::vector<uint32_t>> grid_;  // segments that reach into each cell
};

}  // namespace volumark
