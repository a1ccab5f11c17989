#include "methods/reference/isosurface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

#include "methods/reference/field_chord.h"
#include "methods/reference/ray_span.h"

namespace volumark {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

const Isosurface& surface_of(const Scene& scene) {
  if (!scene.isosurface) throw std::invalid_argument("reference: the scene shows no isosurface");
  return *scene.isosurface;
}

}  // namespace

// What is known of one ray so far. Distances count from the entry into the volume.
struct SurfaceTracer::Search {
  GridRay grid;
  double position_error, t_base;
  double start_error;           // of the entry
  double exit, earliest_exit;   // a point between them may lie outside, one beyond `exit` is taken to
  const RayLights* lights;      // where lit
  bool certain = false;         // a point was met that is solid whatever rounding did
  bool decided_inside = false;  // ... and is inside the box for certain
  std::optional<glm::dvec3> colour;
  double distance = 0, spread = 0, error = 0;
  int64_t cells = 0, pieces = 0;
};

struct SurfaceTracer::CellChord {
  glm::ivec3 cell;
  glm::dvec3 start, change;  // cell coordinates
  double enter, length;
  Cubic value;
  double value_error;
};

SurfaceTracer::SurfaceTracer(const Scene& scene, bool find_empty_bricks)
    : scene_(scene), surface_(surface_of(scene)), lattice_(*scene.volume) {
  // The margin is far beyond what rounding can move a point of a ray into a neighbouring brick.
  if (find_empty_bricks)
    lattice_.mark_empty_bricks([this](double lo, double hi) {
      return hi + 1e-6 * (hi - lo) + 64 * kEpsilon * std::max(std::abs(lo), std::abs(hi)) < surface_.value;
    });
}

RayResult SurfaceTracer::trace(const Ray& ray) const {
  RayResult result;
  GridRay grid{lattice_.index_of_point(ray.origin), lattice_.index_of_vector(ray.direction)};
  const double error = position_error(lattice_, ray);
  const auto span = clip_ray(scene_, lattice_, ray, grid, error);
  if (!span) return result;
  grid.origin += span->t0 * grid.direction;
  std::optional<RayLights> lights;
  if (lit()) {
    const Lighting& lighting = *scene_.effects.lighting;
    lights.emplace(lighting, lattice_.volume(), ray, gradient_floor(lighting, scene_.transfer, lattice_.volume()));
  }
  Search search{};
  search.grid = grid;
  search.position_error = error;
  search.t_base = span->t0;
  search.start_error = span->error0;
  search.exit = span->t1 - span->t0;
  search.earliest_exit = span->earliest_exit - span->t0;
  search.lights = lights ? &*lights : nullptr;

  constexpr int unit = Lattice::kBrick;
  // A ray that only touches the box has no length: it is given that of its rounding.
  const double reach = std::max(span->latest_exit - span->t0, span->error0);
  walk_grid(grid, unit, glm::ivec3(0), lattice_.bricks() - 1, 0, reach,
            [&](const glm::ivec3& brick, double t0, double t1) {
              if (lattice_.brick_empty(brick)) return true;
              const glm::ivec3 first = brick * unit, last = glm::min(first + unit, lattice_.cells()) - 1;
              return walk_grid(grid, 1, first, last, t0, t1, [&](const glm::ivec3& cell, double enter, double leave) {
                return search_cell(cell, enter, leave, search);
              });
            });
  result.cells = search.cells;
  result.pieces = search.pieces;
  if (!search.colour) return result;
  result.bound = std::max(search.spread, search.error);
  if (!search.certain || !search.decided_inside) result.bound = std::max({result.bound, 1.0, largest(*search.colour)});
  if (search.distance > search.exit) return result;  // outside by less than rounding: nothing, as its bound says
  result.rgb = *search.colour;
  result.alpha = 1;
  result.distance = span->t0 + search.distance;
  return result;
}

// Whether all of the chord may be in a neighbouring cell.
bool SurfaceTracer::near_a_face(const CellChord& chord, double position_error) {
  const glm::dvec3 middle = chord.start + 0.5 * chord.change;
  for (int a = 0; a < 3; ++a)
    if (std::min(middle[a], 1 - middle[a]) < 4 * position_error) return true;
  return false;
}

// Returns whether to go on.
bool SurfaceTracer::search_cell(const glm::ivec3& cell, double enter, double leave, Search& search) const {
  ++search.cells;
  Lattice::Corners corner;
  lattice_.load(cell, corner);
  const auto [least, most] = std::minmax_element(corner.begin(), corner.end());
  const double lo = *least, hi = *most;
  CellChord chord{};
  chord.cell = cell;
  chord.enter = enter;
  chord.length = leave - enter;
  chord.start = search.grid.origin + enter * search.grid.direction - glm::dvec3(cell);
  chord.change = chord.length * search.grid.direction;
  // Rounding may have chosen the wrong one of two neighbouring cells, so that the error must hold in the steeper one.
  // Inside a cell of one value there is none: matter of exactly the surface's value is solid for certain.
  if (lo < hi || near_a_face(chord, search.position_error)) {
    const double range = lattice_.volume().max_value - lattice_.volume().min_value;
    chord.value_error = search.position_error * range + 8 * kEpsilon * std::max(std::abs(lo), std::abs(hi));
  }
  if (hi + chord.value_error < surface_.value) return true;
  if (!(lo < hi)) {
    chord.value = {lo, 0, 0, 0};
    return search_piece(chord, 0, 1, search);
  }
  chord.value = along_chord(corner, chord.start, chord.change);
  // The entry itself may be elsewhere by rounding.
  if (enter == 0) chord.value_error += std::abs(chord.value[1]) * std::min(1.0, search.start_error / chord.length);
  const double slope[3] = {chord.value[1], 2 * chord.value[2], 3 * chord.value[3]};
  const Roots turns = roots_between(slope, 0, 1);
  double u = 0;
  for (int i = 0; i <= turns.count; ++i) {
    const double next = i < turns.count ? turns.at[static_cast<size_t>(i)] : 1;
    if (!search_piece(chord, u, next, search)) return false;
    u = next;
  }
  return true;
}

// The field is monotone on [u0, u1]. Three values of it matter: from the least on the point may be solid, at the
// surface's own value it is taken to be, at the largest it is for certain. Returns whether to go on.
bool SurfaceTracer::search_piece(const CellChord& chord, double u0, double u1, Search& search) const {
  const double start = evaluate(chord.value, u0), end = evaluate(chord.value, u1);
  const double least = surface_.value - chord.value_error, most = surface_.value + chord.value_error;
  if (std::max(start, end) < least) return true;
  ++search.pieces;
  const double top = end >= start ? u1 : u0;
  auto reaching = [&](double value) {
    if (start >= value) return u0;
    return end >= value ? solve_monotone(chord.value, value, u0, u1) : top;
  };
  auto add = [&](double u) {
    double error = 0;
    const glm::dvec3 colour = colour_at(chord, u, search, error);
    search.error = std::max(search.error, error);
    if (!search.colour) {
      search.colour = colour;
      search.distance = chord.enter + u * chord.length;
    }
    search.spread = std::max(search.spread, 2 * largest(colour - *search.colour));
  };
  add(reaching(surface_.value));
  add(reaching(least));
  if (std::max(start, end) < most) return true;
  const double u = reaching(most);
  add(u);
  search.certain = true;
  // Earlier exits than this point's leave nothing to see, if nothing else was certain before.
  search.decided_inside = chord.enter + u * chord.length <= search.earliest_exit;
  return false;
}

glm::dvec3 SurfaceTracer::colour_at(const CellChord& chord, double u, const Search& search, double& error) const {
  error = 16 * kEpsilon * largest(surface_.colour);
  if (search.lights == nullptr) return surface_.colour;
  Lattice::CornerGradients corners;
  lattice_.load_gradients(chord.cell, corners);
  glm::dvec3 gradient;
  double gradient_error = 0;
  for (size_t a = 0; a < 3; ++a) {
    gradient[static_cast<int>(a)] = evaluate(along_chord(corners[a], chord.start, chord.change), u);
    const auto [lo, hi] = std::minmax_element(corners[a].begin(), corners[a].end());
    const double size = std::max(std::abs(*lo), std::abs(*hi));
    gradient_error += search.position_error * (*hi - *lo) + 8 * kEpsilon * size;
  }
  const double size = std::max(std::abs(lattice_.volume().min_value), std::abs(lattice_.volume().max_value));
  const glm::dvec3& spacing = lattice_.volume().spacing;
  gradient_error += 4 * kEpsilon * size / std::min({spacing.x, spacing.y, spacing.z});
  const double t = search.t_base + chord.enter + u * chord.length;
  error = search.lights->shading_error(gradient, t, gradient_error);
  const glm::dvec3 colour = search.lights->shade(gradient, t, surface_.colour, surface_.ambient_colour);
  error += 64 * kEpsilon * std::max(1.0, largest(colour));
  return colour;
}

}  // namespace volumark
