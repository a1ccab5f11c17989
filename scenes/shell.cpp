#include "scenes/shell.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/scene.h"

namespace volumark {
namespace {

int wrapped(int i, int n) {
  const int rest = i % n;
  return rest < 0 ? rest + n : rest;
}

// The cell between texel centres in which uvw lies, and where in it.
struct TexelCell {
  glm::ivec3 base;
  glm::dvec3 fraction;
};

TexelCell cell_of(const glm::dvec3& uvw, const glm::ivec3& size) {
  // Whole repeats go first: a large u would overflow the index and cost the fraction its digits.
  const glm::dvec3 inside(uvw.x - std::floor(uvw.x), uvw.y - std::floor(uvw.y), std::clamp(uvw.z, 0.0, 1.0));
  const glm::dvec3 index = inside * glm::dvec3(size) - 0.5;
  const glm::dvec3 base = glm::floor(index);
  return {glm::ivec3(base), index - base};
}

template <typename T, typename Texel>
T interpolated(const TexelCell& cell, const Texel& texel) {
  T sum(0);
  for (int c = 0; c < 8; ++c) {
    const glm::ivec3 step(c & 1, (c >> 1) & 1, c >> 2);
    const glm::dvec3 weight = glm::mix(1.0 - cell.fraction, cell.fraction, glm::dvec3(step));
    const glm::ivec3 at = cell.base + step;
    sum += weight.x * weight.y * weight.z * T(texel(at.x, at.y, at.z));
  }
  return sum;
}

}  // namespace

const glm::vec4& ShellTexture::texel(int i, int j, int k) const {
  const auto x = static_cast<size_t>(wrapped(i, size.x)), y = static_cast<size_t>(wrapped(j, size.y));
  const auto z = static_cast<size_t>(std::clamp(k, 0, size.z - 1));
  return texels[(z * static_cast<size_t>(size.y) + y) * static_cast<size_t>(size.x) + x];
}

glm::dvec4 ShellTexture::at(const glm::dvec3& uvw) const {
  return interpolated<glm::dvec4>(cell_of(uvw, size), [&](int i, int j, int k) { return texel(i, j, k); });
}

glm::dvec3 ShellTexture::texel_gradient(int i, int j, int k) const {
  const auto tau = [&](int x, int y, int z) { return static_cast<double>(texel(x, y, z).a); };
  return 0.5 * glm::dvec3(size) *
         glm::dvec3(tau(i + 1, j, k) - tau(i - 1, j, k), tau(i, j + 1, k) - tau(i, j - 1, k),
                    tau(i, j, k + 1) - tau(i, j, k - 1));
}

glm::dvec3 ShellTexture::gradient(const glm::dvec3& uvw) const {
  // The neighbours of a texel below or above the border are those of the border texel.
  return interpolated<glm::dvec3>(
      cell_of(uvw, size), [&](int i, int j, int k) { return texel_gradient(i, j, std::clamp(k, 0, size.z - 1)); });
}

float ShellTexture::greatest_extinction() const {
  float greatest = 0;
  for (const glm::vec4& texel : texels) greatest = std::max(greatest, texel.a);
  return greatest;
}

glm::dvec3 Shell::offset(uint32_t position) const { return mesh->normals[position] * thickness[position]; }

glm::dvec3 Shell::corner(size_t prism, int index) const {
  const uint32_t position = mesh->triangles[prism][static_cast<size_t>(index % 3)];
  return index < 3 ? mesh->positions[position] : mesh->positions[position] + offset(position);
}

ShellBounds bounds_of(const Shell& shell) {
  ShellBounds bounds{shell.corner(0, 0), shell.corner(0, 0)};
  for (size_t prism = 0; prism < shell.prisms(); ++prism) {
    for (int i = 0; i < 6; ++i) {
      const glm::dvec3 corner = shell.corner(prism, i);
      bounds.lo = glm::min(bounds.lo, corner);
      bounds.hi = glm::max(bounds.hi, corner);
    }
  }
  return bounds;
}

double gradient_floor(const Lighting& lighting, const Shell& shell) {
  const double thickest = *std::max_element(shell.thickness.begin(), shell.thickness.end());
  const double greatest = static_cast<double>(shell.colours->greatest_extinction());
  // An empty texture, or a flat shell, has no gradient: any floor above 0 serves.
  if (!(thickest > 0) || !(greatest > 0)) return 1;
  return lighting.gradient_floor * greatest * shell.colours->size.z / thickest;
}

}  // namespace volumark
