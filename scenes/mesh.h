// A triangle mesh as files give it. Nothing is repaired here: what a mesh may lack or get wrong is for its user to
// refuse or to allow (scenes/shell.h says what a shell does with it).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace volumark {

struct Mesh {
  std::vector<glm::dvec3> positions;  // world units
  std::vector<glm::dvec3> normals;    // one a position, of any length; empty: the source has none
  // (u, v) of the three corners of each triangle; empty: the source has none. By corner, since neighbours may disagree
  // along a seam.
  std::vector<std::array<glm::dvec2, 3>> texture;
  std::vector<std::array<uint32_t, 3>> triangles;  // counter-clockwise seen from outside
};

}  // namespace volumark
