#include "harness/verify/edges.h"

#include <algorithm>
#include <cmath>

namespace volumark {
namespace {

double apart(const PixelValue& a, const PixelValue& b) {
  double out = 0;
  for (size_t channel = 0; channel < a.size(); ++channel)
    out = std::max(out, std::abs(static_cast<double>(a[channel]) - static_cast<double>(b[channel])));
  return out;
}

}  // namespace

bool is_passing_edge(std::span<const PixelValue> values) {
  if (values.size() != std::size(kEdgePlaces)) return false;
  const auto finite = [](float value) { return std::isfinite(value); };
  for (const PixelValue& value : values)
    if (!std::all_of(value.begin(), value.end(), finite)) return false;
  const double jump = apart(values.front(), values.back());
  if (!(jump > 0)) return false;
  bool passed = false;
  for (size_t i = 0; i < values.size(); ++i) {
    const bool before = apart(values[i], values.front()) <= jump / 10;
    const bool after = apart(values[i], values.back()) <= jump / 10;
    if (!before && !after) return false;
    if (std::abs(kEdgePlaces[i]) < kEdgeOpen) continue;
    if (passed && before) return false;
    passed = after;
  }
  return passed;
}

size_t edges_allowed(size_t large) { return std::max<size_t>(4, large / 5); }

}  // namespace volumark
