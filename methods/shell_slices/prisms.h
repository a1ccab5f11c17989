// The prisms of a shell as its methods draw them (lensch2002, section 3). World coordinates are taken relative to the
// shell's middle in double precision and only then rounded to float; a corner that prisms share is one corner here, the
// same bits for all of them. Only prisms without a fault (scenes/prism_faults.h) are in the list.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scenes/shell.h"

namespace volumark {

struct Prism {
  std::array<uint32_t, 3> position;  // of its corners, in the lists below
  uint32_t triangle;                 // of the mesh
  std::array<glm::vec3, 6> texture;  // texture coordinates of its six corners
  glm::dvec3 middle;                 // bounding sphere of the six corners
  double radius;
};

struct ShellPrisms {
  glm::dvec3 middle{0};                 // world; the origin of what follows
  std::vector<glm::vec3> lower, upper;  // by position of the mesh, relative to `middle`
  std::vector<Prism> prisms;
  double radius = 1;  // > 0: no corner is farther from the middle
  // Of each prism at its corners, as scenes/shell.h defines them, times the radius; empty unless asked for.
  std::vector<std::array<glm::mat3, 6>> cotangents;
  // Left out: without volume, or not to be told from it (degenerate); self-intersecting (the Jacobian changes its
  // sign).
  int64_t degenerate = 0, self_intersecting = 0;

  const glm::vec3& corner(const Prism& prism, int index) const {
    const uint32_t position = prism.position[static_cast<size_t>(index % 3)];
    return index < 3 ? lower[position] : upper[position];
  }
};
// `lit`: with cotangents.
ShellPrisms shell_prisms(const Shell& shell, bool lit = false);

// An edge of a prism with all that a vertex program needs to meet it with a plane: a fake vertex of lensch2002, section
// 5. Ends in the order of the positions (lower before upper on a normal edge), whoever asks.
struct FakeVertex {
  glm::vec3 a, b;                  // relative to the shell's middle
  glm::vec3 texture_a, texture_b;  // texture coordinates
};
static_assert(sizeof(FakeVertex) == 48);

struct EdgeTable {
  std::vector<FakeVertex> edges;
  std::vector<std::array<uint32_t, 9>> of_prism;  // in the numbering of section.h
  // Cotangents of the two ends of each edge, where the shell has them: with the texture coordinates they are shared
  // too.
  std::vector<std::array<glm::mat3, 2>> cotangents;
};
// `share`: prisms that meet at an edge with the same texture coordinates use one entry; otherwise each has nine.
EdgeTable edge_table(const ShellPrisms& shell, bool share);

}  // namespace volumark
