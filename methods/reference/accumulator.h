// What a ray has gathered so far, front to back, and how wrong that may be. Pieces of the ray are added in order; on
// each the field is a cubic and extinction and colour are affine in it.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "methods/reference/lighting.h"
#include "methods/reference/polynomial.h"
#include "methods/reference/quadrature.h"
#include "methods/reference/transfer_pieces.h"

namespace volumark {

// The part of a ray inside one cell; u runs from 0 to 1 along it.
struct Chord {
  Cubic value{};                            // data value
  double t0 = 0;                            // distance of u = 0 along the ray
  double length = 0;                        // world units
  double value_error = 0;                   // rounding of the field's value
  const GradientChord* gradient = nullptr;  // where lit
};

struct AccumulatorLimits {
  double piece_error = 0;       // allowed error of one piece's quadrature, each channel
  double negligible = 0;        // stop where all that can still come is below this
  double max_radiance = 1;      // at least 1: what a channel can be at most
  double gain = 1, offset = 0;  // of lit colours, see LightingBound
};

class Accumulator {
 public:
  Accumulator(const AccumulatorLimits& limits, const RayLights* lights) : limits_(limits), lights_(lights) {}

  // Adds [u0, u1] of a chord, all in one segment of the transfer function.
  void add(const Chord& chord, double u0, double u1, const TransferSegment& segment);
  // Adds only uncertainty: part of the ray, of this length, may lie on either side of a jump.
  void add_jump_error(double length, const TransferJump& jump);
  void add_error(double error) { bound_ += error; }

  bool saturated() const { return transmittance_ * limits_.max_radiance <= limits_.negligible; }
  double transmittance() const { return transmittance_; }
  double alpha() const;
  const glm::dvec3& rgb() const { return rgb_; }
  // Of each channel, all that may still come after saturation included.
  double bound() const;
  int64_t pieces() const { return pieces_; }

 private:
  struct Piece;
  bool add_unlit(const Piece& piece, const TransferSegment& segment);
  void add_lit(const Chord& chord, const Piece& piece, const TransferSegment& segment, double v0, double v1, int level);

  AccumulatorLimits limits_;
  const RayLights* lights_;
  glm::dvec3 rgb_{0};
  double depth_ = 0, transmittance_ = 1, bound_ = 0;
  int64_t pieces_ = 0;
  std::vector<double> splits_;
};

}  // namespace volumark
