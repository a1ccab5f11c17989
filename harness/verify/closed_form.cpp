// Homogeneous slab, sphere, shell and cut cube: pictures whose every pixel has a closed form. What a pixel may differ
// by is an interval: the closed form of the shape moved by what rounding and sampling may move it.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "harness/verify/cases.h"
#include "harness/verify/test_scenes.h"

namespace volumark::hard_cases {
namespace {

double opacity(double depth) { return -std::expm1(-std::max(depth, 0.0)); }

// Each of n blends rounds a product and a sum, both by at most 2^-24 of values up to 1; opacity and length of the
// segments are off by a few times 2^-24 of themselves, over all of them as much as four blends.
double blend_rounding(double blends) { return (blends + 4) * 0x1p-23; }
const char* const kBlendSource = "n blends round a product and a sum each: (n + 4) 2^-23";

const glm::dvec3 kColour(1, 0.5, 0.25);

Allowed channel_of(const Allowed& alpha, int channel) {
  const double c = channel == 3 ? 1 : kColour[channel];
  return {alpha.value * c, alpha.lo * c, alpha.hi * c};
}

// ---- 1 ----
// A box of 2 x 2 x .5, seen along z: opacity where it is, nothing elsewhere.
void check_slab(CaseRun& run, const Scene& scene, const Values& values, const View& view, int slices, double expected,
                const std::string& name) {
  const Image image = run.draw(scene, values, view, 32, 32);
  const double bound = blend_rounding(slices);
  run.add_picture(name, image, kBlendSource, [&](int x, int y, int channel) {
    const Ray ray = pixel_ray(view, 32, 32, x, y);
    const bool hit = box_chord(ray, 0.5 * scene.volume->extent()).length() > 0;
    const Allowed alpha = hit ? within(expected, bound) : Allowed{};
    return channel_of(alpha, channel);
  });
}

constexpr int kSlices[] = {1, 2, 7, 64, 1000};

// ---- 2 and 3 ----
struct Shell {
  double inner, outer, extinction;
  // Optical depth at distance b from the centre.
  double depth(double b) const { return extinction * (chord(outer, b) - chord(inner, b)); }
  static double chord(double r, double b) { return b < r ? 2 * std::sqrt(r * r - b * b) : 0; }
};

// The values at which the transfer function jumps are smeared over one interval of the table, and trilinear
// interpolation puts a sphere at most h^2 / (4 r) inside; each stretch of the ray is sampled to within one step.
Allowed shell_opacity(const Shell& shell, double b, double moved, double step) {
  const auto depth = [&](double grow, double steps) {
    const double inner = shell.inner > 0 ? std::max(shell.inner - grow, 0.0) : 0;
    const Shell other{inner, shell.outer + grow, shell.extinction};
    const bool hit = Shell::chord(other.outer, b) > 0;
    const int stretches = shell.inner > 0 && b < shell.inner + std::abs(grow) ? 2 : 1;
    return other.depth(b) + (hit ? steps * stretches * step * shell.extinction : 0);
  };
  constexpr double kFloat = 2e-6;
  return {opacity(shell.depth(b)), opacity(depth(-moved, -1)) - kFloat, opacity(depth(moved, 1)) + kFloat};
}
const char* const kShellSource =
    "surfaces moved by one table interval and h^2 / (4 r), each stretch of the ray sampled to within one step";

double distance_from_centre(const View& view, int size, int x, int y) {
  const Ray ray = pixel_ray(view, size, size, x, y);
  return glm::length(ray.origin - glm::dot(ray.origin, ray.direction) * ray.direction);
}

void check_shell(CaseRun& run, const Shell& shell, const Scene& scene, const View& view, int size, double step,
                 Image& image, double& moved) {
  const double h = scene.volume->spacing.x, interval = (scene.transfer.hi - scene.transfer.lo) / 1020;
  moved = interval + h * h / (4 * (shell.outer - h)) + 1e-6;
  image = run.draw(scene, run.stepped(step), view, size, size);
  run.add_picture(fmt::format("opacity of every pixel, step {:g}", step), image, kShellSource,
                  [&](int x, int y, int channel) {
                    const double b = distance_from_centre(view, size, x, y);
                    return channel_of(shell_opacity(shell, b, moved, step * h), channel);
                  });
}

Scene shell_scene(const Shell& shell, int samples, double extent) {
  std::vector<TransferPoint> points;
  if (shell.inner > 0) points = {{shell.inner, kColour, 0}, {shell.inner, kColour, shell.extinction}};
  points.push_back({shell.outer, kColour, shell.extinction});
  points.push_back({shell.outer, kColour, 0});
  return scene_of(volume_of(DistanceField{}, glm::ivec3(samples), extent),
                  transfer_of(points, 0, extent * std::numbers::sqrt3 / 2));
}

}  // namespace

void slab(CaseRun& run) {
  const Scene scene = scene_of(volume_of(ConstantField{1}, {65, 65, 17}), homogeneous(2, kColour));
  const View view = orthographic({0, 0, -1}, 1.4);
  const double cells = 16;
  for (const int n : kSlices) {
    const std::string slices = fmt::format("{} slices", n);
    check_slab(run, scene, run.stepped(cells / n), view, n, opacity(1), slices);
    if (run.steps_exactly() && run.has("opacity_correction", "linear"))
      check_slab(run, scene, run.stepped(cells / n, {{"opacity_correction", "linear"}}), view, n,
                 1 - std::pow(1 - 1.0 / n, n), slices + ", linear opacity: 1 - (1 - 1/n)^n");
    if (run.has("classification", "preintegrated"))
      check_slab(run, scene, run.stepped(cells / n, {{"classification", "preintegrated"}}), view, n, opacity(1),
                 slices + ", pre-integrated");
  }
  const Scene cube = homogeneous_cube(8, 1);
  const auto source = run.prepare(cube, run.stepped(1), 32, 32);
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1., 1.}) {
      glm::dvec3 direction(0);
      direction[axis] = sign;
      const View side = orthographic(direction, 1.4);
      source->frame(side);
      const Image image = source->read_back();
      run.add_picture(fmt::format("cube of optical depth 1 along {}{}", sign < 0 ? '-' : '+', "xyz"[axis]), image,
                      kBlendSource, [&](int x, int y, int) {
                        const bool hit = box_chord(pixel_ray(side, 32, 32, x, y), glm::dvec3(1)).length() > 0;
                        return hit ? within(opacity(1), blend_rounding(7)) : Allowed{};
                      });
    }
}

void sphere(CaseRun& run) {
  const Shell shell{0, 0.8, 1.25};
  const Scene scene = shell_scene(shell, 96, 2);
  const View view = orthographic({0.4, -0.3, -1}, 1);
  constexpr int kSize = 96;
  for (const double step : {1., 0.25}) {
    Image image;
    double moved = 0;
    check_shell(run, shell, scene, view, kSize, step, image, moved);
    // The mean over the disc: each pixel's own interval, averaged, and the mean of the closed form over the pixels'
    // centres instead of the disc (computed).
    double sum = 0, closed = 0, lo = 0, hi = 0;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const Allowed pixel =
            shell_opacity(shell, distance_from_centre(view, kSize, x, y), moved, step * scene.volume->spacing.x);
        sum += static_cast<double>(image.pixel(x, y)[3]);
        closed += pixel.value;
        lo += pixel.lo;
        hi += pixel.hi;
      }
    const double disc = std::numbers::pi * 0.64 * kSize * kSize / 4, x2 = 2;
    const double transmitted = 2 * (1 - (1 + x2) * std::exp(-x2)) / (x2 * x2);
    run.add({.check = fmt::format("transmittance, mean over the disc, step {:g}", step),
             .expected = transmitted,
             .measured = 1 - sum / disc,
             .bound = std::max(hi - closed, closed - lo) / disc + std::abs(1 - closed / disc - transmitted),
             .source = "mean of the pixels' bounds, and the quadrature by pixels"});
  }
}

void grazing_shell(CaseRun& run) {
  const Shell shell{1, 1.1, 0.7};
  const Scene scene = shell_scene(shell, 97, 2.4);
  // An odd number of pixels of .04: (.28, .96) is the centre of one, at distance 1.
  const View view = orthographic({0, 0, -1}, 1.3);
  for (const double step : {1., 0.125}) {
    Image image;
    double moved = 0;
    check_shell(run, shell, scene, view, 65, step, image, moved);
    const Allowed allowed = shell_opacity(shell, 1, moved, step * scene.volume->spacing.x);
    const auto path = [&](double alpha) { return -std::log1p(-alpha) / shell.extinction; };
    run.add({.check = fmt::format("path that grazes the inner sphere, step {:g}", step),
             .expected = 2 * std::sqrt(1.1 * 1.1 - 1),
             .measured = path(static_cast<double>(image.pixel(32 + 7, 32 + 24)[3])),
             .bound = std::max(path(allowed.hi) - path(allowed.value), path(allowed.value) - path(allowed.lo)),
             .source = kShellSource});
  }
}

namespace {

// A homogeneous cube cut by planes: the chord's closed form. Where a ray grazes an edge its chord may be that of a box
// larger or smaller by place_error().
constexpr int kSize = 48;

void check_cut_cube(CaseRun& run, const std::string& name, const Scene& scene, FrameSource& source, const View& view,
                    double step, double slack) {
  source.frame(view);
  const Image image = source.read_back();
  const double tau = scene.transfer.points[0].extinction, moved = place_error(kSize);
  const auto chord = [&](const Ray& ray, double grow) {
    Chord out = box_chord(ray, glm::dvec3(1 + grow));
    for (ClipPlane plane : scene.effects.clip_planes) {
      plane.distance -= grow;
      out = cut_chord(out, ray, plane);
    }
    return out.length();
  };
  run.add_picture(name, image,
                  slack > 0 ? "half a step at each end of the ray, that whole slabs leave"
                            : "faces moved by pixels 2^-23 of the box; n blends round once each",
                  [&](int x, int y, int) {
                    const Ray ray = pixel_ray(view, kSize, kSize, x, y);
                    const double exact = chord(ray, 0), blends = exact / step + 2, rounding = blend_rounding(blends);
                    return Allowed{
                        opacity(tau * exact), opacity(tau * (chord(ray, -moved) - slack)) - rounding,
                        opacity(tau * (chord(ray, moved) + (exact > 0 || slack == 0 ? slack : 2 * slack))) + rounding};
                  });
}

}  // namespace

void clip_planes(CaseRun& run) {
  Scene scene = homogeneous_cube(9, 1.5);
  const View front = orthographic({0, 0, -1}, 1.4), slanted = perspective({2.1, 1.6, 2.9}, {0, 0, 0});
  const double step = 2. / 8;
  const auto check = [&](const std::string& name, const View& view, const Settings& settings = {}, double slack = 0) {
    const auto source = run.prepare(scene, run.stepped(1, settings), kSize, kSize);
    check_cut_cube(run, name, scene, *source, view, step, slack);
  };
  for (const double z0 : {0., 0.1, 0.37, 0.999, 1., 1.5}) {
    // Depth z0 of the two that the cube is deep, from the side of the eye.
    scene.effects.clip_planes = {{{0, 0, -1}, z0 - 1}};
    check(fmt::format("depth {:g} of 2 cut away", z0), front);
    if (run.has("end_slabs", "full"))
      check(fmt::format("depth {:g} of 2 cut away, whole slabs", z0), front, {{"end_slabs", "full"}}, step);
  }
  scene.effects.clip_planes = {{glm::normalize(glm::dvec3(1, 0.3, 0.2)), -0.3},
                               {glm::normalize(glm::dvec3(-0.2, 1, -0.5)), -0.4}};
  check("two slanted planes, perspective", slanted);
  scene.effects.clip_planes = {{{1, 0, 0}, 0.1}};
  check("a plane along the rays", front);
  scene.effects.clip_planes = {{{0, 1, 0}, 0}, {{0, -1, 0}, 0}};
  check("two planes that leave nothing", front);
  scene.effects.clip_planes = {};
  check("no plane", slanted);
}

void eye_and_ties(CaseRun& run) {
  const Scene scene = homogeneous_cube(9, 1.5);
  const double step = 2. / 8;
  const auto check_all = [&](const Settings& settings, const std::string& with) {
    const auto source = run.prepare(scene, run.stepped(1, settings), kSize, kSize);
    const auto check = [&](const std::string& name, const View& view) {
      check_cut_cube(run, name + with, scene, *source, view, step, 0);
    };
    // Slices lie at multiples of .25: the eye on one of them, and a view along it.
    check("the eye on a slice, looking along it", perspective({0.5, 0.1, 0.25}, {-0.5, 0.1, 0.25}));
    check("the eye on a slice, looking across it", perspective({0.1, 0.2, 0.25}, {0.1, 0.2, -1}));
    check("the eye inside, between slices", perspective({0.31, -0.52, 0.77}, {-0.4, 0.2, -0.6}, 1.4));
    check("the eye inside, most slices behind it", perspective({0.1, 0.05, 0.8}, {0.2, 0.1, 4}, 1.2));
    check("the eye at a corner", perspective({1, 1, 1}, {0, 0, 0}));
    check("45 degrees between two axes", orthographic({-1, 0, -1}, 1.8));
    check("45 degrees and a little", orthographic({-1, 0, -1 - 1e-6}, 1.8));
    check("45 degrees less a little", orthographic({-1, 0, -1 + 1e-6}, 1.8));
    check("the diagonal of three axes", orthographic({-1, -1, -1}, 1.9));
    check("perspective across the tie", perspective({2.2, 0, 2.2}, {0, 0, 0}));
    // Planes across the view that turn into those of the data: the strips between two slices become the whole picture.
    for (const double tilt : {1e-2, 1e-4, 1e-7, 1e-12})
      check(fmt::format("slices tilted by {:g} against the view", tilt), orthographic({0, tilt, -1}, 1.4));
    check("slices tilted by 1e-7 against the view, perspective", perspective({0.1, 0.2, 3}, {0.1, 0.2 + 3e-7, 0}));
  };
  check_all({}, "");
  for (const char* textures : {"2", "4"})
    if (run.has("textures_per_polygon", std::string(textures)))
      check_all({{"textures_per_polygon", std::string(textures)}}, fmt::format(", {} slices on a polygon", textures));
}

}  // namespace volumark::hard_cases
