// What adds up along a ray: the order of its segments, thin segments, where a ray may end early; and light on the way.
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
  // they compose to the whole. Their ends lie on nodes of the table.
  constexpr double kEnds[][3] = {{0, 2, .746824132812}, {2, 0, .538079506913}};
  for (const auto& [a, b, psi] : kEnds) {
    const Scene scene =
        scene_of(volume_of(RampField{2, 1, 0}, {3, 3, 2}), transfer_of({{0, {1, 0, 0}, a}, {1, {0, 1, 0}, b}}));
    const double zeta = std::exp(-(a + b) / 2), expected[] = {1 - psi, psi - zeta, 0, 1 - zeta};
    for (const int n : {2, 3, 8}) {
      const Values values = run.stepped(1. / n, {{"classification", "preintegrated"}, {"preintegrated_size", 241}});
      const Image image = run.draw(scene, values, orthographic({0, 0, -1}, 0.9), kSize, kSize);
      run.add_picture(
          fmt::format("extinction from {:g} to {:g} in {} segments", a, b, n), image,
          "ends of each segment to 2^-20 of the box, where light changes by at most 4 a unit; floats of the "
          "table; n blends",
          [&](int, int, int channel) { return within(expected[channel], (4 + n) * 0x1p-20); });
    }
  }
}

void thin_medium(CaseRun& run) {
  // So little light that the opacity of a segment must be right to its own digits, not to those of 1.
  const View view = orthographic({0, 0, -1}, 0.5, 60);
  for (const char* classification : {"post", "pre", "preintegrated"}) {
    if (!run.has("classification", classification)) continue;
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

void lit_gradient(CaseRun& run) {
  // A field linear in x and y on a lattice of unequal spacing: the same normal everywhere but at its border.
  const glm::dvec3 spacing(0.25, 0.1, 0.5), slope(0.5, 0.5, 0);
  const glm::ivec3 size(9, 9, 3);
  std::vector<float> values;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i)
        values.push_back(static_cast<float>(1 + glm::dot(slope, spacing * glm::dvec3(i - 4, j - 4, k - 1))));
  const glm::dvec3 colour(1, 0.5, 0.25);
  Scene scene = scene_of(volume_of(values, size, spacing), homogeneous(2, colour));
  Lighting lighting;
  lighting.lights = {{Light::Kind::Directional, glm::normalize(glm::dvec3(-1, 0.2, 1)), glm::dvec3(1)}};
  scene.effects.lighting = lighting;
  const View view = orthographic({0, 0, -1}, 0.25);  // keeps clear of the border by more than a voxel
  const Image image = run.draw(scene, run.stepped(1), view, kSize, kSize);
  const double facing = glm::dot(-glm::normalize(slope), lighting.lights[0].vector), opacity = -std::expm1(-2.0);
  const double light = lighting.ambient + lighting.diffuse * facing;
  run.add_picture("a linear field, spacing .25 x .1 x .5", image,
                  "two samples to 2^-23 of the window each, over a difference of .05 of it; 12 blends",
                  [&](int, int, int channel) {
                    return channel == 3 ? within(opacity, 12 * 0x1p-23)
                                        : within(colour[channel] * light * opacity, 4 * 0x1p-23 / 0.05);
                  });
}

}  // namespace volumark::hard_cases
