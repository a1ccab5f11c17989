// The first point of a ray on or in a scene's isosurface (scenes/scene.h), exact up to rounding. In each cell the field
// along the ray is a cubic; it is cut at its turning points and followed from cell to cell as one function, so that no
// ray slips through at an edge or a vertex of the grid. Const and safe to share between threads.
#pragma once

#include "methods/reference/grid_walk.h"
#include "methods/reference/lattice.h"
#include "methods/reference/lighting.h"
#include "methods/reference/ray_result.h"
#include "scenes/scene.h"

namespace volumark {

class SurfaceTracer {
 public:
  // The scene must outlive the tracer, show an isosurface and have its volume. Finding empty bricks pays for many rays.
  SurfaceTracer(const Scene& scene, bool find_empty_bricks);
  // The bound covers every point that may be the first within rounding; where that may also be none, it covers alpha.
  // A field that only touches the value within rounding counts as reaching it. Lit colours between such points are
  // taken to lie between theirs: the bound is then an estimate.
  RayResult trace(const Ray& ray) const;
  bool lit() const { return scene_.effects.lighting.has_value(); }

 private:
  struct Search;
  struct CellChord;
  static bool near_a_face(const CellChord& chord, double position_error);
  bool search_cell(const glm::ivec3& cell, double enter, double leave, Search& search) const;
  bool search_piece(const CellChord& chord, double u0, double u1, Search& search) const;
  glm::dvec3 colour_at(const CellChord& chord, double u, const Search& search, double& error) const;

  const Scene& scene_;
  const Isosurface& surface_;
  Lattice lattice_;
};

}  // namespace volumark
