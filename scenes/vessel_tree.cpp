#include "scenes/vessel_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace volumark {
namespace {

// splitmix64: the same on every library, unlike the standard distributions.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  double unit() {  // [0, 1)
    state_ += 0x9e3779b97f4a7c15;
    uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    z ^= z >> 31;
    return static_cast<double>(z >> 11) * 0x1p-53;
  }
  double between(double lo, double hi) { return lo + (hi - lo) * unit(); }
  glm::dvec3 in_cube() {  // one after the other: the order of arguments is not fixed
    const double x = between(-1, 1), y = between(-1, 1);
    return {x, y, between(-1, 1)};
  }

 private:
  uint64_t state_;
};

struct Tip {
  glm::dvec3 at, direction;
  double radius;
  int generation;
};

// What makes a tree of it, in parts of the direction a step.
const glm::dvec3 kUpwards(0, 0.07, 0);

class Growth {
 public:
  Growth(const VesselTreeField& field, const glm::dvec3& half)
      : field_(field), half_(half), random_(field.seed * uint64_t{0x632be59bd9b4e019} + 1) {}

  std::vector<VesselTree::Segment> grow() {
    std::vector<Tip> tips{{{0, -half_.y, 0}, {0, 1, 0}, field_.radius, 0}};
    while (!tips.empty()) {  // generation by generation: the order of random numbers is that of the forks
      std::vector<Tip> next;
      for (const Tip& tip : tips) {
        const Tip end = vessel(tip);
        if (end.generation < field_.generations) fork(end, next);
      }
      tips = std::move(next);
    }
    return std::move(segments_);
  }

 private:
  // A winding stretch up to the next fork.
  Tip vessel(Tip tip) {
    const double length = random_.between(4.5, 8) * std::sqrt(tip.radius * field_.radius);
    const int steps = std::max(2, static_cast<int>(std::ceil(length / (1.5 * tip.radius))));
    for (int i = 0; i < steps; ++i) {
      const glm::dvec3 bent = tip.direction + random_.in_cube() * 0.24 + kUpwards + push_of_walls(tip);
      tip.direction = glm::normalize(bent);
      const glm::dvec3 to = tip.at + tip.direction * (length / steps);
      const double radius = tip.radius * std::pow(0.97, 1.0 / steps);
      segments_.push_back({tip.at, to, tip.radius, radius});
      tip.at = to;
      tip.radius = radius;
    }
    return tip;
  }

  // Back into the box, from the outer fifth of it on; not on the trunk, which comes in through the face below.
  glm::dvec3 push_of_walls(const Tip& tip) const {
    glm::dvec3 push(0);
    for (int axis = 0; axis < 3 && tip.generation > 0; ++axis) {
      const double beyond = std::abs(tip.at[axis]) - 0.8 * half_[axis];
      if (beyond > 0) push[axis] = -std::copysign(3 * beyond / (0.2 * half_[axis]), tip.at[axis]);
    }
    return push;
  }

  void fork(const Tip& end, std::vector<Tip>& next) {
    const double share = random_.between(0.3, 0.5);
    glm::dvec3 side = glm::cross(end.direction, random_.in_cube());
    if (end.generation == 0) side = glm::dvec3(1, 0, 0);  // the first fork lies across the box
    if (glm::length(side) < 1e-3) side = glm::cross(end.direction, glm::dvec3(0.36, 0.48, 0.8));
    side = glm::normalize(side);
    for (const double part : {share, 1 - share}) {
      // The thinner branch turns farther off (Murray 1926, cosine of the angle by the radii); about 30 to 50 degrees.
      const double turn = (part == share ? 1 : -1) * (0.95 - 0.5 * part);
      const glm::dvec3 direction = glm::normalize(end.direction * std::cos(turn) + side * std::sin(turn));
      next.push_back({end.at, direction, end.radius * std::cbrt(part), end.generation + 1});
    }
    if (end.generation == 2 && field_.aneurysm > 0 && !has_aneurysm_) {
      const double bulge = field_.aneurysm * end.radius;  // a sac at the tip of the fork, on a narrower neck
      const glm::dvec3 centre = end.at + end.direction * (0.95 * bulge);
      segments_.push_back({end.at, centre, end.radius, 0.8 * bulge});
      segments_.push_back({centre, centre, bulge, bulge});
      has_aneurysm_ = true;
    }
  }

  const VesselTreeField& field_;
  glm::dvec3 half_;
  Random random_;
  std::vector<VesselTree::Segment> segments_;
  bool has_aneurysm_ = false;
};

double wall_distance(const VesselTree::Segment& segment, const glm::dvec3& p) {
  const glm::dvec3 along = segment.to - segment.from, from = p - segment.from;
  const double squared = glm::dot(along, along);
  const double t = squared > 0 ? std::clamp(glm::dot(from, along) / squared, 0.0, 1.0) : 0;
  return glm::length(from - along * t) - std::lerp(segment.radius_from, segment.radius_to, t);
}

}  // namespace

VesselTree::VesselTree(const VesselTreeField& field, const glm::dvec3& half)
    : softness_(field.softness), segments_(Growth(field, half).grow()) {
  fill_grid(half);
}

void VesselTree::fill_grid(const glm::dvec3& half) {
  lo_ = -half;
  cell_ = glm::max(2.0 * half / static_cast<double>(kCells), glm::dvec3(1e-12));
  grid_.resize(static_cast<size_t>(kCells) * kCells * kCells);
  for (size_t s = 0; s < segments_.size(); ++s) {
    const Segment& segment = segments_[s];
    const glm::dvec3 reach(std::max(segment.radius_from, segment.radius_to) + softness_);
    const glm::dvec3 least = (glm::min(segment.from, segment.to) - reach - lo_) / cell_;
    const glm::dvec3 most = (glm::max(segment.from, segment.to) + reach - lo_) / cell_;
    // One cell more on either side: a point on a border may be rounded into the neighbour.
    const glm::ivec3 a(glm::clamp(least - 1.0, 0.0, kCells - 1.0)), b(glm::clamp(most + 1.0, 0.0, kCells - 1.0));
    for (int z = a.z; z <= b.z; ++z)
      for (int y = a.y; y <= b.y; ++y)
        for (int x = a.x; x <= b.x; ++x)
          grid_[static_cast<size_t>((z * kCells + y) * kCells + x)].push_back(static_cast<uint32_t>(s));
  }
}

size_t VesselTree::cell_of(const glm::dvec3& p) const {
  const glm::ivec3 cell(glm::clamp((p - lo_) / cell_, 0.0, kCells - 1.0));
  return static_cast<size_t>((cell.z * kCells + cell.y) * kCells + cell.x);
}

double VesselTree::value(const glm::dvec3& p) const {
  double distance = softness_;  // from there on the value is 0
  for (const uint32_t s : grid_[cell_of(p)]) distance = std::min(distance, wall_distance(segments_[s], p));
  const double x = std::clamp((distance + softness_) / (2 * softness_), 0.0, 1.0);
  return 1 - x * x * (3 - 2 * x);
}

}  // namespace volumark
