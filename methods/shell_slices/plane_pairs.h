// Which prisms to hold against which planes: all, those whose bounding spheres a plane meets, or those of the active
// list. Planes are visited from back to front, prisms in their order on each, so that every choice draws the same.
#pragma once

#include <cstdint>
#include <vector>

#include "methods/shell_slices/section.h"
#include "methods/shell_slices/shell_frame.h"

namespace volumark {

enum class Reject : uint8_t { None, Spheres, ActiveList };

// Depths of all corners, by position, in planes: of each corner once, whichever prisms share it.
struct CornerDepths {
  std::vector<float> lower, upper;
  float slack = 0;  // twice what the depth of a corner may be off by, on any backend
};
void corner_depths(const ShellPrisms& shell, const ShellFrame& frame, CornerDepths& out);

inline Sides sides_of(const CornerDepths& depths, const Prism& prism, float plane) {
  unsigned sides = 0;
  for (unsigned i = 0; i < 3; ++i) {
    sides |= static_cast<unsigned>(depths.lower[prism.position[i]] >= plane) << i;
    sides |= static_cast<unsigned>(depths.upper[prism.position[i]] >= plane) << (i + 3);
  }
  return static_cast<Sides>(sides);
}

// For each prism the planes that may cross it, sorted by plane: prisms are put into the lists of the planes between
// their nearest and farthest corner, so that the work grows with the intersections, not with planes times prisms.
struct ActiveLists {
  std::vector<uint32_t> start;   // of each plane's prisms in `prisms`; one more than planes
  std::vector<uint32_t> prisms;  // numbers of prisms, ascending on each plane
};
void active_lists(const ShellPrisms& shell, const ShellFrame& frame, const CornerDepths& depths, ActiveLists& out);

// Planes that the bounding sphere of a prism reaches, as depths.
struct DepthInterval {
  float lo, hi;
};
void sphere_intervals(const ShellPrisms& shell, const ShellFrame& frame, const CornerDepths& depths,
                      std::vector<DepthInterval>& out);

// What a sweep did: a test is one prism held against one plane (by its sphere or its classes) or, with active lists,
// one entry of a list.
struct PairCounts {
  int64_t tests = 0, rejected = 0;
};

// Keeps its memory from frame to frame.
class PlanePairs {
 public:
  // visit(plane, prism number), for all pairs that are not rejected.
  template <class Visit>
  PairCounts visit(const ShellPrisms& shell, const ShellFrame& frame, const CornerDepths& depths, Reject reject,
                   const Visit& visit);

 private:
  ActiveLists lists_;
  std::vector<DepthInterval> intervals_;
};

template <class Visit>
PairCounts PlanePairs::visit(const ShellPrisms& shell, const ShellFrame& frame, const CornerDepths& depths,
                             Reject reject, const Visit& visit) {
  PairCounts counts;
  const auto prisms = static_cast<uint32_t>(shell.prisms.size());
  if (reject == Reject::ActiveList) active_lists(shell, frame, depths, lists_);
  if (reject == Reject::Spheres) sphere_intervals(shell, frame, depths, intervals_);
  for (int plane = frame.planes - 1; plane >= 0; --plane) {
    if (reject == Reject::ActiveList) {
      const uint32_t first = lists_.start[static_cast<size_t>(plane)],
                     last = lists_.start[static_cast<size_t>(plane) + 1];
      for (uint32_t i = first; i < last; ++i) visit(plane, lists_.prisms[i]);
      counts.tests += last - first;
      continue;
    }
    counts.tests += prisms;
    const auto at = static_cast<float>(plane);
    for (uint32_t prism = 0; prism < prisms; ++prism) {
      if (reject == Reject::Spheres && (at < intervals_[prism].lo || at > intervals_[prism].hi)) {
        ++counts.rejected;
        continue;
      }
      visit(plane, prism);
    }
  }
  return counts;
}

}  // namespace volumark
