// A tree of boxes, for the prisms that a ray may meet.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scenes/scene.h"

namespace volumark {

struct Box {
  glm::dvec3 lo, hi;
};

class ShellBoxes {
 public:
  explicit ShellBoxes(const std::vector<Box>& boxes);
  // The indices of all boxes that the ray meets between t0 and t1, and perhaps of others near it; ascending.
  std::vector<size_t> on_ray(const Ray& ray, double t0, double t1) const;

 private:
  struct Node {
    Box box;
    uint32_t first = 0, count = 0;  // leaf: of order_; else first is the right child, the left one follows
  };
  void build(const std::vector<Box>& boxes, uint32_t first, uint32_t count);

  std::vector<Node> nodes_;
  std::vector<uint32_t> order_;
};

}  // namespace volumark
