#include "methods/raycast/bricks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace volumark {
namespace {

int brick_count(int samples, int edge) { return std::max(1, (samples - 1 + edge - 1) / edge); }

struct Range {
  float lo = std::numeric_limits<float>::infinity();
  float hi = -std::numeric_limits<float>::infinity();
};

// Ranges of one row of samples, by brick along x.
template <class T>
void reduce_row(const T* row, int samples, int edge, std::vector<Range>& out) {
  for (size_t b = 0; b < out.size(); ++b) {
    const int first = static_cast<int>(b) * edge;
    const int last = std::min(first + edge, samples - 1);
    T lo = row[first], hi = row[first];
    for (int i = first + 1; i <= last; ++i) {
      lo = std::min(lo, row[i]);
      hi = std::max(hi, row[i]);
    }
    out[b] = {static_cast<float>(lo), static_cast<float>(hi)};
  }
}

// The bricks along one axis whose sample range holds sample `i`: one, or two where it lies on their shared face.
std::pair<int, int> bricks_of_sample(int i, int edge, int count) {
  const int own = std::min(i / edge, count - 1);
  return {i > 0 && i % edge == 0 && i / edge <= count - 1 ? own - 1 : own, own};
}

template <class T>
void reduce(const Volume& volume, BrickRanges& out) {
  const auto* voxels = reinterpret_cast<const T*>(volume.voxels.data());
  std::vector<Range> row(static_cast<size_t>(out.count.x));
  for (int k = 0; k < volume.size.z; ++k) {
    const auto [z0, z1] = bricks_of_sample(k, out.edge, out.count.z);
    for (int j = 0; j < volume.size.y; ++j, voxels += volume.size.x) {
      const auto [y0, y1] = bricks_of_sample(j, out.edge, out.count.y);
      reduce_row(voxels, volume.size.x, out.edge, row);
      for (int z = z0; z <= z1; ++z) {
        for (int y = y0; y <= y1; ++y) {
          float* lo = &out.lo[out.index(0, y, z)];
          float* hi = &out.hi[out.index(0, y, z)];
          for (size_t x = 0; x < row.size(); ++x) {
            lo[x] = std::min(lo[x], row[x].lo);
            hi[x] = std::max(hi[x], row[x].hi);
          }
        }
      }
    }
  }
}

void to_data_units(const Volume& volume, BrickRanges& ranges) {
  for (size_t i = 0; i < ranges.lo.size(); ++i) {
    const double a = static_cast<double>(ranges.lo[i]) * volume.slope + volume.intercept;
    const double b = static_cast<double>(ranges.hi[i]) * volume.slope + volume.intercept;
    ranges.lo[i] = static_cast<float>(std::min(a, b));
    ranges.hi[i] = static_cast<float>(std::max(a, b));
  }
}

// Answers whether the extinction is above 0 somewhere in a closed interval: at one of its ends, or at a control point
// inside, since it is linear in between.
class Opaque {
 public:
  explicit Opaque(const TransferFunction& transfer) {
    size_t positive = 0;
    for (const TransferPoint& point : transfer.points) {
      values_.push_back(point.value);
      positive_before_.push_back(positive);
      positive += point.extinction > 0;
    }
    positive_before_.push_back(positive);
  }
  bool within(double lo, double hi) const {
    const size_t first = index(std::lower_bound(values_.begin(), values_.end(), lo));
    const size_t last = index(std::upper_bound(values_.begin(), values_.end(), hi));
    return positive_before_[last] > positive_before_[first] || at(lo) || at(hi);
  }

 private:
  size_t index(std::vector<double>::const_iterator it) const { return static_cast<size_t>(it - values_.begin()); }
  bool positive(size_t i) const { return positive_before_[i + 1] > positive_before_[i]; }
  bool at(double value) const {
    const size_t next = index(std::upper_bound(values_.begin(), values_.end(), value));
    if (next == 0) return positive(0);
    if (next == values_.size()) return positive(next - 1);
    return positive(next - 1) || (positive(next) && value > values_[next - 1]);
  }
  std::vector<double> values_;
  std::vector<size_t> positive_before_;
};

// One sweep of the exact two-sweep Chebyshev transform: from each brick's 13 predecessors in scan order.
void sweep(std::vector<uint8_t>& distance, const glm::ivec3& n, bool forward) {
  const int sign = forward ? 1 : -1;
  const auto at = [&](int x, int y, int z) -> uint8_t& {
    return distance[static_cast<size_t>((z * n.y + y) * n.x + x)];
  };
  for (int kz = 0; kz < n.z; ++kz) {
    const int z = forward ? kz : n.z - 1 - kz;
    for (int ky = 0; ky < n.y; ++ky) {
      const int y = forward ? ky : n.y - 1 - ky;
      for (int kx = 0; kx < n.x; ++kx) {
        const int x = forward ? kx : n.x - 1 - kx;
        int best = at(x, y, z);
        const auto row = [&](int yy, int zz, int last) {
          if (yy < 0 || yy >= n.y || zz < 0 || zz >= n.z) return;
          for (int d = -1; d <= last; ++d) {
            const int xx = x + sign * d;
            if (xx >= 0 && xx < n.x) best = std::min(best, at(xx, yy, zz) + 1);
          }
        };
        if (best > 0) {
          row(y, z, -1);
          row(y - sign, z, 1);
          for (int dy = -1; dy <= 1; ++dy) row(y + dy, z - sign, 1);
          at(x, y, z) = static_cast<uint8_t>(best);
        }
      }
    }
  }
}

}  // namespace

BrickRanges brick_ranges(const Volume& volume, int edge) {
  BrickRanges out;
  out.edge = edge;
  out.count = {brick_count(volume.size.x, edge), brick_count(volume.size.y, edge), brick_count(volume.size.z, edge)};
  const size_t bricks =
      static_cast<size_t>(out.count.x) * static_cast<size_t>(out.count.y) * static_cast<size_t>(out.count.z);
  out.lo.assign(bricks, Range{}.lo);
  out.hi.assign(bricks, Range{}.hi);
  switch (volume.type) {
    case VoxelType::U8:
      reduce<uint8_t>(volume, out);
      break;
    case VoxelType::U16:
      reduce<uint16_t>(volume, out);
      break;
    case VoxelType::I16:
      reduce<int16_t>(volume, out);
      break;
    case VoxelType::F32:
      reduce<float>(volume, out);
      break;
  }
  to_data_units(volume, out);
  return out;
}

BrickDistances brick_distances(const BrickRanges& ranges, const TransferFunction& transfer, int table_size,
                               double widen) {
  const Opaque opaque(transfer);
  const double spacing = (transfer.hi - transfer.lo) / (table_size - 1);
  const auto entry_below = [&](double value) {
    return transfer.lo + std::floor((value - transfer.lo) / spacing) * spacing;
  };
  const auto entry_above = [&](double value) {
    return transfer.lo + std::ceil((value - transfer.lo) / spacing) * spacing;
  };
  BrickDistances out;
  out.distance.resize(ranges.lo.size());
  for (size_t i = 0; i < ranges.lo.size(); ++i) {
    const bool occupied = opaque.within(entry_below(static_cast<double>(ranges.lo[i]) - widen),
                                        entry_above(static_cast<double>(ranges.hi[i]) + widen));
    out.distance[i] = occupied ? 0 : 255;
    out.occupied += occupied;
  }
  sweep(out.distance, ranges.count, true);
  sweep(out.distance, ranges.count, false);
  return out;
}

OpaqueWindow opaque_window(const TransferFunction& transfer, int table_size) {
  const Opaque opaque(transfer);
  const double spacing = (transfer.hi - transfer.lo) / (table_size - 1);
  const auto interval_is_opaque = [&](int i) {
    return opaque.within(transfer.lo + i * spacing, transfer.lo + (i + 1) * spacing);
  };
  const int last = table_size - 2;
  int first = 0;
  while (first <= last && !interval_is_opaque(first)) ++first;
  if (first > last) return {};
  int end = last;
  while (!interval_is_opaque(end)) --end;
  // An open interval of a float step more on either side.
  constexpr float kAll = std::numeric_limits<float>::infinity();
  const auto position = [&](int i) { return static_cast<float>(i) / static_cast<float>(table_size - 1); };
  return {first == 0 ? -kAll : std::nextafter(position(first), -kAll),
          end == last ? kAll : std::nextafter(position(end + 1), kAll)};
}

}  // namespace volumark
