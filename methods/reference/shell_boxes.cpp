#include "methods/reference/shell_boxes.h"

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>

namespace volumark {
namespace {

constexpr uint32_t kLeaf = 4;

// Slab test; a direction of 0 gives infinities, and a NaN (0 / 0) counts as a hit.
bool meets(const Box& box, const glm::dvec3& origin, const glm::dvec3& inverse, double t0, double t1) {
  for (int a = 0; a < 3; ++a) {
    const double low = (box.lo[a] - origin[a]) * inverse[a], high = (box.hi[a] - origin[a]) * inverse[a];
    t0 = std::max(t0, std::min(low, high));  // std::max keeps its first argument where the second is NaN
    t1 = std::min(t1, std::max(low, high));
  }
  return t0 <= t1;
}

}  // namespace

ShellBoxes::ShellBoxes(const std::vector<Box>& boxes) : order_(boxes.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  if (!boxes.empty()) build(boxes, 0, static_cast<uint32_t>(boxes.size()));
}

void ShellBoxes::build(const std::vector<Box>& boxes, uint32_t first, uint32_t count) {
  const size_t own = nodes_.size();
  Box box = boxes[order_[first]];
  for (uint32_t i = first; i < first + count; ++i) {
    box.lo = glm::min(box.lo, boxes[order_[i]].lo);
    box.hi = glm::max(box.hi, boxes[order_[i]].hi);
  }
  // Rounding in the slab test and along the ray: boxes a little larger than they are.
  const glm::dvec3 margin = 1e-9 * (box.hi - box.lo) + 1e-12 * (glm::abs(box.lo) + glm::abs(box.hi));
  nodes_.push_back({{box.lo - margin, box.hi + margin}, first, count});
  if (count <= kLeaf) return;
  const glm::dvec3 size = box.hi - box.lo;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto begin = order_.begin() + first;
  const uint32_t half = count / 2;
  std::nth_element(begin, begin + half, begin + count, [&](uint32_t a, uint32_t b) {
    return boxes[a].lo[axis] + boxes[a].hi[axis] < boxes[b].lo[axis] + boxes[b].hi[axis];
  });
  build(boxes, first, half);
  nodes_[own].first = static_cast<uint32_t>(nodes_.size());
  nodes_[own].count = 0;
  build(boxes, first + half, count - half);
}

std::vector<size_t> ShellBoxes::on_ray(const Ray& ray, double t0, double t1) const {
  std::vector<size_t> found;
  if (nodes_.empty()) return found;
  const glm::dvec3 inverse = 1.0 / ray.direction;
  std::vector<uint32_t> open{0};
  while (!open.empty()) {
    const uint32_t at = open.back();
    const Node& node = nodes_[at];
    open.pop_back();
    if (!meets(node.box, ray.origin, inverse, t0, t1)) continue;
    if (node.count == 0) {
      open.push_back(at + 1);
      open.push_back(node.first);
      continue;
    }
    for (uint32_t i = 0; i < node.count; ++i) found.push_back(order_[node.first + i]);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace volumark
