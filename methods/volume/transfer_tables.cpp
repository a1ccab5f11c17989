// The transfer function as tables. Pre-integration: for each difference m = |back - front| the segment is cut at the
// table's nodes into m units of equal length; units are integrated once, and all runs of m units composed with "over"
// (associative) from prefixes and suffixes of blocks of m (van Herk, Gil and Werman): O(1) a table entry. After Lum,
// Wilson and Ma, High-Quality Lighting and Efficient Pre-Integration for Volume Rendering, VisSym 2004, section 4.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "backends/defects.h"
#include "methods/volume/volume_resources.h"

namespace volumark {
namespace {

// A stretch of ray, seen from its front end: emitted light that leaves it and what it lets through.
struct Stretch {
  glm::dvec3 colour{0};
  double transmitted = 1;
};
Stretch operator+(const Stretch& front, const Stretch& back) {  // front over back
  return {front.colour + front.transmitted * back.colour, front.transmitted * back.transmitted};
}

// A linear piece of the transfer function inside one table interval; `share`: its part of the interval.
struct Piece {
  glm::dvec4 first, last;  // (r, g, b, tau)
  double share;
};
using Interval = std::vector<Piece>;

// -expm1(-x) / x for x >= 0.
double opacity_ratio(double x) {
  if (defect(Defect::CancellingSelfAttenuation) && x > 0) return (1 - std::exp(-static_cast<float>(x))) / x;
  return x > 0 ? -std::expm1(-x) / x : 1;
}

// Light from `length` of a piece whose optical depth is small: Gauss-Legendre, five nodes.
Stretch integrate_small(const glm::dvec4& first, const glm::dvec4& last, double length) {
  constexpr std::array<double, 5> kNode = {0.04691007703066800, 0.23076534494715845, 0.5, 0.76923465505284155,
                                           0.95308992296933200};
  constexpr std::array<double, 5> kWeight = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                             0.23931433524968324, 0.11846344252809454};
  Stretch result;
  for (size_t i = 0; i < kNode.size(); ++i) {
    const double t = kNode[i];
    const glm::dvec4 here = glm::mix(first, last, t);
    const double depth = length * t * (first.a + 0.5 * t * (last.a - first.a));
    result.colour += glm::dvec3(here) * (here.a * std::exp(-depth) * kWeight[i] * length);
  }
  result.transmitted = std::exp(-0.5 * (first.a + last.a) * length);
  return result;
}

Stretch integrate(const glm::dvec4& first, const glm::dvec4& last, double length) {
  if (first == last) {
    const double depth = first.a * length;
    return {glm::dvec3(first) * -std::expm1(-depth), std::exp(-depth)};
  }
  // Parts of at most .5 optical depth: five nodes then err by less than 1e-13. Nothing behind a depth of 40 is seen.
  const double depth = 0.5 * (first.a + last.a) * length;
  const int parts =
      static_cast<int>(std::clamp(std::ceil(2 * std::max({depth, first.a * length, last.a * length})), 1., 4096.));
  Stretch result;
  for (int i = 0; i < parts && result.transmitted > 4e-18; ++i) {
    const glm::dvec4 from = glm::mix(first, last, static_cast<double>(i) / parts);
    const glm::dvec4 to = glm::mix(first, last, static_cast<double>(i + 1) / parts);
    result = result + integrate_small(from, to, length / parts);
  }
  return result;
}

Stretch integrate(const Interval& interval, double length, bool reversed) {
  Stretch result;
  for (size_t i = 0; i < interval.size(); ++i) {
    const Piece& piece = interval[reversed ? interval.size() - 1 - i : i];
    result = result + (reversed ? integrate(piece.last, piece.first, length * piece.share)
                                : integrate(piece.first, piece.last, length * piece.share));
  }
  return result;
}

glm::dvec4 value_of(const TransferPoint& point) { return {point.colour, point.extinction}; }

// Limit of the transfer function at s from below (a jump's first point; `at` gives the second).
glm::dvec4 below(const TransferFunction& transfer, double s) {
  const auto& points = transfer.points;
  const auto found =
      std::lower_bound(points.begin(), points.end(), s, [](const TransferPoint& p, double v) { return p.value < v; });
  return found != points.end() && found->value == s ? value_of(*found) : transfer.at(s);
}

std::vector<Interval> intervals_of(const TransferFunction& transfer, int count) {
  std::vector<Interval> intervals(static_cast<size_t>(count));
  const auto value_at = [&](int i) { return transfer.lo + (transfer.hi - transfer.lo) * i / count; };
  for (int i = 0; i < count; ++i) {
    const double lo = value_at(i), hi = value_at(i + 1);
    std::vector<double> cuts = {lo};
    for (const TransferPoint& point : transfer.points) {
      if (point.value > cuts.back() && point.value < hi) cuts.push_back(point.value);
    }
    cuts.push_back(hi);
    for (size_t c = 0; c + 1 < cuts.size(); ++c) {
      intervals[static_cast<size_t>(i)].push_back(
          {transfer.at(cuts[c]), below(transfer, cuts[c + 1]), (cuts[c + 1] - cuts[c]) / (hi - lo)});
    }
  }
  return intervals;
}

// The homogeneous segment that looks like `stretch` and has the exact mean extinction.
glm::vec4 as_homogeneous(const Stretch& stretch, double mean_extinction, double segment) {
  const double weight = segment * opacity_ratio(mean_extinction * segment);
  return glm::vec4(glm::dvec4(stretch.colour / weight, mean_extinction));
}

}  // namespace

std::vector<float> transfer_table(const TransferFunction& transfer, int nodes) {
  const int count = nodes - 1;
  std::vector<glm::dvec4> values;
  values.reserve(static_cast<size_t>(nodes));
  const double shift = defect(Defect::ShiftedTable) ? 0.5 : 0;
  for (int i = 0; i < nodes; ++i)
    values.push_back(transfer.at(transfer.lo + (transfer.hi - transfer.lo) * (i + shift) / count));
  // A jump inside an interval becomes a ramp over it. The nearer of its two nodes is moved so that the integral over
  // the table stays that of the jump: it then errs in width, not in place.
  for (size_t p = 0; p + 1 < transfer.points.size(); ++p) {
    const double value = transfer.points[p].value;
    if (value != transfer.points[p + 1].value) continue;
    const double x = (value - transfer.lo) / (transfer.hi - transfer.lo) * count;
    const double node = std::floor(x), f = x - node;
    if (node < 0 || node >= count || f < 1e-9 || f > 1 - 1e-9) continue;  // on a node: exact there
    const auto i = static_cast<size_t>(node);
    const glm::dvec4 jump = value_of(transfer.points[p + 1]) - value_of(transfer.points[p]);
    if (f < 0.5) {
      values[i] += jump * (0.5 - f);
    } else {
      values[i + 1] -= jump * (f - 0.5);
    }
  }
  std::vector<float> table;
  table.reserve(values.size() * 4);
  for (const glm::dvec4& value : values) {
    for (int channel = 0; channel < 4; ++channel) table.push_back(static_cast<float>(value[channel]));
  }
  return table;
}

std::vector<float> preintegration_table(const TransferFunction& transfer, int size, double segment) {
  const int count = size - 1;
  const std::vector<Interval> intervals = intervals_of(transfer, count);
  std::vector<double> sum(static_cast<size_t>(size));  // integral of the extinction up to each node, in intervals
  for (int i = 0; i < count; ++i) {
    double mean = 0;
    for (const Piece& piece : intervals[static_cast<size_t>(i)]) {
      mean += 0.5 * (piece.first.a + piece.last.a) * piece.share;
    }
    sum[static_cast<size_t>(i) + 1] = sum[static_cast<size_t>(i)] + mean;
  }
  std::vector<float> table(static_cast<size_t>(size) * static_cast<size_t>(size) * 4);
  const auto put = [&](int front, int back, const glm::vec4& value) {
    float* texel =
        table.data() + (static_cast<size_t>(back) * static_cast<size_t>(size) + static_cast<size_t>(front)) * 4;
    for (int channel = 0; channel < 4; ++channel) texel[channel] = value[channel];
  };
  for (int i = 0; i < size; ++i) {
    const glm::dvec4 value = transfer.at(transfer.lo + (transfer.hi - transfer.lo) * i / count);
    put(i, i, glm::vec4(glm::dvec4(glm::dvec3(value) * value.a, value.a)));
  }
  std::vector<Stretch> unit(static_cast<size_t>(count)), prefix(unit.size()), suffix(unit.size());
  for (const bool reversed : {false, true}) {
    for (int m = 1; m <= count; ++m) {
      const auto run = static_cast<size_t>(m);
      for (size_t i = 0; i < unit.size(); ++i) unit[i] = integrate(intervals[i], segment / m, reversed);
      // Along the table; a reversed run is composed from its upper end down.
      const auto joined = [&](const Stretch& low, const Stretch& high) { return reversed ? high + low : low + high; };
      for (size_t i = 0; i < unit.size(); ++i) prefix[i] = i % run == 0 ? unit[i] : joined(prefix[i - 1], unit[i]);
      for (size_t i = unit.size(); i-- > 0;) {
        const bool last = i + 1 == unit.size() || (i + 1) % run == 0;
        suffix[i] = last ? unit[i] : joined(unit[i], suffix[i + 1]);
      }
      for (size_t i = 0; i + run <= unit.size(); ++i) {
        const Stretch whole = i % run == 0 ? prefix[i + run - 1] : joined(suffix[i], prefix[i + run - 1]);
        const double mean = (sum[i + run] - sum[i]) / m;
        const int low = static_cast<int>(i), high = low + m;
        put(reversed ? high : low, reversed ? low : high, as_homogeneous(whole, mean, segment));
      }
    }
  }
  return table;
}

}  // namespace volumark
