#include "methods/reference/transfer_pieces.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace volumark {
namespace {

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

TransferSegment constant_segment(const TransferPoint& p) {
  TransferSegment segment;
  segment.origin = p.value;
  segment.extinction = p.extinction;
  segment.colour = p.colour;
  segment.empty = p.extinction == 0;
  return segment;
}

TransferSegment sloped_segment(const TransferPoint& a, const TransferPoint& b) {
  TransferSegment segment = constant_segment(a);
  const double width = b.value - a.value;
  segment.extinction_slope = (b.extinction - a.extinction) / width;
  segment.colour_slope = (b.colour - a.colour) / width;
  segment.steepest_colour = largest(segment.colour_slope);
  segment.empty = a.extinction == 0 && b.extinction == 0;
  return segment;
}

TransferJump jump_between(const TransferPoint& a, const TransferPoint& b) {
  return {std::abs(b.extinction - a.extinction), largest(b.extinction * b.colour - a.extinction * a.colour)};
}

}  // namespace

TransferPieces::TransferPieces(const TransferFunction& transfer) {
  const auto& points = transfer.points;
  segments_.push_back(constant_segment(points.front()));
  for (size_t i = 0; i < points.size();) {
    size_t last = i;  // of the points at this value
    while (last + 1 < points.size() && points[last + 1].value <= points[i].value) ++last;
    values_.push_back(points[i].value);
    jumps_.push_back(jump_between(points[i], points[last]));
    segments_.push_back(last + 1 < points.size() ? sloped_segment(points[last], points[last + 1])
                                                 : constant_segment(points[last]));
    i = last + 1;
  }
  occupied_before_.push_back(0);
  for (const TransferSegment& s : segments_) occupied_before_.push_back(occupied_before_.back() + (s.empty ? 0 : 1));
  for (const TransferJump& j : jumps_) has_jumps_ = has_jumps_ || j.extinction > 0 || j.emission > 0;
  max_extinction_ = transfer.max_extinction();
  for (const TransferPoint& p : points) max_colour_ = std::max(max_colour_, largest(p.colour));
}

int TransferPieces::segment_above(double s) const {
  return static_cast<int>(std::upper_bound(values_.begin(), values_.end(), s) - values_.begin());
}
int TransferPieces::segment_below(double s) const {
  return static_cast<int>(std::lower_bound(values_.begin(), values_.end(), s) - values_.begin());
}
bool TransferPieces::empty_range(double lo, double hi) const {
  // At a control value both neighbours count: the value there is the upper one's, its limit the lower one's.
  return empty(segment_below(lo), segment_above(hi));
}

}  // namespace volumark
