#include "methods/raycast/bricks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "backends/defects.h"
#include "methods/volume/volume_resources.h"

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
  if (defect(Defect::BricksMissNeighbours)) return {own, own};
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

// Whether the extinction is above 0 somewhere in [lo, hi]: at one of its ends, or at a control point inside, since it
// is linear in between.
bool extinction_within(const TransferFunction& transfer, double lo, double hi) {
  if (transfer.at(lo).a > 0 || transfer.at(hi).a > 0) return true;
  return std::any_of(transfer.points.begin(), transfer.points.end(), [&](const TransferPoint& point) {
    return point.value >= lo && point.value <= hi && point.extinction > 0;
  });
}

// One sweep of the exact two-sweep Chebyshev transform: from each brick's 13 predecessors in scan order.
void sweep(std::vector<uint8_t>& distance, const glm::ivec3& n, bool forward) {
  const int sign = forward ? 1 : -1;
  const auto at = [&](int x, int y, int z) -> uint8_t& {
    return distance[(static_cast<size_t>(z) * static_cast<size_t>(n.y) + static_cast<size_t>(y)) *
                        static_cast<size_t>(n.x) +
                    static_cast<size_t>(x)];
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

OpaqueValues::OpaqueValues(const TransferFunction& transfer, Classification classification, int table_size)
    : lo_(transfer.lo), scale_((table_size - 1) / (transfer.hi - transfer.lo)) {
  const auto nodes = static_cast<size_t>(table_size);
  std::vector<bool> opaque(2 * nodes - 1);
  if (classification == Classification::Preintegrated) {
    const auto value = [&](size_t node) { return transfer.lo + static_cast<double>(node) / scale_; };
    for (size_t i = 0; i < nodes; ++i) {
      opaque[2 * i] = transfer.at(value(i)).a > 0;
      if (i + 1 < nodes) opaque[2 * i + 1] = extinction_within(transfer, value(i), value(i + 1));
    }
  } else {
    const std::vector<float> table = transfer_table(transfer, table_size);
    for (size_t i = 0; i < nodes; ++i) {
      opaque[2 * i] = table[4 * i + 3] > 0;
      if (i + 1 < nodes) opaque[2 * i + 1] = table[4 * i + 3] > 0 || table[4 * i + 7] > 0;
    }
  }
  opaque_before_.push_back(0);
  for (const bool here : opaque) opaque_before_.push_back(opaque_before_.back() + (here ? 1 : 0));
}

size_t OpaqueValues::place(double value) const {
  const double last = static_cast<double>(opaque_before_.size() - 2) / 2;
  const double node = std::clamp((value - lo_) * scale_, 0.0, last);
  const double below = std::floor(node);
  return 2 * static_cast<size_t>(below) + (node > below ? 1 : 0);
}

bool OpaqueValues::any(double lo, double hi) const { return opaque_before_[place(hi) + 1] > opaque_before_[place(lo)]; }

OpaqueValues::Window OpaqueValues::window() const {
  const size_t places = opaque_before_.size() - 1, all = opaque_before_.back();
  if (all == 0) return {};
  size_t first = 0, end = places;  // of the opaque places
  while (opaque_before_[first + 1] == 0) ++first;
  while (opaque_before_[end - 1] == all) --end;
  // Open intervals, so that a value which rounding puts on their end is still seen.
  constexpr float kAll = std::numeric_limits<float>::infinity();
  const auto value = [&](size_t place) { return static_cast<float>(place) / static_cast<float>(places - 1); };
  return {first == 0 ? -kAll : std::nextafter(value((first - 1) / 2 * 2), -kAll),
          end == places ? kAll : std::nextafter(value((end + 1) / 2 * 2), kAll)};
}

BrickDistances brick_distances(const glm::ivec3& count, const std::vector<uint8_t>& occupied) {
  BrickDistances out;
  out.distance.resize(occupied.size());
  for (size_t i = 0; i < occupied.size(); ++i) {
    out.distance[i] = occupied[i] != 0 ? 0 : 255;
    out.occupied += occupied[i] != 0;
  }
  sweep(out.distance, count, true);
  sweep(out.distance, count, false);
  return out;
}

BrickDistances brick_distances(const BrickRanges& ranges, const OpaqueValues& opaque, double widen) {
  std::vector<uint8_t> occupied(ranges.lo.size());
  for (size_t i = 0; i < occupied.size(); ++i) {
    occupied[i] = opaque.any(static_cast<double>(ranges.lo[i]) - widen, static_cast<double>(ranges.hi[i]) + widen);
  }
  return brick_distances(ranges.count, occupied);
}

void put_bricks(const BrickRanges& ranges, const Volume& volume, VolumeUniforms& uniforms) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    uniforms.own[0][a] = static_cast<float>(ranges.count[axis]);
    uniforms.own[1][a] =
        ranges.edge > 0 ? static_cast<float>(volume.size[axis] - 1) / static_cast<float>(ranges.edge) : 0;
  }
  uniforms.own[1][3] = ranges.edge > 0 ? 1 / static_cast<float>(ranges.edge) : 0;
}

}  // namespace volumark
