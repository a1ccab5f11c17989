// A volumetric texture on a triangle mesh (lensch2002, section 3): over each triangle stands a prism, spanned by the
// normals at its corners, and a 3D texture is mapped into it.
//
// The map of a prism: with barycentric coordinates b of the triangle and height w in [0, 1],
// X(b, w) = sum_i b_i (p_i + w d_i), d_i = unit normal_i * thickness_i, and the texture coordinates are the same sums
// of those at the six corners. A point of world space that lies in several prisms has the sum of their emissions and
// extinctions; one that lies in none is empty.
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

// RGBA texels: emission tau c (premultiplied) and extinction tau [1 / world unit], both interpolated trilinearly (so
// that colours of empty texels do not bleed). Texel (i, j, k) has its centre at ((i, j, k) + .5) / size; u and v
// repeat, w is clamped.
struct ShellTexture {
  glm::ivec3 size{0};
  std::vector<glm::vec4> texels;  // x fastest
  // (emission, extinction) at texture coordinates.
  glm::dvec4 at(const glm::dvec3& uvw) const;
  // d extinction / d (u, v, w): of the trilinear interpolation of central differences at the texels, as
  // scenes/scene.h's gradient.
  glm::dvec3 gradient(const glm::dvec3& uvw) const;
};

struct Shell {
  std::shared_ptr<const Mesh> mesh;  // with normals: unit, one a position
  std::vector<double> thickness;     // one a position, world units, >= 0
  // Texture coordinates of the six corners of each prism: those of the triangle (w = 0), then those of the offset
  // triangle (w = 1), in the triangle's order.
  std::vector<std::array<glm::dvec3, 6>> texture;
  std::shared_ptr<const ShellTexture> colours;

  glm::dvec3 offset(uint32_t position) const;  // d_i
  size_t prisms() const { return mesh->triangles.size(); }
};

}  // namespace volumark
