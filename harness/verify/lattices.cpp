// Lattices as they come: unequal spacing, turned axes, every type of voxel; and light, which depends on all of them.
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "harness/verify/cases.h"
#include "harness/verify/test_scenes.h"

namespace volumark::hard_cases {
namespace {

constexpr int kSize = 32;

// 1 + slope . p on a lattice of unequal spacing, centred at the origin: the same gradient everywhere but at the border.
Scene linear_scene(const glm::dvec3& slope) {
  const glm::dvec3 spacing(0.25, 0.1, 0.5);
  const glm::ivec3 size(9, 9, 3);
  std::vector<float> values;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i)
        values.push_back(static_cast<float>(1 + glm::dot(slope, spacing * glm::dvec3(i - 4, j - 4, k - 1))));
  return scene_of(volume_of(values, size, spacing), homogeneous(2, {1, 0.5, 0.25}));
}

// The scene and the view, turned as one.
void turn(const glm::dmat3& rotation, Scene& scene, View& view) {
  Volume volume = *scene.volume;
  volume.axes = rotation * volume.axes;
  volume.origin = rotation * volume.origin;
  scene.volume = std::make_shared<const Volume>(std::move(volume));
  for (Light& light : scene.effects.lighting->lights) light.vector = rotation * light.vector;
  view.eye = rotation * view.eye;
  view.target = rotation * view.target;
  view.up = rotation * view.up;
}

// Ambient, diffuse and specular at a normal, in front of an orthographic view along -z.
struct Shade {
  double factor, added;
};
Shade shade_of(const Lighting& lighting, const glm::dvec3& normal) {
  const glm::dvec3 l = lighting.lights[0].vector, halfway = glm::normalize(l + glm::dvec3(0, 0, 1));
  const double nl = glm::dot(normal, l), nh = glm::dot(normal, halfway);
  const auto facing = [&](double x) { return lighting.two_sided ? std::abs(x) : std::max(x, 0.); };
  const double shine = lighting.two_sided || nl > 0 ? std::pow(facing(nh), lighting.shininess) : 0;
  return {lighting.ambient + lighting.diffuse * facing(nl), lighting.specular * shine};
}

template <class T>
void put(Volume& volume, size_t index, long value) {
  const T stored = static_cast<T>(value);
  std::memcpy(volume.voxels.data() + index * sizeof(T), &stored, sizeof(T));
}

}  // namespace

void lit_gradient(CaseRun& run) {
  const glm::dvec3 slope(0.5, 0.5, 0), colour(1, 0.5, 0.25);
  const double opacity = -std::expm1(-2.0);
  // Keeps clear of the border by more than a voxel.
  const View front = orthographic({0, 0, -1}, 0.25);
  const auto check = [&](const std::string& name, const Scene& scene, const View& view, const Shade& shade) {
    const Image image = run.draw(scene, run.stepped(1), view, kSize, kSize);
    // Two samples to 2^-23 of the window each, over a difference of .05 of it, times what the light depends on the
    // normal.
    const double bound =
        4 * 0x1p-23 / 0.05 * (1 + scene.effects.lighting->specular * scene.effects.lighting->shininess);
    run.add_picture(name, image, "the gradient: two samples to 2^-23 of the window, .05 of it apart; 12 blends",
                    [&](int, int, int channel) {
                      return channel == 3 ? within(opacity, 12 * 0x1p-23)
                                          : within((colour[channel] * shade.factor + shade.added) * opacity, bound);
                    });
  };
  Lighting lighting;
  lighting.lights = {{Light::Kind::Directional, glm::normalize(glm::dvec3(-1, 0.2, 1)), glm::dvec3(1)}};
  Scene scene = linear_scene(slope);
  for (const bool two_sided : {false, true})
    for (const double specular : {0., 0.5}) {
      lighting.two_sided = two_sided;
      lighting.specular = specular;
      lighting.shininess = 8;
      scene.effects.lighting = lighting;
      const std::string name = fmt::format("specular {:g}{}", specular, two_sided ? ", two-sided" : "");
      const Shade shade = shade_of(lighting, -glm::normalize(slope));
      check("spacing .25 x .1 x .5, " + name, scene, front, shade);
      Scene turned = scene;
      View view = front;
      turn(glm::dmat3(glm::rotate(glm::dmat4(1), 0.7, glm::normalize(glm::dvec3(1, 2, 3)))), turned, view);
      check("the same, turned, " + name, turned, view, shade);
    }
  // Homogeneous matter has no normal: only the ambient term is left.
  Scene flat = linear_scene(glm::dvec3(0));
  flat.effects.lighting = lighting;
  check("no gradient", flat, front, {lighting.ambient, 0});
}

void voxel_types(CaseRun& run) {
  // The same data values, stored as each type, on a slanted ramp of 256 levels.
  const auto scene_as = [](VoxelType type, int lowest) {
    Scene scene = scene_of(volume_of(RampField{0, 0, 255}, {18, 3, 3}),
                           transfer_of({{0, {1, 0, 0}, 0}, {255, {0, 1, 0}, 2}}, 0, 255));
    Volume volume = *scene.volume;
    const auto* values = reinterpret_cast<const float*>(scene.volume->voxels.data());
    const size_t count = scene.volume->voxels.size() / sizeof(float);
    volume.type = type;
    volume.intercept = -lowest;
    volume.voxels.assign(count * voxel_bytes(type), std::byte{});
    for (size_t i = 0; i < count; ++i) {
      const long stored = std::lround(values[i]) + lowest;
      if (type == VoxelType::U8) put<uint8_t>(volume, i, stored);
      if (type == VoxelType::U16) put<uint16_t>(volume, i, stored);
      if (type == VoxelType::I16) put<int16_t>(volume, i, stored);
      if (type == VoxelType::F32) put<float>(volume, i, stored);
    }
    scene.volume = std::make_shared<const Volume>(std::move(volume));
    return scene;
  };
  const View view = orthographic({-0.3, -0.2, -1}, 0.5);
  const auto picture = [&](const Scene& scene) { return run.draw(scene, run.stepped(1), view, kSize, kSize); };
  const Image expected = picture(scene_as(VoxelType::F32, 0));
  // The rays are at most .25 long there: extinction off by e of the window changes the opacity by less than e / 2.
  const double level = 1. / 255;
  run.add_equal("u8 as f32", picture(scene_as(VoxelType::U8, 0)), expected, level / 2,
                "drivers may filter texels of 8 bits in 8 bits: one level of 255");
  const char* const source = "256 levels are 1/256 of the range of 16 bits: 2^-23 of it";
  run.add_equal("u16 as f32", picture(scene_as(VoxelType::U16, 1000)), expected, 256 * 0x1p-23, source);
  run.add_equal("i16 as f32", picture(scene_as(VoxelType::I16, -128)), expected, 256 * 0x1p-23, source);
}

void order_around_eye(CaseRun& run) {
  // Thin slices across z, the eye beside the box and between its lowest and highest slice: it sees some from below and
  // some from above. One extinction; the colour is linear in z, so that a ray's light has a closed form.
  constexpr double kTau = 1.5, kStep = 2. / 32;
  std::vector<float> values;
  for (int k = 0; k < 33; ++k) values.insert(values.end(), 81, static_cast<float>(k) / 32);
  const Scene scene = scene_of(volume_of(values, {9, 9, 33}, {0.25, 0.25, kStep}),
                               transfer_of({{0, {1, 0, 0}, kTau}, {1, {0, 1, 0}, kTau}}));
  const View view = perspective({1.5, 0.1, 0.9}, {0, 0, 0}, 1.2);
  const glm::dvec3 forward = frame_of(view).forward;
  const Image image = run.draw(scene, run.stepped(1), view, kSize, kSize);
  run.add_picture(
      "eye beside the box, between its slices", image,
      "a midpoint in segments across the view or across z: slope tau d^2 / 12 of light, at most half of its change; "
      "faces moved by 2^-20 of the box",
      [&](int x, int y, int channel) {
        const Ray ray = pixel_ray(view, kSize, kSize, x, y);
        const Chord chord = box_chord(ray, glm::dvec3(1));
        const double length = chord.length(), through = std::exp(-kTau * length);
        if (channel == 2 || length == 0) return within(0, 0);
        const double grown = box_chord(ray, glm::dvec3(1 + 2 * 0x1p-20)).length() - length;
        const double moved = kTau * grown + 60 * 0x1p-23;
        if (channel == 3) return within(1 - through, moved);
        const double rise = 0.5 * ray.direction.z, z0 = ray.origin.z + chord.t0 * ray.direction.z;
        const double first = 0.5 + 0.5 * z0;  // green where the ray enters
        const double green = first * (1 - through) + rise * (1 - through * (1 + kTau * length)) / kTau;
        const auto midpoint = [&](double segment) { return std::abs(rise) * kTau * segment * segment / 12 * 1.2; };
        const double across_view = midpoint(kStep / glm::dot(ray.direction, forward));
        const double across_z = std::min(midpoint(kStep / std::max(std::abs(ray.direction.z), 1e-9)), 0.25 * kStep);
        return within(channel == 1 ? green : 1 - through - green, std::max(across_view, across_z) + moved + 0x1p-19);
      });
}

}  // namespace volumark::hard_cases
