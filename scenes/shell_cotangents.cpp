#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <tuple>

#include "scenes/shell.h"

namespace volumark {
namespace {

// Position, layer, texture coordinates: which corners share a cotangent.
using CornerKey = std::tuple<uint32_t, int, int64_t, int64_t, int64_t>;

CornerKey key_of(const Shell& shell, size_t prism, size_t corner) {
  constexpr double kSteps = 1 << 20;  // seams are computed: equal but for rounding
  const glm::dvec3 uvw = shell.texture[prism][corner];
  const auto repeating = [](double u) {
    return static_cast<int64_t>(std::round((u - std::floor(u)) * kSteps)) % static_cast<int64_t>(kSteps);
  };
  return {shell.mesh->triangles[prism][corner % 3], corner < 3 ? 0 : 1, repeating(uvw.x), repeating(uvw.y),
          static_cast<int64_t>(std::round(uvw.z * kSteps))};
}

// Columns: derivatives by b_1, b_2 and w at a corner of what has the values `at` at the six corners.
glm::dmat3 jacobian(const std::array<glm::dvec3, 6>& at, size_t corner) {
  const size_t layer = corner < 3 ? 0 : 3, side = corner % 3;
  return {at[layer + 1] - at[layer], at[layer + 2] - at[layer], at[side + 3] - at[side]};
}

// Of one prism at one corner; 0 where the map is singular, or so small that the answer is no number.
glm::dmat3 own_cotangent(const std::array<glm::dvec3, 6>& corners, const std::array<glm::dvec3, 6>& texture,
                         size_t corner) {
  constexpr double kFlat = 1e-12;  // sine of the angles below which a corner counts as singular
  const glm::dmat3 space = jacobian(corners, corner), change = jacobian(texture, corner);
  // Lengths and directions apart: the determinant of a small prism underflows long before the prism is flat.
  glm::dmat3 directions, rate;
  for (int i = 0; i < 3; ++i) {
    const double length = glm::length(space[i]);
    if (!(length > 0)) return glm::dmat3(0);
    directions[i] = space[i] / length;
    rate[i] = change[i] / length;
  }
  if (!(std::abs(glm::determinant(directions)) > kFlat)) return glm::dmat3(0);
  const glm::dmat3 out = glm::transpose(rate * glm::inverse(directions));
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (!std::isfinite(out[i][j])) return glm::dmat3(0);
    }
  }
  return out;
}

}  // namespace

std::vector<std::array<glm::dmat3, 6>> cotangents(const Shell& shell) {
  struct Sum {
    glm::dmat3 weighted{0};
    double weight = 0;
  };
  std::map<CornerKey, Sum> shared;
  for (size_t prism = 0; prism < shell.prisms(); ++prism) {
    std::array<glm::dvec3, 6> corners;
    for (int i = 0; i < 6; ++i) corners[static_cast<size_t>(i)] = shell.corner(prism, i);
    for (size_t i = 0; i < 6; ++i) {
      // Of the corner's own layer: the offset triangle may have an area where the mesh's has none.
      const size_t layer = i < 3 ? 0 : 3;
      const double area =
          glm::length(glm::cross(corners[layer + 1] - corners[layer], corners[layer + 2] - corners[layer]));
      const glm::dmat3 own = own_cotangent(corners, shell.texture[prism], i);
      if (own == glm::dmat3(0) || !(area > 0)) continue;
      Sum& sum = shared[key_of(shell, prism, i)];
      sum.weighted += area * own;
      sum.weight += area;
    }
  }
  std::vector<std::array<glm::dmat3, 6>> out(shell.prisms());
  for (size_t prism = 0; prism < shell.prisms(); ++prism) {
    for (size_t i = 0; i < 6; ++i) {
      const auto it = shared.find(key_of(shell, prism, i));
      out[prism][i] = it == shared.end() ? glm::dmat3(0) : it->second.weighted / it->second.weight;
    }
  }
  return out;
}

}  // namespace volumark
