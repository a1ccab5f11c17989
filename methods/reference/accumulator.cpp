#include "methods/reference/accumulator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace volumark {
namespace {

constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();
constexpr int kDeepestBisection = 14;

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

}  // namespace

// [u0, u1] of a chord as functions of v in [-1, 1].
struct Accumulator::Piece {
  double u_middle, u_half;
  Cubic value;        // data value
  double extinction;  // at the segment's origin, times dt / dv
  double slope;       // of extinction in the value, times dt / dv
  double origin;
  Quartic depth;     // optical depth from v = -1
  double end_depth;  // at v = 1

  Piece(const Chord& chord, double u0, double u1, const TransferSegment& segment)
      : u_middle(0.5 * (u0 + u1)), u_half(0.5 * (u1 - u0)), origin(segment.origin) {
    const double h = u_half, dt = chord.length * h;
    value = {evaluate(chord.value, u_middle), h * derivative(chord.value, u_middle),
             h * h * 0.5 * second_derivative(chord.value, u_middle), h * h * h * chord.value[3]};
    extinction = segment.extinction * dt;
    slope = segment.extinction_slope * dt;
    depth[1] = extinction + slope * (value[0] - origin);
    depth[2] = slope * value[1] / 2;
    depth[3] = slope * value[2] / 3;
    depth[4] = slope * value[3] / 4;
    depth[0] = depth[1] - depth[2] + depth[3] - depth[4];
    end_depth = std::max(2 * (depth[1] + depth[3]), 0.0);
  }
  double extinction_at(double s) const { return extinction + slope * (s - origin); }
};

void Accumulator::add(const Chord& chord, double u0, double u1, const TransferSegment& segment) {
  if (segment.empty || !(u1 > u0) || saturated()) return;
  const Piece piece(chord, u0, u1, segment);
  if (!(piece.end_depth > 0)) return;
  // The field's rounding, through extinction and colour; and that of the sums below.
  const double value_error = chord.value_error;
  const double error = limits_.max_radiance * (2 * std::abs(piece.slope) * value_error + kRounding) +
                       limits_.gain * std::min(piece.end_depth, 1.0) * segment.steepest_colour * value_error;
  if (lights_ == nullptr) {
    if (!add_unlit(piece, segment)) {  // too deep for one rule
      const double middle = piece.u_middle;
      add(chord, u0, middle, segment);
      add(chord, middle, u1, segment);
      return;
    }
  } else {
    splits_.clear();
    lights_->append_splits(*chord.gradient, chord.t0, chord.length, splits_);
    std::sort(splits_.begin(), splits_.end());
    double v = -1;
    for (double u : splits_) {
      const double split = (u - piece.u_middle) / piece.u_half;
      if (split <= v || split >= 1) continue;
      add_lit(chord, piece, segment, v, split, 0);
      v = split;
    }
    add_lit(chord, piece, segment, v, 1, 0);
  }
  bound_ += transmittance_ * error;
  depth_ += piece.end_depth;
  transmittance_ = std::exp(-depth_);
  ++pieces_;
}

// The integral of tau c e^-D dt over the piece by parts: c(start) - c(end) e^-D(end) + dc/ds * integral of s' e^-D, so
// one moment serves all channels and quadrature errs at most in proportion to the change of colour.
bool Accumulator::add_unlit(const Piece& piece, const TransferSegment& segment) {
  const double absorbed = -std::expm1(-piece.end_depth);
  if (segment.steepest_colour == 0) {
    rgb_ += (transmittance_ * absorbed) * segment.colour;
    return true;
  }
  const Quadratic slope{piece.value[1], 2 * piece.value[2], 3 * piece.value[3]};
  const int nodes = nodes_needed(slope, piece.depth, limits_.piece_error / (transmittance_ * segment.steepest_colour));
  if (nodes == 0 && piece.u_half > 1e-9) return false;
  const GaussRule& rule = gauss_rule(nodes == 0 ? kMaxNodes : nodes);
  double moment = 0;
  for (size_t i = 0; i < static_cast<size_t>(rule.count); ++i) {
    const double v = rule.node[i];
    moment += rule.weight[i] * ((slope[2] * v + slope[1]) * v + slope[0]) * std::exp(-evaluate(piece.depth, v));
  }
  const double start = evaluate(piece.value, -1.0) - segment.origin, end = evaluate(piece.value, 1.0) - segment.origin;
  // c(start) - c(end) e^-D = c(start) absorbed - (c(end) - c(start)) e^-D
  rgb_ += transmittance_ * (absorbed * (segment.colour + start * segment.colour_slope) +
                            (moment - (end - start) * (1 - absorbed)) * segment.colour_slope);
  bound_ += nodes == 0 ? transmittance_ * segment.steepest_colour * std::abs(end - start) : limits_.piece_error;
  return true;
}

// Nested rules of 3, 7 and 15 points; bisects where they do not agree. The error is an estimate: the difference of two
// rules is that of the coarser one, C rho^-n, and the finer one has twice its order: C rho^-2n, taken with C >= 1/100.
void Accumulator::add_lit(const Chord& chord, const Piece& piece, const TransferSegment& segment, double v0, double v1,
                          int level) {
  const double middle = 0.5 * (v0 + v1), half = 0.5 * (v1 - v0);
  glm::dvec3 sum3(0), sum7(0), sum15(0);
  auto estimate = [&](const glm::dvec3& coarse, const glm::dvec3& fine) {
    const double difference = largest(fine - coarse), scale = largest(fine);
    if (scale == 0) return difference;
    return std::min(difference, 100 * difference * difference / scale);
  };
  auto add_point = [&](const PattersonPoint& point) {
    const double v = middle + half * point.node, u = piece.u_middle + piece.u_half * v;
    const double s = evaluate(piece.value, v);
    const GradientChord& g = *chord.gradient;
    const glm::dvec3 gradient(evaluate(g[0], u), evaluate(g[1], u), evaluate(g[2], u));
    const glm::dvec3 colour = segment.colour + (s - segment.origin) * segment.colour_slope;
    const double weight =
        half * transmittance_ * std::max(piece.extinction_at(s), 0.0) * std::exp(-evaluate(piece.depth, v));
    const glm::dvec3 radiance = weight * lights_->shade(gradient, chord.t0 + u * chord.length, colour);
    sum3 += point.weight3 * radiance;
    sum7 += point.weight7 * radiance;
    sum15 += point.weight15 * radiance;
  };
  for (size_t i = 0; i < 7; ++i) add_point(kPatterson[i]);
  double error = estimate(sum3, sum7);
  if (error <= limits_.piece_error) {
    rgb_ += sum7;
    bound_ += error;
    return;
  }
  for (size_t i = 7; i < 15; ++i) add_point(kPatterson[i]);
  error = estimate(sum7, sum15);
  if (error > limits_.piece_error && level < kDeepestBisection) {
    add_lit(chord, piece, segment, v0, middle, level + 1);
    add_lit(chord, piece, segment, middle, v1, level + 1);
    return;
  }
  rgb_ += sum15;
  bound_ += error;
}

void Accumulator::add_jump_error(double length, const TransferJump& jump) {
  const double emission = limits_.gain * jump.emission + (limits_.offset + limits_.max_radiance) * jump.extinction;
  bound_ += transmittance_ * length * emission;
}

double Accumulator::alpha() const { return -std::expm1(-depth_); }

double Accumulator::bound() const {
  const double rest = saturated() ? transmittance_ * limits_.max_radiance : 0;
  return std::min(bound_ + rest + kRounding * limits_.max_radiance, limits_.max_radiance);
}

}  // namespace volumark
