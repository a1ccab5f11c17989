#include "methods/shell_slices/plane_pairs.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace volumark {

void corner_depths(const ShellPrisms& shell, const ShellFrame& frame, CornerDepths& out) {
  const ShellUniforms& u = frame.uniforms;
  out.lower.clear();
  out.upper.clear();
  float largest = 0;
  for (size_t i = 0; i < shell.lower.size(); ++i) {
    out.lower.push_back(plane_depth(u, shell.lower[i]));
    out.upper.push_back(plane_depth(u, shell.upper[i]));
    largest = std::max({largest, glm::length(shell.lower[i]), glm::length(shell.upper[i])});
  }
  // Three products and three sums, each rounded once, of terms below this; twice that, and half of it to spare.
  const float terms = largest / static_cast<float>(frame.step) + std::abs(u.depth[3]);
  out.slack = 12 * std::numeric_limits<float>::epsilon() * terms;
}

void active_lists(const ShellPrisms& shell, const ShellFrame& frame, const CornerDepths& depths, ActiveLists& out) {
  const auto last_plane = static_cast<float>(frame.planes - 1);
  // First and last plane of a prism; the first above the last where there is none.
  const auto range = [&](const Prism& prism) {
    float nearest = std::numeric_limits<float>::infinity(), farthest = -nearest;
    for (const uint32_t position : prism.position) {
      const float a = depths.lower[position], b = depths.upper[position];
      nearest = std::min({nearest, a, b});
      farthest = std::max({farthest, a, b});
    }
    return std::pair(std::clamp(std::ceil(nearest - depths.slack), 0.F, last_plane + 1),
                     std::clamp(std::floor(farthest + depths.slack), -1.F, last_plane));
  };
  out.start.assign(static_cast<size_t>(frame.planes) + 1, 0);
  // Counting sort: how many prisms each plane has, from where ranges begin and end; then where each list starts.
  for (const Prism& prism : shell.prisms) {
    const auto [first, last] = range(prism);
    if (first > last) continue;
    ++out.start[static_cast<size_t>(first)];
    --out.start[static_cast<size_t>(last) + 1];  // wraps around, and back in the sum
  }
  uint32_t active = 0, sum = 0;
  for (uint32_t& start : out.start) {
    active += start;
    start = sum;
    sum += active;
  }
  out.prisms.resize(out.start.back());
  for (uint32_t i = 0; i < shell.prisms.size(); ++i) {
    const auto [first, last] = range(shell.prisms[i]);
    for (float plane = first; plane <= last; ++plane) out.prisms[out.start[static_cast<size_t>(plane)]++] = i;
  }
  // Every start has become the next one's.
  std::rotate(out.start.begin(), out.start.end() - 1, out.start.end());
  out.start.front() = 0;
}

void sphere_intervals(const ShellPrisms& shell, const ShellFrame& frame, const CornerDepths& depths,
                      std::vector<DepthInterval>& out) {
  out.clear();
  const auto slack = static_cast<double>(depths.slack);
  for (const Prism& prism : shell.prisms) {
    const double depth = (glm::dot(prism.middle, frame.forward) - frame.first) / frame.step;
    const double reach = prism.radius / frame.step + slack;
    out.push_back({static_cast<float>(depth - reach) - depths.slack, static_cast<float>(depth + reach) + depths.slack});
  }
}

}  // namespace volumark
