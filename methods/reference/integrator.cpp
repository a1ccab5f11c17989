#include "methods/reference/integrator.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "methods/reference/field_chord.h"
#include "methods/reference/ray_span.h"

namespace volumark {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

}  // namespace

Integrator::Integrator(const Scene& scene, bool find_empty_bricks)
    : scene_(scene), transfer_(scene.transfer), lattice_(*scene.volume) {
  if (find_empty_bricks)
    lattice_.mark_empty_bricks([this](double lo, double hi) { return transfer_.empty_range(lo, hi); });
  if (scene.effects.lighting) lighting_ = lighting_bound(*scene.effects.lighting);
  max_radiance_ = std::max(1.0, lighting_.gain * transfer_.max_colour() + lighting_.offset);
}

RayResult Integrator::integrate(const Ray& ray, double tolerance) const {
  GridRay grid{lattice_.index_of_point(ray.origin), lattice_.index_of_vector(ray.direction)};
  const double error = position_error(lattice_, ray);
  RayResult result;
  const auto span = clip_ray(scene_, lattice_, ray, grid, error);
  if (!span) return result;

  // Distances count from the entry, so that they do not lose digits to a distant eye.
  const double t_base = span->t0, reach = std::max(span->t1 - span->t0, 0.0);
  grid.origin += t_base * grid.direction;
  const double crossings = std::abs(grid.direction.x) + std::abs(grid.direction.y) + std::abs(grid.direction.z);
  AccumulatorLimits limits;
  limits.piece_error = tolerance / (4 * (crossings * reach + 3));
  limits.negligible = tolerance / 4;
  limits.max_radiance = max_radiance_;
  limits.gain = lighting_.gain;
  limits.offset = lighting_.offset;
  std::optional<RayLights> lights;
  if (lit()) {
    const Lighting& lighting = *scene_.effects.lighting;
    lights.emplace(lighting, lattice_.volume(), ray, gradient_floor(lighting, scene_.transfer, lattice_.volume()));
  }
  Accumulator sum(limits, lights ? &*lights : nullptr);

  sum.add_error(std::min(1.0, span->error0 * transfer_.max_extinction()) * max_radiance_);
  constexpr int unit = Lattice::kBrick;
  walk_grid(grid, unit, glm::ivec3(0), lattice_.bricks() - 1, 0, reach,
            [&](const glm::ivec3& brick, double t0, double t1) {
              if (lattice_.brick_empty(brick)) return true;
              const glm::ivec3 first = brick * unit, last = glm::min(first + unit, lattice_.cells()) - 1;
              return walk_grid(grid, 1, first, last, t0, t1, [&](const glm::ivec3& cell, double enter, double leave) {
                ++result.cells;
                add_cell(cell, grid, error, enter, leave, t_base, sum);
                return !sum.saturated();
              });
            });
  // The exit may lie this much further in, where less was absorbed: never more than exp of the depth between.
  const double end_depth = span->error1 * transfer_.max_extinction();
  const double reaching = std::min(1.0, sum.transmittance() * std::exp(std::min(end_depth, 700.0)));
  sum.add_error(reaching * std::min(1.0, end_depth) * max_radiance_);
  result.rgb = sum.rgb();
  result.alpha = sum.alpha();
  result.bound = sum.bound();
  result.pieces = sum.pieces();
  return result;
}

void Integrator::add_cell(const glm::ivec3& cell, const GridRay& grid, double position_error, double t0, double t1,
                          double t_base, Accumulator& sum) const {
  Lattice::Corners corner;
  lattice_.load(cell, corner);
  const auto [least, most] = std::minmax_element(corner.begin(), corner.end());
  const double lo = *least, hi = *most;
  // At a jump, samples equal to its value lie above it.
  const bool touches_above = transfer_.has_jumps() || !(lo < hi);
  const int first = transfer_.segment_above(lo),
            last = touches_above ? transfer_.segment_above(hi) : transfer_.segment_below(hi);
  if (transfer_.empty(first, last)) return;

  const glm::dvec3 start = grid.origin + t0 * grid.direction - glm::dvec3(cell), change = (t1 - t0) * grid.direction;
  Chord chord;
  chord.t0 = t_base + t0;
  chord.length = t1 - t0;
  GradientChord gradient;
  if (lit()) {
    Lattice::CornerGradients corners;
    lattice_.load_gradients(cell, corners);
    for (size_t a = 0; a < 3; ++a) gradient[a] = along_chord(corners[a], start, change);
    chord.gradient = &gradient;
  }
  if (!(lo < hi)) {
    chord.value = {lo, 0, 0, 0};
    sum.add(chord, 0, 1, transfer_.segment(first));
    return;
  }
  chord.value = along_chord(corner, start, change);
  chord.value_error = position_error * (hi - lo) + 8 * kEpsilon * std::max(std::abs(lo), std::abs(hi));
  if (first == last && !transfer_.has_jumps()) {
    sum.add(chord, 0, 1, transfer_.segment(first));
    return;
  }
  const double slope[3] = {chord.value[1], 2 * chord.value[2], 3 * chord.value[3]};
  const Roots turns = roots_between(slope, 0, 1);
  double u = 0;
  for (int i = 0; i <= turns.count; ++i) {
    const double next = i < turns.count ? turns.at[static_cast<size_t>(i)] : 1;
    if (transfer_.has_jumps()) add_jump_errors(chord, u, next, sum);
    add_monotone(chord, u, next, sum);
    u = next;
  }
}

void Integrator::add_monotone(const Chord& chord, double u0, double u1, Accumulator& sum) const {
  const double start = evaluate(chord.value, u0), end = evaluate(chord.value, u1);
  double u = u0;
  auto add_up_to = [&](double next, int segment) {
    sum.add(chord, u, next, transfer_.segment(segment));
    u = next;
  };
  int segment;
  if (end < start) {
    segment = transfer_.segment_below(start);
    for (; segment > 0 && transfer_.value(segment - 1) > end; --segment)
      add_up_to(solve_monotone(chord.value, transfer_.value(segment - 1), u, u1), segment);
  } else {
    segment = transfer_.segment_above(start);
    for (; segment < transfer_.value_count() && transfer_.value(segment) < end; ++segment)
      add_up_to(solve_monotone(chord.value, transfer_.value(segment), u, u1), segment);
  }
  add_up_to(u1, segment);
}

// Where the field comes within its rounding of a jump's value, that part of the ray may lie on either side: near u it
// is about min(e / |s'|, sqrt(e / |s''|)) long.
void Integrator::add_jump_errors(const Chord& chord, double u0, double u1, Accumulator& sum) const {
  const double start = evaluate(chord.value, u0), end = evaluate(chord.value, u1), e = chord.value_error;
  const double lo = std::min(start, end), hi = std::max(start, end);
  for (int i = transfer_.segment_below(lo - e); i < transfer_.value_count() && transfer_.value(i) <= hi + e; ++i) {
    const TransferJump& jump = transfer_.jump(i);
    if (jump.extinction == 0 && jump.emission == 0) continue;
    const double value = transfer_.value(i);
    const double u = value <= lo   ? (start < end ? u0 : u1)
                     : value >= hi ? (start < end ? u1 : u0)
                                   : solve_monotone(chord.value, value, u0, u1);
    const double width =
        std::min({e / std::abs(derivative(chord.value, u)), std::sqrt(e / std::abs(second_derivative(chord.value, u))),
                  std::cbrt(e / std::abs(6 * chord.value[3]))});
    sum.add_jump_error(chord.length * std::min(8 * width, u1 - u0), jump);
  }
}

}  // namespace volumark
