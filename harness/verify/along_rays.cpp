// What adds up along a ray: the order of its segments, thin segments, where a ray may end early.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "harness/verify/cases.h"
#include "harness/verify/test_scenes.h"

namespace volumark::hard_cases {
namespace {

constexpr int kSize = 32;

// A square box of optical depth `depth` along z, `cells` of one world unit deep.
Scene deep_box(int cells, double depth) {
  Volume volume =
      volume_of(std::vector<float>(static_cast<size_t>(9 * (cells + 1)), 1.F), {3, 3, cells + 1}, glm::dvec3(1));
  return scene_of(std::move(volume), homogeneous(depth / cells));
}

double centre(const Image& image, int channel) {
  return static_cast<double>(image.pixel(image.width / 2, image.height / 2)[channel]);
}

const ParameterInfo* early_termination(const Method& method) {
  for (const ParameterInfo& info : method.info().parameters)
    if (info.aspect == "early termination") return &info;
  return nullptr;
}

}  // namespace

void segments_in_order(CaseRun& run) {
  // Red in front, green behind, extinction rising or falling: whatever number of pre-integrated segments cuts the ray,
  // and in whatever order they are drawn, they compose to the whole. Their ends lie on nodes of the table.
  constexpr double kEnds[][3] = {{0, 2, .746824132812}, {2, 0, .538079506913}};
  const auto check = [&](const double(&ends)[3], int n, const char* order) {
    const auto [a, b, psi] = ends;
    const Scene scene =
        scene_of(volume_of(RampField{2, 1, 0}, {3, 3, 2}), transfer_of({{0, {1, 0, 0}, a}, {1, {0, 1, 0}, b}}));
    const double zeta = std::exp(-(a + b) / 2), expected[] = {1 - psi, psi - zeta, 0, 1 - zeta};
    Settings settings = {{"classification", "preintegrated"}, {"preintegrated_size", 241}};
    if (*order != '\0') settings.emplace_back("order", order);
    const Image image =
        run.draw(scene, run.stepped(1. / n, std::move(settings)), orthographic({0, 0, -1}, 0.9), kSize, kSize);
    run.add_picture(
        fmt::format("extinction from {:g} to {:g} in {} segments{}{}", a, b, n, *order == 0 ? "" : ", ", order), image,
        "ends of each segment to 2^-20 of the box, where light changes by at most 4 a unit; floats of the "
        "table; n blends",
        [&](int, int, int channel) { return within(expected[channel], (4 + n) * 0x1p-20); });
  };
  for (const char* order : {"", "front_to_back"}) {  // "": as by default
    if (*order != '\0' && !run.has("order", order)) continue;
    for (const auto& ends : kEnds)
      for (const int n : {2, 3, 8}) check(ends, n, order);
  }
}

void thin_medium(CaseRun& run) {
  // So little light that the opacity of a segment must be right to its own digits, not to those of 1.
  const View view = orthographic({0, 0, -1}, 0.5, 60);
  bool classifies = false;
  for (const char* classification : {"post", "pre", "preintegrated"}) {
    if (!run.has("classification", classification)) continue;
    classifies = true;
    for (const auto& [depth, cells] : {std::pair(1e-2, 100), std::pair(1e-4, 10)}) {
      const Image image =
          run.draw(deep_box(cells, depth), run.stepped(1, {{"classification", classification}}), view, 1, 1);
      const char* const names[] = {"light", "opacity"};
      for (const int channel : {0, 3})
        run.add({.check = fmt::format("{}: {} of optical depth {:g} in {} segments, of the exact", classification,
                                      names[channel / 3], depth, cells),
                 .expected = 1,
                 .measured = centre(image, channel) / -std::expm1(-depth),
                 .bound = (cells + 32) * 0x1p-24,
                 .source = "n blends round once each, by 2^-24 of what is there; 2^-19 for the opacity of a segment"});
    }
  }
  if (!classifies) throw NotApplicable(run.method().info().name + " has no parameter classification");
}

void early_end(CaseRun& run) {
  const ParameterInfo* const info = early_termination(run.method());
  if (info == nullptr) throw NotApplicable(run.method().info().name + " follows every ray to its end");
  for (const double threshold : {0.25, 1. / 4096})
    for (const double depth : {1., 12.}) {
      const Image image = run.draw(deep_box(16, depth), run.stepped(0.5, {{info->name, threshold}}),
                                   orthographic({0, 0, -1}, 0.9, 60), 1, 1);
      const double left = std::exp(-depth), rounding = 40 * 0x1p-23;
      run.add({.check = fmt::format("optical depth {:g}, rays end below transmittance {:.3g}", depth, threshold),
               .expected = 1 - left,
               .measured = centre(image, 3),
               .bound = rounding + (left < threshold ? threshold : 0),
               .source = "a ray that lets more through is never cut; of any other at most the threshold is lost"});
    }
}

}  // namespace volumark::hard_cases
