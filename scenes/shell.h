// A volumetric texture on a triangle mesh (lensch2002, section 3): over each triangle stands a prism, spanned by the
// normals at its corners, and a 3D texture is mapped into it.
//
// The map of a prism: with barycentric coordinates b of the triangle and height w in [0, 1],
// X(b, w) = sum_i b_i (p_i + w d_i), d_i = unit normal_i * thickness_i, and the texture coordinates are the same sums
// of those at the six corners. A point of world space that lies in several prisms has the sum of their emissions and
// extinctions; one that lies in none is empty. A prism in which the Jacobian of X vanishes or changes its sign is left
// out by whoever draws the shell, and counted.
//
// Light: scenes/scene.h's Lighting, each prism by itself. The gradient g of the extinction in world space is that of
// the texture, carried over by the cotangents below: g = C(b, w) dextinction/d(u, v, w), C the same sums of those at
// the six corners. n = -g / max(|g|, floor), floor = gradient_floor(lighting, shell); the lit emission is
// emission (ambient + sum_i L_i diffuse max(0, n.l)) + extinction (specular term).
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <string>
#include <vector>

#include "scenes/mesh.h"

namespace volumark {

struct Lighting;  // scenes/scene.h

// RGBA texels: emission tau c (premultiplied) and extinction tau [1 / world unit], both interpolated trilinearly (so
// that colours of empty texels do not bleed). Texel (i, j, k) has its centre at ((i, j, k) + .5) / size; u and v
// repeat, w is clamped.
struct ShellTexture {
  glm::ivec3 size{0};
  std::vector<glm::vec4> texels;  // x fastest
  // (emission, extinction) at texture coordinates.
  glm::dvec4 at(const glm::dvec3& uvw) const;
  // d extinction / d (u, v, w): of the trilinear interpolation of central differences at the texels, as
  // scenes/scene.h's gradient. At the border of w the index is clamped, the difference still divided by 2 / size.z.
  glm::dvec3 gradient(const glm::dvec3& uvw) const;
  // The difference at one texel that `gradient` interpolates. Indices are wrapped (x, y) and clamped (z).
  glm::dvec3 texel_gradient(int i, int j, int k) const;
  const glm::vec4& texel(int i, int j, int k) const;
  float greatest_extinction() const;
};

struct Shell {
  std::shared_ptr<const Mesh> mesh;  // with normals: unit, one a position
  std::vector<double> thickness;     // one a position, world units, >= 0
  // Texture coordinates of the six corners of each prism: those of the triangle (w = 0), then those of the offset
  // triangle (w = 1), in the triangle's order.
  std::vector<std::array<glm::dvec3, 6>> texture;
  std::shared_ptr<const ShellTexture> colours;

  glm::dvec3 offset(uint32_t position) const;  // d_i
  // Corner 0..2 of the triangle, 3..5 of the offset triangle, world space.
  glm::dvec3 corner(size_t prism, int index) const;
  size_t prisms() const { return mesh->triangles.size(); }
};

// All corners of all prisms lie in it. At least one prism.
struct ShellBounds {
  glm::dvec3 lo, hi;
};
ShellBounds bounds_of(const Shell& shell);

// d(u, v, w)/dX at the six corners of each prism, transposed: columns are the gradients of u, v and w in world space
// [1 / world unit]; with it a gradient of the texture becomes one of world space. At a corner it is the inverse
// transpose of the Jacobian of X times that of the texture coordinates, averaged by area over the prisms that share the
// position, the layer and the texture coordinates (up to whole repeats of u and v): so that light does not show the
// triangles. Corners where the map is singular (thickness 0, a triangle without area) add nothing; where all are, it is
// 0, and only ambient light is left.
std::vector<std::array<glm::dmat3, 6>> cotangents(const Shell& shell);

// The floor of |g|: lighting.gradient_floor in greatest extinctions of the texture a texel of w where the shell is
// thickest.
double gradient_floor(const Lighting& lighting, const Shell& shell);

}  // namespace volumark
