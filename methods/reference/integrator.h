// Integrates rays through a scene: clips them, walks the cells and cuts each cell's chord where the transfer function
// bends. Const and safe to share between threads.
#pragma once

#include "methods/reference/accumulator.h"
#include "methods/reference/grid_walk.h"
#include "methods/reference/lattice.h"
#include "methods/reference/ray_result.h"
#include "methods/reference/transfer_pieces.h"
#include "scenes/scene.h"

namespace volumark {

class Integrator {
 public:
  // The scene must outlive the integrator and have its volume. Finding empty bricks pays for many rays.
  Integrator(const Scene& scene, bool find_empty_bricks);
  RayResult integrate(const Ray& ray, double tolerance) const;
  bool lit() const { return scene_.effects.lighting.has_value(); }

 private:
  void add_cell(const glm::ivec3& cell, const GridRay& grid, double position_error, double t0, double t1, double t_base,
                Accumulator& sum) const;
  void add_monotone(const Chord& chord, double u0, double u1, Accumulator& sum) const;
  void add_jump_errors(const Chord& chord, double u0, double u1, Accumulator& sum) const;

  const Scene& scene_;
  TransferPieces transfer_;
  Lattice lattice_;
  LightingBound lighting_;
  double max_radiance_;
};

}  // namespace volumark
