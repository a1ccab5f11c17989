#include <algorithm>
#include <glm/common.hpp>

#include "scenes/scene.h"

namespace volumark {

glm::dvec4 TransferFunction::at(double s) const {
  const auto value_of = [](const TransferPoint& p) { return glm::dvec4(p.colour, p.extinction); };
  // The first point above s; at a jump (two points at s) the segment above starts at the second of them.
  const auto above =
      std::upper_bound(points.begin(), points.end(), s, [](double v, const TransferPoint& p) { return v < p.value; });
  if (above == points.begin()) return value_of(points.front());
  if (above == points.end()) return value_of(points.back());
  const TransferPoint& a = *(above - 1);
  const TransferPoint& b = *above;
  return glm::mix(value_of(a), value_of(b), (s - a.value) / (b.value - a.value));
}

double TransferFunction::max_extinction() const {
  double largest = 0;
  for (const TransferPoint& p : points) largest = std::max(largest, p.extinction);
  return largest;
}

}  // namespace volumark
