// Surfaces given by a formula, seeded: the same specification gives the same mesh everywhere. All are grids of
// quadrilaterals, each split into two triangles, with unit normals of the smooth surface and (u, v) over [0, 1] across
// all of it; +y is up, and the normals of open surfaces point up.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <variant>

#include "scenes/mesh.h"

namespace volumark {

// A closed tube around the y axis: `segments` around the axis (u) and around the tube (v); radius of the middle line
// and of the tube. `distortion` (0: none) swings the middle line up and down, in and out, and the tube's radius; at .6
// and beyond the tube may meet itself. Positions on the seams are shared, their texture coordinates are not: a
// triangle at the end of u has u = 1. 24 x 12 segments are the 576 triangles and 288 positions of lensch2002, Table 1.
struct TorusMesh {
  glm::ivec2 segments{24, 12};  // each 3..4096
  double radius = 1, tube = 0.4;
  double distortion = 0.25;
};

// Hills over the square of `extent` around the y axis, up to about `height` above and below y = 0 (Perlin's noise,
// three octaves, the first of `frequency` waves along each side). 40 x 40 cells are the 3200 triangles of lensch2002,
// Table 1.
struct TerrainMesh {
  glm::ivec2 cells{40, 40};  // each 1..4096
  double extent = 2, height = 0.25, frequency = 2;
  uint32_t seed = 1;
};

// A rectangle of `extent` (along x: u; along z: v), bent around an axis parallel to z by `bend` radians in all, upwards
// in the middle (0: flat; less than 2 pi).
struct StripMesh {
  glm::ivec2 cells{8, 8};  // each 1..4096
  glm::dvec2 extent{2, 2};
  double bend = 0;
};

using MeshSpec = std::variant<TorusMesh, TerrainMesh, StripMesh>;

// Throws std::invalid_argument for segments or cells out of range.
Mesh make_mesh(const MeshSpec& spec);

}  // namespace volumark
