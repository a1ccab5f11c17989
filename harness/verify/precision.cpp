// Few bits and many additions, and scenes of any size at any place.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "harness/verify/cases.h"
#include "harness/verify/test_scenes.h"

namespace volumark::hard_cases {
namespace {

double centre(const Image& image) { return static_cast<double>(image.pixel(image.width / 2, image.height / 2)[0]); }

// The level of 255 that `slices` layers over an optical depth end at, in a target of 8 bits a channel.
double level_of(CaseRun& run, int slices, double depth) {
  const Scene scene = scene_of(volume_of(ConstantField{1}, {33, 33, 33}), homogeneous(depth / 2));
  const Values values = run.stepped(32. / slices, {{"target_format", "rgba8"}});
  return 255 * centre(run.draw(scene, values, orthographic({0, 0, -1}, 1.4), 8, 8));
}

Scene transformed(const Scene& scene, double scale, const glm::dvec3& place) {
  Scene out = scene;
  Volume volume = *scene.volume;
  volume.spacing *= scale;
  volume.origin = volume.origin * scale + place;
  out.volume = std::make_shared<const Volume>(std::move(volume));
  for (TransferPoint& point : out.transfer.points) point.extinction /= scale;
  for (View& view : out.views) {
    view.eye = view.eye * scale + place;
    view.target = view.target * scale + place;
    view.near *= scale;
    view.half_height *= scale;
  }
  return out;
}

}  // namespace

namespace {

// How blenders of 8 bits form layer + (255 - layer) / 255 of what is there, rounded: from the quotient (as GPUs do, and
// then white of k / 255 stalls at ceil(255 - 127.5 / k)), or with shifts that lose up to a level (as Mesa does).
int blend_rounded(int layer, int there) { return layer + (2 * there * (255 - layer) + 255) / 510; }
int blend_shifted(int layer, int there) {
  const int product = there * (255 - layer);
  return layer + ((product + (product >> 8) + 128) >> 8);
}
int after(int layers, int layer, int (*blend)(int, int)) {
  int level = 0;
  for (int i = 0; i < layers; ++i) level = blend(layer, level);
  return level;
}

// `slices` layers of opacity a / 255 each, as the target stores it.
void check_level(CaseRun& run, const std::string& name, int slices, double depth) {
  const int layer = static_cast<int>(std::lround(-255 * std::expm1(-depth / slices)));
  const int rounded = after(slices, layer, blend_rounded), shifted = after(slices, layer, blend_shifted);
  const double measured = level_of(run, slices, depth);
  const bool shifts = std::abs(measured - shifted) < std::abs(measured - rounded);
  run.add({.check = name,
           .expected = static_cast<double>(shifts ? shifted : rounded),
           .measured = measured,
           .bound = 0.01,
           .source =
               fmt::format("the same additions in integers; quotients rounded give {}, shifts {}", rounded, shifted)});
}

}  // namespace

void eight_bit_accumulation(CaseRun& run) {
  if (run.steps_exactly()) {
    check_level(run, "slab of optical depth 1 in 256 slices, of 255 (exact: 161.19)", 256, 1);
    check_level(run, "slab of optical depth 1 in 512 slices, of 255 (exact: 161.19)", 512, 1);
  }
  constexpr int kLayers = 1024;
  for (const int k : {1, 2, 4, 8, 16})
    check_level(run, fmt::format("white of opacity {}/255 onto black stalls, of 255", k), kLayers,
                -kLayers * std::log1p(-k / 255.));
}

void eight_bit_target(CaseRun& run) {
  // Each of up to 16 slices rounds by half a level; a method that rounds once is well within.
  const Scene scene = small_cloud();
  const auto picture = [&](const char* format) {
    return run.draw(scene, run.stepped(4, {{"target_format", format}}), scene.views[0], 48, 48);
  };
  const Image full = picture("rgba32f");
  const double slices = std::ceil(std::sqrt(3.) * 31 / 4) + 1;
  if (run.has("target_format", "rgba16f"))
    run.add_equal("rgba16f against rgba32f", picture("rgba16f"), full, slices * 0x1p-11,
                  fmt::format("{} blends of at most 2^-11 each, where drivers truncate", slices));
  run.add_equal("rgba8 against rgba32f", picture("rgba8"), full, (slices + 1) * 0.5 / 255 * 2,
                fmt::format("{} blends, of which layer and sum round by half a level each", slices));
}

void many_segments(CaseRun& run) {
  // Opacity of a thin segment: 1 - exp(-x) taken as such loses all of it at x = 2^-25.
  const View view = orthographic({0, 0, -1}, 0.5);
  for (const double depth : {1e-2, 1e-4, 1e-6, 1e-8}) {
    const Scene scene = scene_of(volume_of(ConstantField{1}, {3, 3, 3}), homogeneous(depth / 2));
    run.add({.check = fmt::format("opacity of optical depth {:g} in two segments", depth),
             .expected = -std::expm1(-depth),
             .measured = centre(run.draw(scene, run.stepped(1), view, 1, 1)),
             .bound = -std::expm1(-depth) * 0x1p-20,
             .source = "2^-20 of itself: a few roundings"});
  }
  // One pixel and a box n steps deep. The error grows with n: the curve is in these rows.
  for (const double n : {1e3, 1e4, 1e5}) {
    const double cells = std::ceil(std::max(n / 63, 2.));
    const Scene scene = scene_of(volume_of(ConstantField{1}, {3, 3, static_cast<int>(cells) + 1}), homogeneous(0.5));
    try {
      const View across = orthographic({0, 0, -1}, 1 / cells);
      run.add({.check = fmt::format("optical depth 1 in {:g} segments", n),
               .expected = kSlabDepth,
               .measured = centre(run.draw(scene, run.stepped(cells / n), across, 1, 1)),
               .bound = n * 0x1p-25 + 0x1p-21,
               .source = "each blend rounds by up to 2^-25 of values below 1, all the same way at worst"});
    } catch (const NotApplicable& why) {
      run.not_applicable(fmt::format("optical depth 1 in {:g} segments", n), why.what());
    }
  }
}

void scale_and_place(CaseRun& run) {
  // What differs is float rounding that falls differently: a sample's place is good to 2^-20 of the box, the field
  // changes by at most 20 over the box and the extinction by 6 a unit of value, over a path of one unit.
  constexpr double kBound = 0x1p-20 * 20 * 6;
  const char* const source = "places to 2^-20 of the box, a field that changes by at most 20 over it, extinction 6";
  const Scene scene = small_cloud();
  const auto picture = [&](const Scene& other) { return run.draw(other, run.stepped(1), other.views[0], 48, 48); };
  const Image base = picture(scene);
  for (const double scale : {1e-6, 1e6})
    run.add_equal(fmt::format("scaled by {:g}", scale), picture(transformed(scene, scale, glm::dvec3(0))), base, kBound,
                  source);
  run.add_equal("moved by (1e6, -1e6, 1e6)", picture(transformed(scene, 1, {1e6, -1e6, 1e6})), base, kBound, source);
}

}  // namespace volumark::hard_cases
