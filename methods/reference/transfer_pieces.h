// A transfer function cut at its distinct control values v_0 < v_1 < ...: segment 0 lies below v_0, segment j between
// v_(j-1) and v_j, the last one above. In each, extinction and colour are affine.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "scenes/scene.h"

namespace volumark {

struct TransferSegment {
  double origin = 0;  // data value at which extinction and colour are stated
  double extinction = 0, extinction_slope = 0;
  glm::dvec3 colour{0}, colour_slope{0};
  double steepest_colour = 0;  // largest |colour_slope|
  bool empty = true;           // extinction 0 throughout
};

// What changes abruptly at a control value.
struct TransferJump {
  double extinction = 0;  // |difference| of extinction
  double emission = 0;    // largest |difference| of extinction * colour
};

class TransferPieces {
 public:
  explicit TransferPieces(const TransferFunction& transfer);

  double value(int i) const { return values_[static_cast<size_t>(i)]; }
  const TransferSegment& segment(int j) const { return segments_[static_cast<size_t>(j)]; }
  const TransferJump& jump(int i) const { return jumps_[static_cast<size_t>(i)]; }
  bool has_jumps() const { return has_jumps_; }
  int value_count() const { return static_cast<int>(values_.size()); }

  // How many control values are <= s, or < s: the segment just above s, or just below it.
  int segment_above(double s) const;
  int segment_below(double s) const;
  bool empty(int first, int last) const {  // segments first .. last, inclusive
    return occupied_before_[static_cast<size_t>(last) + 1] == occupied_before_[static_cast<size_t>(first)];
  }
  bool empty_range(double lo, double hi) const;  // no extinction for any value in [lo, hi]

  double max_extinction() const { return max_extinction_; }
  double max_colour() const { return max_colour_; }  // largest channel where there is extinction

 private:
  std::vector<double> values_;
  std::vector<TransferSegment> segments_;
  std::vector<TransferJump> jumps_;
  std::vector<int> occupied_before_;
  bool has_jumps_ = false;
  double max_extinction_ = 0, max_colour_ = 0;
};

}  // namespace volumark
