// Isosurfaces with answers in closed form, or against the reference.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <random>

#include "harness/verify/cases.h"
#include "harness/verify/test_scenes.h"
#include "methods/reference/reference.h"

namespace volumark::hard_cases {
namespace {

constexpr int kSize = 48;

void show(Scene& scene, double value) {
  scene.isosurface = Isosurface{value, {0.25, 0.5, 0.75}, {1, 0.5, 0.25}};
  scene.display = Display::Isosurface;
}

void light(Scene& scene) {
  Lighting& lighting = scene.effects.lighting.emplace();
  lighting.ambient = 0.2;
  lighting.diffuse = 0.7;
  lighting.specular = 0;
  lighting.lights = {{Light::Kind::Directional, glm::normalize(glm::dvec3(0.5, 1, 0.8)), {1, 0.9, 0.8}}};
}

Settings refined(const CaseRun& run, const char* refine) {
  if (!run.has("refine", refine)) throw NotApplicable(run.method().info().name + " does not refine a surface");
  Settings settings = {{"refine", refine}};
  if (run.has("gradient_format", "rgba32f")) settings.emplace_back("gradient_format", "rgba32f");
  return settings;
}

}  // namespace

void isosurface_plane(CaseRun& run) {
  // n . p <= 0.1 in a box of side 1.4: trilinear interpolation keeps the field, one normal lights all of it.
  constexpr double kValue = 0.1, kHalf = 0.7, kStep = 0.5, kVoxel = 0.25;
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, 0.5, 1));
  std::vector<float> values;
  for (int k = 0; k < 9; ++k)
    for (int j = 0; j < 9; ++j)
      for (int i = 0; i < 9; ++i)
        values.push_back(static_cast<float>(-glm::dot(normal, kVoxel * glm::dvec3(i - 4, j - 4, k - 4))));
  Scene scene =
      scene_of(volume_of(values, glm::ivec3(9), glm::dvec3(kVoxel)), transfer_of({{0, glm::dvec3(1), 1}}, -2, 2));
  show(scene, -kValue);
  light(scene);
  // Differences at the border of the lattice are one-sided, so that normals turn there: cut away.
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1., 1.}) {
      glm::dvec3 inwards(0);
      inwards[axis] = side;
      scene.effects.clip_planes.push_back({inwards, -kHalf});
    }
  const Lighting& lighting = *scene.effects.lighting;
  const double lit = lighting.diffuse * glm::dot(normal, lighting.lights[0].vector);
  const glm::dvec3 colour =
      scene.isosurface->ambient_colour * lighting.ambient + scene.isosurface->colour * lit * lighting.lights[0].colour;
  const double moved = place_error(kSize);
  for (const char* refine : {"none", "linear"})
    for (const View& view : {perspective({1.6, 1.1, 2.7}, {0, 0, 0}), orthographic({-0.7, -0.4, -0.5}, 1.4)}) {
      const Image image = run.draw(scene, run.stepped(kStep, refined(run, refine)), view, kSize, kSize);
      run.add_picture(
          fmt::format("a lit plane, {}, refine {}", view.perspective ? "perspective" : "orthographic", refine), image,
          "2^-22: floats of 2^-24 over differences of half a unit; four times for the light; either side where the ray "
          "is in the solid for less than samples are apart",
          [&](int x, int y, int channel) {
            const Ray ray = pixel_ray(view, kSize, kSize, x, y);
            const auto solid = [&](double grow) {
              return cut_chord(box_chord(ray, glm::dvec3(kHalf + grow)), ray, {-normal, -kValue - grow}).length();
            };
            const double shown = channel == 3 ? 1 : colour[channel], rounding = channel == 3 ? 0 : 4 * 0x1p-22;
            if (solid(moved) == 0) return Allowed{};
            // Slices in the data are up to sqrt(3) of their distance apart along the ray.
            if (solid(-moved) >= std::sqrt(3.) * kStep * kVoxel) return within(shown, rounding);
            return within(image.pixel(x, y)[3] > 0 ? shown : 0, rounding);
          });
    }
}

void isosurface_waves(CaseRun& run) {
  // The picture of a lattice of 41^3 against the reference's own. Thin crests make single pixels err by all of their
  // colour; the median of the errors has the order that the refinement states.
  constexpr double kCoarse = 0.5, kFine = 0.125;
  static const Scene scene = [] {
    Scene out = scene_of(volume_of(MarschnerLobbField{6, 0.25}, glm::ivec3(41)), transfer_of({{0, glm::dvec3(1), 1}}));
    show(out, 0.5);
    light(out);
    return out;
  }();
  static const View view = orthographic({-0.5, -0.35, -1}, 1.2);
  static const Reference reference = render_reference(scene, view, kSize, kSize);
  const auto error = [&](double step, const char* refine, double& silhouette) {
    const Image image = run.draw(scene, run.stepped(step, refined(run, refine)), view, kSize, kSize);
    std::vector<double> errors;
    int other = 0;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const float *a = image.pixel(x, y), *b = reference.image.pixel(x, y);
        other += a[3] != b[3];
        if (a[3] != b[3] || b[3] == 0) continue;
        double worst = 0;
        for (int c = 0; c < 3; ++c)
          worst = std::max(worst, std::abs(static_cast<double>(a[c]) - static_cast<double>(b[c])));
        errors.push_back(worst);
      }
    silhouette = static_cast<double>(other) / (kSize * kSize);
    if (errors.empty()) return 1.;
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
    return errors[errors.size() / 2];
  };
  for (const auto& [refine, order] : {std::pair("none", 1.), std::pair("linear", 2.)}) {
    double coarse_edges = 0, fine_edges = 0;
    const double coarse = error(kCoarse, refine, coarse_edges), fine = error(kFine, refine, fine_edges);
    run.add({.check = fmt::format("order of the median error, refine {}, step {:g} to {:g}", refine, kCoarse, kFine),
             .expected = order,
             .measured = std::log2(coarse / fine) / 2,
             .bound = 0.4,
             .source = "the stated order; the median of a picture's pixels, not one of them"});
    run.add({.check = fmt::format("share of pixels that miss or add surface, refine {}, step {:g}", refine, kFine),
             .expected = 0,
             .measured = fine_edges,
             .bound = 2e-3,
             .source = "chords of the solid shorter than an eighth of a voxel: a judgement"});
  }
}

namespace {

struct Line {  // the field along an axis of the lattice, linear from sample to sample
  std::vector<double> values;
  // Where it first reaches the value, in cells from the first sample.
  std::optional<double> first(double value) const {
    if (values.front() >= value) return 0;
    for (size_t i = 1; i < values.size(); ++i)
      if (values[i] >= value) return static_cast<double>(i - 1) + (value - values[i - 1]) / (values[i] - values[i - 1]);
    return std::nullopt;
  }
};

// Along `axis` through a place given in halves of cells across it: edges, middles of faces, middles of cells.
Line line_through(const Volume& volume, int axis, const glm::ivec3& halves) {
  Line line;
  for (int i = 0; i < volume.size[axis]; ++i) {
    double sum = 0;
    for (int corner = 0; corner < 4; ++corner) {
      glm::ivec3 at = halves / 2;
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      at[u] += (corner & 1) * (halves[u] % 2);
      at[v] += (corner >> 1) * (halves[v] % 2);
      at[axis] = i;
      sum += volume.at(at.x, at.y, at.z);
    }
    line.values.push_back(sum / 4);
  }
  return line;
}

}  // namespace

void isosurface_on_levels(CaseRun& run) {
  // Data of 0, 1 and 2 and the isovalue 1: whole edges and faces of cells lie on the surface, and rays run along them.
  // Along an axis of the lattice the field is linear from sample to sample, so that halves and quarters are exact.
  std::mt19937_64 random(23);
  const glm::ivec3 size(6, 5, 7);
  std::vector<float> values(static_cast<size_t>(size.x) * static_cast<size_t>(size.y) * static_cast<size_t>(size.z));
  for (float& value : values) value = static_cast<float>(std::max<int>(0, static_cast<int>(random() % 6) - 3));
  Scene scene = scene_of(volume_of(values, size, glm::dvec3(1)), transfer_of({{0, glm::dvec3(1), 1}}, 0, 2));
  scene.volume = [&] {
    auto volume = std::make_shared<Volume>(*scene.volume);
    volume->origin = glm::dvec3(0);
    return volume;
  }();
  show(scene, 1);
  for (int axis = 0; axis < 3; ++axis) {
    int wrong = 0, rays = 0, hits = 0;
    double worst = 0;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int a = 0; a <= 2 * (size[u] - 1); ++a)
      for (int b = 0; b <= 2 * (size[v] - 1); ++b) {
        glm::ivec3 halves(0);
        halves[u] = a;
        halves[v] = b;
        const auto expected = line_through(*scene.volume, axis, halves).first(1);
        Ray ray{0.5 * glm::dvec3(halves), glm::dvec3(0), 0};
        ray.direction[axis] = 1;
        ray.origin[axis] = -3;
        const RayIntegral found = integrate_ray(scene, View{}, ray);
        ++rays;
        hits += expected.has_value() ? 1 : 0;
        const bool hit = found.rgba[3] == 1 && found.distance.has_value();
        wrong += hit != expected.has_value() ? 1 : 0;
        if (hit && expected) worst = std::max(worst, std::abs(*found.distance - 3 - *expected));
      }
    run.add({.check = fmt::format("{} rays along {}, {} of them meet the surface: answers that are wrong", rays,
                                  "xyz"[axis], hits),
             .expected = 0,
             .measured = static_cast<double>(wrong),
             .bound = 0,
             .source = "the field is linear between samples: its largest sample decides"});
    run.add({.check = fmt::format("along {}: where they meet it", "xyz"[axis]),
             .expected = 0,
             .measured = worst,
             .bound = 1e-13,
             .source = "the root of a line; rounding of doubles over ten units"});
  }
}

}  // namespace volumark::hard_cases
