#include "methods/slices2d/strips.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace volumark {
namespace {

// A corner that is nearer to a stored slice lies on it: planes parallel to the slices are not cut by rounding.
constexpr double kOnSlice = 1e-9;

}  // namespace

void StripBuilder::clear() {
  vertices_.clear();
  indices_.clear();
  runs_.clear();
  polygons_ = strips_ = 0;
}

// rest_ into below_ and above_; the points on the cut are in both.
void StripBuilder::split(double level) {
  below_.clear();
  above_.clear();
  const auto side = [level](const PlanePoint& p) {
    const double d = p.stored - level;
    return std::abs(d) <= kOnSlice ? 0 : (d < 0 ? -1 : 1);
  };
  for (size_t i = 0; i < rest_.size(); ++i) {
    const PlanePoint& a = rest_[i];
    const PlanePoint& b = rest_[(i + 1) % rest_.size()];
    const int side_a = side(a), side_b = side(b);
    if (side_a <= 0) below_.push_back(a);
    if (side_a >= 0) above_.push_back(a);
    if (side_a * side_b < 0) {
      const double t = (level - a.stored) / (b.stored - a.stored);
      const PlanePoint crossing{glm::mix(a.clip, b.clip, t), level};
      below_.push_back(crossing);
      above_.push_back(crossing);
    }
  }
}

void StripBuilder::add_strip(int first, std::span<const PlanePoint> corners, bool weighted, double depth) {
  if (corners.size() < 3) return;
  cut_.push_back({first, static_cast<uint32_t>(vertices_.size()), static_cast<uint32_t>(corners.size())});
  for (const PlanePoint& p : corners) {
    vertices_.push_back({static_cast<float>(p.clip.x), static_cast<float>(p.clip.y), static_cast<float>(p.clip.z),
                         static_cast<float>(depth), static_cast<float>(first),
                         weighted ? static_cast<float>(p.stored - first) : 0.F});
  }
}

void StripBuilder::add_page(const StackLayout& layout, int page, int reach) {
  const auto number = static_cast<size_t>(page);
  const int begin = layout.pages[number].first;
  const int end = number + 1 < layout.pages.size() ? layout.pages[number + 1].first : layout.slices;
  const auto first_index = static_cast<uint32_t>(indices_.size());
  for (const Strip& strip : cut_) {
    if (strip.first + reach < begin || strip.first - reach >= end) continue;
    for (uint32_t corner = 2; corner < strip.corners; ++corner)
      indices_.insert(indices_.end(), {strip.base, strip.base + corner - 1, strip.base + corner});
  }
  const auto count = static_cast<uint32_t>(indices_.size()) - first_index;
  if (count == 0) return;
  if (runs_.empty() || runs_.back().page != page) runs_.push_back({page, first_index, 0});
  runs_.back().index_count += count;
}

void StripBuilder::add(std::span<const PlanePoint> polygon, Between between, double depth, const StackLayout& layout,
                       double reach) {
  if (polygon.size() < 3) return;
  const bool weighted = between == Between::TwoSlices;
  // Strip k ends at level k + 1 - offset.
  const double offset = weighted ? 0 : 0.5;
  const int count = weighted ? std::max(layout.slices - 1, 1) : layout.slices;
  double low = polygon.front().stored, high = low;
  for (const PlanePoint& p : polygon) {
    low = std::min(low, p.stored);
    high = std::max(high, p.stored);
  }
  cut_.clear();
  rest_.assign(polygon.begin(), polygon.end());
  int strip = static_cast<int>(std::clamp(std::floor(low + offset + kOnSlice), 0., count - 1.));
  for (; strip < count - 1 && high > strip + 1 - offset + kOnSlice; ++strip) {
    split(strip + 1 - offset);
    add_strip(strip, below_, weighted, depth);
    rest_.swap(above_);
  }
  add_strip(strip, rest_, weighted, depth);
  if (cut_.empty()) return;
  ++polygons_;
  strips_ += static_cast<int>(cut_.size());
  // Pages up and down in turn: the last one of a polygon is the first one of the next.
  const int pages = static_cast<int>(layout.pages.size());
  const int whole_reach = reach > 0 ? static_cast<int>(std::ceil(std::min(reach, 1. * layout.slices))) + 1 : 0;
  const bool downwards = !runs_.empty() && runs_.back().page > 0;
  for (int i = 0; i < pages; ++i) add_page(layout, downwards ? pages - 1 - i : i, whole_reach);
}

}  // namespace volumark
