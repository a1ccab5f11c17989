// One segment of a ray: pre-integration, opacity correction, interpolation of associated colours.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "harness/verify/cases.h"
#include "harness/verify/test_scenes.h"
#include "methods/volume/volume_resources.h"

namespace volumark::hard_cases {
namespace {

constexpr int kTable = 64;

// Colour and opacity of the segment of length 1 that runs over the whole window: a table's last entry of its first row.
glm::dvec4 whole_segment(const std::vector<float>& table, int size, bool reversed) {
  const size_t at =
      reversed ? static_cast<size_t>(size - 1) : static_cast<size_t>(size - 1) * static_cast<size_t>(size);
  const float* texel = table.data() + 4 * at;
  const double mean = static_cast<double>(texel[3]);
  const double weight = mean > 0 ? -std::expm1(-mean) / mean : 1;
  glm::dvec4 out(0, 0, 0, mean * weight);
  for (int channel = 0; channel < 3; ++channel) out[channel] = static_cast<double>(texel[channel]) * weight;
  return out;
}

// Red where s = 0, green where s = 1, extinction from a to b.
TransferFunction red_to_green(double a, double b) { return transfer_of({{0, {1, 0, 0}, a}, {1, {0, 1, 0}, b}}); }

// Psi(a, b) = integral over 0..1 of exp(-a t - (b - a) t^2 / 2), by Simpson's rule on 2000 intervals (error below
// 1e-13 (a + b)^4).
double psi_of(double a, double b) {
  constexpr int kIntervals = 2000;
  double sum = 0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double t = static_cast<double>(i) / kIntervals;
    const double weight = i == 0 || i == kIntervals ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * std::exp(-a * t - (b - a) * t * t / 2);
  }
  return sum / (3 * kIntervals);
}

struct Segment {
  double a, b, psi;
};
constexpr Segment kPublished[] = {{0, 2, .746824132812}, {2, 0, .538079506913}, {1, 1, .632120558829}};

// The ends of extinction that are hard: nearly equal, tiny, huge, one of them zero.
constexpr double kEnds[][2] = {{.1, .1 + 1e-7}, {.1 + 1e-7, .1}, {1e-6, 2e-6}, {0, 1e-3}, {0, 0},
                               {30, 30.001},    {50, 0},         {0, 50},      {3, 7},    {7, 3}};

const char* const kTableSource = "entries are floats: 2^-24 of values up to the extinction, times the length";
double table_rounding(double a, double b) { return 4 * 0x1p-24 * (1 + std::max(a, b)); }

}  // namespace

void preintegration_table(CaseRun& run) {
  for (const Segment& s : kPublished) {
    const auto table = volumark::preintegration_table(red_to_green(s.a, s.b), kTable, 1);
    run.add({.check = fmt::format("Psi({:g}, {:g})", s.a, s.b),
             .expected = s.psi,
             .measured = 1 - whole_segment(table, kTable, false).r,
             .bound = table_rounding(s.a, s.b),
             .source = kTableSource});
  }
  for (const auto& [a, b] : kEnds) {
    const glm::dvec4 segment =
        whole_segment(volumark::preintegration_table(red_to_green(a, b), kTable, 1), kTable, false);
    const double zeta = std::exp(-(a + b) / 2), psi = psi_of(a, b), bound = table_rounding(a, b);
    const std::string ends = fmt::format("({:.9g}, {:.9g})", a, b);
    run.add({.check = "colour of the front end, 1 - Psi" + ends,
             .expected = 1 - psi,
             .measured = segment.r,
             .bound = bound,
             .source = kTableSource});
    run.add({.check = "colour of the back end, Psi - zeta" + ends,
             .expected = psi - zeta,
             .measured = segment.g,
             .bound = bound,
             .source = kTableSource});
    run.add({.check = "opacity, 1 - zeta" + ends,
             .expected = 1 - zeta,
             .measured = segment.a,
             .bound = bound,
             .source = kTableSource});
    // zeta <= Psi <= 1, as far as the entries' rounding lets it be told.
    const double below = std::max({0.0, zeta - (1 - segment.r), -segment.r});
    run.add({.check = "zeta <= Psi <= 1 at " + ends,
             .expected = 0,
             .measured = below,
             .bound = bound,
             .source = kTableSource});
  }
}

void linear_segment(CaseRun& run) {
  // A box one cell deep with values 0 in front and 1 behind, seen along -z: the step that is one cell makes one
  // segment.
  const View view = orthographic({0, 0, -1}, 1.4);
  for (const Segment& s : kPublished) {
    const Scene scene = scene_of(volume_of(RampField{2, 1, 0}, {3, 3, 2}), red_to_green(s.a, s.b));
    const Image image = run.draw(scene, run.stepped(1, {{"classification", "preintegrated"}}), view, 32, 32);
    const double zeta = std::exp(-(s.a + s.b) / 2);
    const glm::dvec4 expected(1 - s.psi, s.psi - zeta, 0, 1 - zeta);
    run.add_picture(
        fmt::format("one segment from extinction {:g} to {:g}", s.a, s.b), image,
        "ends of the segment to 2^-20 of the box, where light changes by at most 4 a unit; floats of the table",
        [&](int x, int y, int channel) {
          const bool hit = box_chord(pixel_ray(view, 32, 32, x, y), {1, 1, 0.5}).length() > 0;
          return hit ? within(expected[channel], 4 * 0x1p-20 + table_rounding(s.a, s.b)) : Allowed{};
        });
  }
}

void opacity_correction(CaseRun& run) {
  // Opacity .5 a voxel, in a box of one voxel: .5 for any step, and 1 - .5^.5 where the near plane leaves one half.
  const Scene scene = scene_of(volume_of(ConstantField{1}, {3, 3, 2}), homogeneous(std::log(2.0)));
  const auto check = [&](FrameSource& source, const std::string& name, double near, double expected, double blends) {
    View view = orthographic({0, 0, -1}, 1.4);
    view.near = near;
    source.frame(view);
    run.add_picture(name, source.read_back(), "n blends round once each: (n + 4) 2^-23", [&](int x, int y, int) {
      const bool hit = box_chord(pixel_ray(view, 32, 32, x, y), {1, 1, 0.5}).length() > 0;
      return hit ? within(expected, (blends + 4) * 0x1p-23) : Allowed{};
    });
  };
  for (const char* classification : {"post", "pre", "preintegrated"}) {
    if (!run.has("classification", classification)) continue;
    for (const double step : {2., 1., 0.25, 1. / 3}) {
      const auto source = run.prepare(scene, run.stepped(step, {{"classification", classification}}), 32, 32);
      check(*source, fmt::format("{}, opacity .5 a voxel in steps of {:.3g}", classification, step), 0, .5,
            std::ceil(1 / step) + 1);
      check(*source, fmt::format("{}, half a voxel in steps of {:.3g}: 1 - .5^.5", classification, step), 4,
            .2928932188134525, std::ceil(.5 / step) + 1);
    }
  }
  // The cube whose diagonal has optical depth 1.
  const Scene cube = homogeneous_cube(9, 1 / std::sqrt(3.0));
  const View diagonal = orthographic({-1, -1, -1}, 1.8);
  for (const double step : {1., 0.25}) {
    const Image image = run.draw(cube, run.stepped(step), diagonal, 33, 33);
    run.add({.check = fmt::format("diagonal of the cube, step {:g}", step),
             .expected = kSlabDepth,
             .measured = static_cast<double>(image.pixel(16, 16)[3]),
             .bound = (16 / step + 4) * 0x1p-23 + 4 * 0x1p-20,
             .source = "n blends round once each; the two corners to 2^-20 of the box"});
    // The same slices without the slant of the ray: each as opaque as a ray across it finds it, .43861609.
    if (!run.has("slant_correction", false)) continue;
    const Image uncorrected = run.draw(cube, run.stepped(step, {{"slant_correction", false}}), diagonal, 33, 33);
    run.add({.check = fmt::format("diagonal of the cube, step {:g}, slant not corrected", step),
             .expected = -std::expm1(-1 / std::sqrt(3.0)),
             .measured = static_cast<double>(uncorrected.pixel(16, 16)[3]),
             .bound = (16 / step + 4) * 0x1p-23 + 4 * 0x1p-20,
             .source = "n blends round once each; the two corners to 2^-20 of the box"});
  }
}

void associated_colours(CaseRun& run) {
  // Red of opacity 1 beside green of opacity 0, one voxel deep, seen in one step of one voxel: where a share f of the
  // way to green is gone, the associated colour is (1 - f) (1, 0, 0, 1), and nothing of green.
  Volume volume = volume_of(std::vector<float>{0, 1}, {2, 1, 1}, glm::dvec3(1));
  const Scene scene = scene_of(std::move(volume), red_to_green(1e6, 0));
  const View view = orthographic({0, 0, -1}, 0.5);
  constexpr int kSize = 17;  // the middle pixel lies half way
  const Image image = run.draw(scene, run.stepped(1, {{"classification", "pre"}}), view, kSize, kSize);
  run.add_picture("red of opacity 1 to green of opacity 0", image,
                  "the sample's place to 2^-20 of the box; weights of the filter and one opacity in floats: 2^-20",
                  [&](int x, int, int channel) {
                    const double red = 1 - (x + 0.5) / kSize;
                    return channel == 0 || channel == 3 ? within(red, 2 * 0x1p-20) : Allowed{};
                  });
  const auto middle = [&](int channel) { return static_cast<double>(image.pixel(8, 8)[channel]); };
  run.add({.check = "red half way", .expected = .5, .measured = middle(0), .bound = 2 * 0x1p-20, .source = "as above"});
  run.add(
      {.check = "opacity half way", .expected = .5, .measured = middle(3), .bound = 2 * 0x1p-20, .source = "as above"});
}

}  // namespace volumark::hard_cases
