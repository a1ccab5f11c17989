// Slices that lie in the data: where the stack switches, several slices on a polygon, lattices with thick slices.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "harness/verify/cases.h"
#include "harness/verify/test_scenes.h"
#include "methods/reference/reference.h"

namespace volumark::hard_cases {
namespace {

constexpr int kSize = 40;

double opacity(double depth) { return -std::expm1(-std::max(depth, 0.0)); }

// Root of the mean square over all channels of all pixels.
double rms(const Image& a, const Image& b) {
  double sum = 0;
  for (size_t i = 0; i < a.rgba.size(); ++i) {
    const double d = static_cast<double>(a.rgba[i]) - static_cast<double>(b.rgba[i]);
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(a.rgba.size()));
}

// ---- The switch ----

struct Tie {
  const char* name;
  View before, behind;  // of the plane at 45 degrees, 1e-6 to each side
};

std::vector<Tie> ties() {
  constexpr double kBeside = 1e-6;
  const auto far = [](double x) { return perspective(2.3 * glm::dvec3(1 + x, 0.3, 1), glm::dvec3(0)); };
  return {{"45 degrees between x and z, orthographic", orthographic({-1 - kBeside, -0.3, -1}, 1.6),
           orthographic({-1 + kBeside, -0.3, -1}, 1.6)},
          {"45 degrees between y and z, orthographic", orthographic({0.2, -1 - kBeside, -1}, 1.6),
           orthographic({0.2, -1 + kBeside, -1}, 1.6)},
          {"45 degrees between x and z, perspective", far(kBeside), far(-kBeside)}};
}

// ---- Lattices with thick slices ----

struct Lattice {
  glm::ivec3 size;
  glm::dvec3 spacing;
};
constexpr double kExtinction = 0.8;

// The stack of slices that lie closest together along the view: the thickest that a method on stacks may take.
double slab_along(const Lattice& lattice, const View& view, const Ray& ray) {
  const glm::dvec3 forward = glm::abs(frame_of(view).forward) / lattice.spacing;
  const int stack = forward.x > forward.y && forward.x > forward.z ? 0 : forward.y > forward.z ? 1 : 2;
  return lattice.spacing[stack] / std::max(std::abs(ray.direction[stack]), 1e-9);
}

// Data 0 to 1 along one axis, an extinction that is linear in them: the value at the middle of a chord is its mean.
// Slices that lie where the data do take the first and last stretch, of a length w of a slab d, up to (d - w) / 2 from
// its middle: off by w (d - w) / 2 <= d^2 / 8 of the slope each, and by no more than both stretches hold.
void check_lattice(CaseRun& run, const Lattice& lattice, int axis, double step) {
  const glm::dvec3 extent = glm::dvec3(glm::max(lattice.size - 1, glm::ivec3(1))) * lattice.spacing;
  const double length = std::max({extent.x, extent.y, extent.z});
  std::vector<float> values;
  const int last = std::max(lattice.size[axis] - 1, 1);
  for (int k = 0; k < lattice.size.z; ++k)
    for (int j = 0; j < lattice.size.y; ++j)
      for (int i = 0; i < lattice.size.x; ++i)
        values.push_back(static_cast<float>(glm::ivec3(i, j, k)[axis]) / static_cast<float>(last));
  const Scene scene = scene_of(volume_of(values, lattice.size, lattice.spacing),
                               transfer_of({{0, glm::dvec3(1), 0}, {1, glm::dvec3(1), kExtinction / length * 2}}));
  const double tau = kExtinction / length * 2, slope = tau / extent[axis];
  const auto source = run.prepare(scene, run.stepped(step), kSize, kSize);
  const double moved = place_error(kSize) * length / 2;
  for (const glm::dvec3& direction : {glm::dvec3(-0.9, -0.3, -0.2), {-0.3, -0.9, -0.4}, {-0.2, -0.3, -1}}) {
    const View view = orthographic(direction, 0.75 * length, 3 * length);
    source->frame(view);
    const std::string name = fmt::format(
        "{} x {} x {} samples of {:g} x {:g} x {:g}, linear along {}, seen along {}, step {:g}", lattice.size.x,
        lattice.size.y, lattice.size.z, lattice.spacing.x, lattice.spacing.y, lattice.spacing.z, "xyz"[axis],
        "xyz"[direction.x < -0.5   ? 0
              : direction.y < -0.5 ? 1
                                   : 2],
        step);
    run.add_picture(
        name, source->read_back(),
        "exact inside; in stacks the two ends of a chord: d^2 / 8 of the slope each; places; n blends round once each",
        [&](int x, int y, int) {
          const Ray ray = pixel_ray(view, kSize, kSize, x, y);
          const auto depth = [&](double grow) {
            const Chord chord = box_chord(ray, 0.5 * extent + grow);
            const double at = ray.origin[axis] + 0.5 * (chord.t0 + chord.t1) * ray.direction[axis];
            const double s = std::clamp(0.5 + at / extent[axis] + 2 * grow / extent[axis], 0., 1.);
            return chord.length() * tau * s;
          };
          const double exact = depth(0), grown = depth(moved);
          double slack = 0;
          if (!run.steps_exactly() && grown > 0) {
            const double slab = std::min(slab_along(lattice, view, ray) * step, glm::length(extent));
            slack = 2 * slab * slab / 8 * slope * std::abs(ray.direction[axis]);
          }
          const double rounding = (4 * 20 / step + 8) * 0x1p-23;
          return Allowed{opacity(exact), opacity(depth(-moved) - slack) - rounding, opacity(grown + slack) + rounding};
        });
  }
}

}  // namespace

void stack_switch(CaseRun& run) {
  const Scene scene = small_cloud();
  const auto coarse = run.prepare(scene, run.stepped(1), kSize, kSize);
  const auto fine = run.prepare(scene, run.stepped(0.25), kSize, kSize);
  const auto picture = [](FrameSource& source, const View& view) {
    source.frame(view);
    return source.read_back();
  };
  for (const Tie& tie : ties()) {
    const Image before = picture(*coarse, tie.before), behind = picture(*coarse, tie.behind);
    const Image exact = render_reference(scene, tie.before, kSize, kSize, {1e-6, 1}).image;
    const double error = std::hypot(rms(before, exact), rms(behind, exact));
    const double jump = rms(before, behind), fine_jump = rms(picture(*fine, tie.before), picture(*fine, tie.behind));
    // What two views that are 2e-6 apart may differ by in any method: the places of samples in a cloud of a slope of at
    // most 20 a box, of extinction 6, over the box.
    constexpr double kMoved = 1e-4;
    run.add({.check = fmt::format("{}: RMS of the jump", tie.name),
             .expected = 0,
             .measured = jump,
             .bound = error + kMoved,
             .source =
                 "the two pictures' own RMS errors, which have no reason to oppose each other: the root of the sum of "
                 "their squares"});
    run.add({.check = fmt::format("{}: RMS of the jump in steps of a quarter", tie.name),
             .expected = 0,
             .measured = fine_jump,
             .bound = jump / 8 + kMoved,
             .source = "order 2: a sixteenth, a factor 2 of room; and what the motion itself may change"});
  }
}

void polygon_textures(CaseRun& run) {
  const Scene scene = small_cloud();
  const Values single = run.stepped(0.4, {{"textures_per_polygon", std::string("1")}});
  struct Seen {
    const char* name;
    View view;
  };
  const Seen seen[] = {{"from outside", scene.views[0]},
                       {"from between its slices", perspective({1.5, 0.1, 0.4}, {0, 0, 0}, 1.2)},
                       {"from inside", perspective({0.31, -0.22, 0.47}, {-0.4, 0.2, -0.6}, 1.4)}};
  const auto one = run.prepare(scene, single, kSize, kSize);
  for (const char* textures : {"2", "4"}) {
    const auto several =
        run.prepare(scene, run.stepped(0.4, {{"textures_per_polygon", std::string(textures)}}), kSize, kSize);
    for (const Seen& from : seen) {
      one->frame(from.view);
      several->frame(from.view);
      constexpr int kSlices = 31 * 5 / 2 + 2;
      run.add_equal(fmt::format("{} slices on a polygon, {}", textures, from.name), several->read_back(),
                    one->read_back(), kSlices * 8 * 0x1p-25,
                    "a slice rounds 3 operations of values up to 1 where it is blended, 5 where it is combined and "
                    "blended: 2^-25 each");
    }
  }
}

void thick_slices(CaseRun& run) {
  // Voxels of 1 x 1 x 5 whichever axis is the thick one, and slices that are not square.
  const Lattice lattices[] = {{{21, 15, 4}, {0.1, 0.1, 0.5}},
                              {{21, 4, 15}, {0.1, 0.5, 0.1}},
                              {{4, 21, 15}, {0.5, 0.1, 0.1}},
                              {{5, 17, 9}, {0.3, 0.1, 0.2}}};
  for (const Lattice& lattice : lattices)
    for (int axis = 0; axis < 3; ++axis) check_lattice(run, lattice, axis, 0.5);
  // One sample along an axis: a layer of one spacing.
  for (int flat = 0; flat < 3; ++flat) {
    Lattice lattice{glm::ivec3(9), glm::dvec3(0.2, 0.25, 0.15)};
    lattice.size[flat] = 1;
    check_lattice(run, lattice, (flat + 1) % 3, 0.5);
  }
}

}  // namespace volumark::hard_cases
