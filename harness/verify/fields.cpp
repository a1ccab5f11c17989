// Interpolated fields: what trilinear interpolation keeps exactly, and what it may be off by.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/verify/cases.h"
#include "harness/verify/test_scenes.h"
#include "methods/reference/reference.h"

namespace volumark::hard_cases {
namespace {

constexpr int kSize = 40;
constexpr double kExtinction = 0.8;  // at s = 1

double opacity(double depth) { return -std::expm1(-std::max(depth, 0.0)); }

// Extinction s kExtinction, white.
TransferFunction linear_transfer() { return transfer_of({{0, glm::dvec3(1), 0}, {1, glm::dvec3(1), kExtinction}}); }

const std::pair<const char*, View> kViews[] = {
    {"along an axis", orthographic({-1, 0, 0}, 1.4)},
    {"slanted", orthographic({-0.7, -0.4, -0.5}, 1.8)},
    {"perspective", perspective({2.4, 1.3, 2.6}, {0, 0, 0})},
};

// A method whose slices lie where the data do, not where the volume begins, takes the first and last stretch of length
// w of a slab d from a sample up to (d - w) / 2 away from their middle: off by w (d - w) / 2 <= d^2 / 8 of the slope
// each.
double end_slabs_slack(const CaseRun& run, const View& view, const Ray& ray, int axis, double step, double spacing) {
  if (run.steps_exactly()) return 0;
  const glm::dvec3 forward = glm::abs(frame_of(view).forward);
  const int stack = forward.x > forward.y && forward.x > forward.z ? 0 : forward.y > forward.z ? 1 : 2;
  const double along = spacing * step / std::abs(ray.direction[stack]);
  return 2 * along * along / 8 * kExtinction * 0.5 * std::abs(ray.direction[axis]);
}

// On a linear field the value at the middle of each segment is its mean: exact for any step.
void check_ramp(CaseRun& run, FrameSource& source, int axis, const char* name, const View& view, double step) {
  source.frame(view);
  const Image image = source.read_back();
  const double moved = place_error(kSize);
  run.add_picture(fmt::format("linear along {}, seen {}, step {:g}", "xyz"[axis], name, step), image,
                  "places through polygons of a pixel: pixels 2^-23 of the box; n blends round once each",
                  [&](int x, int y, int) {
                    const Ray ray = pixel_ray(view, kSize, kSize, x, y);
                    const auto depth = [&](double grow) {
                      const Chord chord = box_chord(ray, glm::dvec3(1 + grow));
                      const double middle = (chord.t0 + chord.t1) / 2;
                      const double s = 0.5 + 0.5 * (ray.origin[axis] + middle * ray.direction[axis]);
                      const double error = grow == 0 ? 0 : std::copysign(2 * moved, grow);
                      return chord.length() > 0 ? chord.length() * kExtinction * std::clamp(s + error, 0., 1.) : 0;
                    };
                    const double exact = depth(0), rounding = (14 / step + 6) * 0x1p-23;
                    const double slack = end_slabs_slack(run, view, ray, axis, step, 0.25);
                    return Allowed{opacity(exact), opacity(depth(-moved) - slack) - rounding,
                                   opacity(depth(moved) + (exact > 0 ? slack : 0)) + rounding};
                  });
}

// Radius at which the interpolated distance is `radius`, along a direction, from the reference's opacity.
double reference_radius(const Scene& scene, const glm::dvec3& direction, double extinction) {
  const RayIntegral ray = integrate_ray(scene, View{}, {glm::dvec3(0), direction, 0}, 1e-12);
  return -std::log1p(-ray.rgba[3]) / extinction;
}

}  // namespace

void plane_field(CaseRun& run) {
  for (const double step : {4., 0.7}) {
    for (int axis = 0; axis < 3; ++axis) {
      const Scene scene = scene_of(volume_of(RampField{axis, 0, 1}, glm::ivec3(9)), linear_transfer());
      const auto source = run.prepare(scene, run.stepped(step), kSize, kSize);
      for (const auto& [name, view] : kViews) check_ramp(run, *source, axis, name, view, step);
    }
  }
}

void sphere_field(CaseRun& run) {
  constexpr double kRadius = 0.8, kTau = 1;
  double last = 0;
  for (const int n : {17, 33, 65}) {
    const Scene scene = scene_of(volume_of(DistanceField{}, glm::ivec3(n)),
                                 transfer_of({{kRadius, glm::dvec3(1), kTau}, {kRadius, glm::dvec3(1), 0}}, 0, 2));
    const double h = 2.0 / (n - 1), bound = h * h / (4 * (kRadius - h));
    double outside = 0, inside = 0;
    for (int i = 0; i < 400; ++i) {  // a spiral over the sphere
      const double z = 1 - (2 * i + 1) / 400., azimuth = 2.399963229728653 * i, r = std::sqrt(1 - z * z);
      const double found = reference_radius(scene, {r * std::cos(azimuth), r * std::sin(azimuth), z}, kTau);
      outside = std::max(outside, found - kRadius);
      inside = std::max(inside, kRadius - found);
    }
    run.add({.check = fmt::format("{}^3: the surface lies inside of the sphere by", n),
             .expected = 0,
             .measured = inside,
             .bound = bound + 1e-7,
             .source = "trilinear interpolation of a convex distance: h^2 / (4 r), samples in floats"});
    run.add({.check = fmt::format("{}^3: and never outside of it", n),
             .expected = 0,
             .measured = outside,
             .bound = 1e-7,
             .source = "the interpolant of a convex function lies above it; samples in floats"});
    if (last > 0)
      run.add({.check = fmt::format("{}^3: order of that error", n),
               .expected = 2,
               .measured = std::log2(last / inside),
               .bound = 0.3,
               .source = "h^2; the largest of 400 directions instead of all"});
    last = inside;
  }
}

namespace {

constexpr MarschnerLobbField kWaves{6, 0.25};
constexpr int kWavePixels = 24;

struct WaveRay {
  double length, depth;  // of the chord, and the optical depth along it
};

// The field's own picture: 4000 midpoints a ray. The same for every method and backend, so made once.
const std::vector<WaveRay>& wave_rays(const View& view) {
  static const std::vector<WaveRay> rays = [&] {
    constexpr int kSamples = 4000;
    std::vector<WaveRay> out;
    for (int y = 0; y < kWavePixels; ++y)
      for (int x = 0; x < kWavePixels; ++x) {
        const Ray ray = pixel_ray(view, kWavePixels, kWavePixels, x, y);
        const Chord chord = box_chord(ray, glm::dvec3(1));
        double sum = 0;
        for (int i = 0; i < kSamples && chord.length() > 0; ++i)
          sum += volumark::marschner_lobb(
              kWaves, ray.origin + (chord.t0 + chord.length() * (i + 0.5) / kSamples) * ray.direction);
        out.push_back({chord.length(), kExtinction * chord.length() * sum / kSamples});
      }
    return out;
  }();
  return rays;
}

}  // namespace

void marschner_lobb(CaseRun& run) {
  // The lattice's picture against the field's own. A trilinear interpolant errs by at most h^2 / 8 (|f_xx| + |f_yy| +
  // |f_zz|); midpoints of segments of half a voxel see it to a quarter of that: h_s^2 / 24 of its second derivative in
  // a cell, and where cells meet a bend of at most h |f''|.
  const double wave = 2 * std::numbers::pi * kWaves.frequency * std::numbers::pi / 2;
  const double across = 0.1 * wave * wave * 1.1, along = 0.1 * std::numbers::pi * std::numbers::pi;
  static const View view = orthographic({-0.5, -0.35, -1}, 1.2);
  constexpr double kStep = 0.5;
  double last = 0;
  for (const int n : {41, 81, 161}) {
    const Scene scene = scene_of(volume_of(kWaves, glm::ivec3(n)), linear_transfer());
    const Image image = run.draw(scene, run.stepped(kStep), view, kWavePixels, kWavePixels);
    const double h = 2.0 / (n - 1);
    const double value_error = h * h / 8 * (2 * across + along) * (1 + kStep * kStep);
    double squares = 0;
    run.add_picture(
        fmt::format("{}^3 against the field itself", n), image,
        "h^2 / 8 (|f_xx| + |f_yy| + |f_zz|) along the whole chord", [&](int x, int y, int channel) {
          const WaveRay& ray = wave_rays(view)[static_cast<size_t>(y * kWavePixels + x)];
          const double slack = kExtinction * ray.length * value_error;
          const double off = static_cast<double>(image.pixel(x, y)[channel]) - opacity(ray.depth);
          squares += off * off;
          return Allowed{opacity(ray.depth), opacity(ray.depth - slack) - 1e-5, opacity(ray.depth + slack) + 1e-5};
        });
    const double rmse = std::sqrt(squares / (4. * kWavePixels * kWavePixels));
    if (n > 81)
      run.add({.check = fmt::format("order of the error from {}^3 to {}^3", n / 2 + 1, n),
               .expected = 2,
               .measured = std::log2(last / rmse),
               .bound = 0.5,
               .source = "h^2, 20 voxels a wave and more"});
    last = rmse;
  }
}

}  // namespace volumark::hard_cases
