// Methods that show an isosurface: closed forms, the reference, the other backend, and their parameters.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/frame.h"
#include "harness/metrics/metrics.h"
#include "methods/reference/reference.h"
#include "tests/support/backend.h"
#include "tests/support/drawing.h"
#include "tests/unit/methods/test_scene.h"

namespace volumark {
namespace {

constexpr const char* kMethods[] = {"texture3d_slices_iso", "slices2d_iso", "raycast_iso"};

class Isosurfaces : public ::testing::TestWithParam<const char*> {
 protected:
  std::string method = GetParam();
  Device device = make_device(backend_id(), device_options());

  // `distance` of the slices in voxels, 1 or less.
  Image picture(const Scene& scene, const View& view, int width, int height, double distance,
                std::vector<std::pair<std::string, std::string>> more = {}) {
    if (method == "slices2d_iso") {
      more.emplace_back("slices", fmt::format("{}", std::lround(100 / distance)));
    } else {
      more.emplace_back("step", fmt::format("{}", distance));
    }
    if (scene.effects.lighting && has("gradient_format")) more.emplace_back("gradient_format", "rgba32f");
    return draw_with(device, scene, more, view, width, height);
  }
  bool has(const std::string& parameter) const {
    const auto& all = find_method(method).info().parameters;
    return std::any_of(all.begin(), all.end(), [&](const ParameterInfo& info) { return info.name == parameter; });
  }
  Image draw_with(Device& on, const Scene& scene, const std::vector<std::pair<std::string, std::string>>& settings,
                  const View& view, int width, int height) {
    const Method& chosen = find_method(method);
    Values values = default_values(chosen.info().parameters);
    for (const auto& [name, value] : settings) set_value(chosen.info().parameters, values, name, value);
    if (const auto reason = unsupported_reason(chosen, scene, values, on.info())) throw std::runtime_error(*reason);
    FrameSource source(scene, chosen, values, on, width, height);
    source.frame(view);
    return source.read_back();
  }
};
INSTANTIATE_TEST_SUITE_P(Each, Isosurfaces, ::testing::ValuesIn(kMethods),
                         [](const auto& tested) { return std::string(tested.param); });

using Extra = std::vector<std::pair<std::string, std::string>>;

// A volume of `n`^3 samples of the unit cube around the origin.
template <class Field>
Scene field_scene(int n, double isovalue, const Field& field) {
  std::vector<float> values;
  const double h = 2. / (n - 1);
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        values.push_back(static_cast<float>(field(glm::dvec3(i * h - 1, j * h - 1, k * h - 1))));
  Volume volume = testing::volume_of<float>({n, n, n}, VoxelType::F32, values);
  volume.spacing = glm::dvec3(h);
  volume.origin = glm::dvec3(-1);
  Scene scene = testing::scene_of(std::move(volume), -2, 2);
  scene.display = Display::Isosurface;
  scene.isosurface.emplace();
  scene.isosurface->value = isovalue;
  scene.isosurface->colour = {1, 0.5, 0.25};
  scene.isosurface->ambient_colour = {0.25, 0.5, 1};
  return scene;
}
Scene sphere_scene(int n, double radius) {
  return field_scene(n, 0, [&](const glm::dvec3& p) { return radius - glm::length(p); });
}
void light(Scene& scene, double specular = 0.3) {
  Lighting& lighting = scene.effects.lighting.emplace();
  lighting.ambient = 0.2;
  lighting.diffuse = 0.7;
  lighting.specular = specular;
  lighting.shininess = 16;
  lighting.lights = {{Light::Kind::Directional, glm::normalize(glm::dvec3(0.5, 1, 0.8)), {1, 0.9, 0.8}},
                     {Light::Kind::Point, {-2, 1, 3}, {0.2, 0.4, 0.6}}};
}
const View kPerspective = testing::view_at({1.6, 1.1, 2.7}, {0.02, 0.01, 0}, true);
const View kOrthographic = testing::view_at({1.6, 1.1, 2.7}, {0.02, 0.01, 0}, false);

// Share of pixels whose alpha differs, and the root mean square of the colours where both show the surface.
struct Errors {
  double silhouette = 0, interior_rms = 0, interior_max = 0;
  int shown = 0;
};
Errors errors(const Image& a, const Image& b) {
  Errors e;
  double sum = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const float *p = a.pixel(x, y), *q = b.pixel(x, y);
      if (p[3] != q[3]) {
        ++e.silhouette;
        continue;
      }
      e.shown += p[3] > 0 ? 1 : 0;
      for (int c = 0; c < 3; ++c) {
        const double d = std::abs(static_cast<double>(p[c]) - static_cast<double>(q[c]));
        sum += d * d;
        e.interior_max = std::max(e.interior_max, d);
      }
    }
  e.silhouette /= static_cast<double>(a.width) * a.height;
  e.interior_rms = std::sqrt(sum / (3. * std::max(e.shown, 1)));
  return e;
}

// Rays that pass a ball deeper than half a slice's distance meet it; those that miss it by the error of the lattice,
// h^2 / (4 r) one-sided with the voxel h, do not. Between, either.
TEST_P(Isosurfaces, ABallIsItsDisc) {
  const int n = 33, size = 96;
  const double radius = 0.7, h = 2. / (n - 1);
  Scene scene = sphere_scene(n, radius);
  for (const View& view : {kPerspective, kOrthographic}) {
    const Image image = picture(scene, view, size, size, 0.5);
    // Where slices lie at 45 degrees to the ray, they are sqrt(2) apart along it; at worst sqrt(3).
    const double chord = 0.5 * h * std::sqrt(3.), inner = radius - h * h / (2 * radius);
    const double surely = std::sqrt(inner * inner - chord * chord / 4);
    int inside = 0;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const Ray ray = pixel_ray(view, size, size, x, y);
        const double t = -glm::dot(ray.origin, ray.direction);
        const double distance = glm::length(ray.origin + t * ray.direction);
        const float* pixel = image.pixel(x, y);
        if (distance < surely) {
          ++inside;
          ASSERT_EQ(pixel[3], 1.F) << x << ", " << y;
          ASSERT_EQ(pixel[0], 1.F);
          ASSERT_EQ(pixel[1], 0.5F);
          ASSERT_EQ(pixel[2], 0.25F);
        } else if (distance > radius) {
          for (int c = 0; c < 4; ++c) ASSERT_EQ(pixel[c], 0.F) << x << ", " << y;
        }
      }
    EXPECT_GT(inside, 300);
  }
}

// A plane under trilinear interpolation is exact, and so is one step of the secant on it: the light is that of its
// normal up to rounding, wherever slices lie.
TEST_P(Isosurfaces, APlaneIsLitExactly) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, 0.5, 1));
  Scene scene = field_scene(9, 0.1, [&](const glm::dvec3& p) { return 0.2 - glm::dot(normal, p); });
  light(scene, 0);
  scene.effects.lighting->lights.resize(1);
  const glm::dvec3 towards = scene.effects.lighting->lights[0].vector;
  // Away from the border, where clamped differences are halves.
  for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
    for (const double side : {-1., 1.}) scene.effects.clip_planes.push_back({side * axis, -0.7});
  const Image image = picture(scene, kPerspective, 64, 64, 0.7, {{"refine", "linear"}});
  const Lighting& lighting = *scene.effects.lighting;
  int seen = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const Ray ray = pixel_ray(kPerspective, 64, 64, x, y);
      const double t = (0.1 - glm::dot(normal, ray.origin)) / glm::dot(normal, ray.direction);
      const glm::dvec3 p = glm::abs(ray.origin + t * ray.direction);
      if (std::max({p.x, p.y, p.z}) > 0.69) continue;
      ++seen;
      const double lit = lighting.diffuse * glm::dot(normal, towards);
      for (int c = 0; c < 3; ++c) {
        const double expected = scene.isosurface->ambient_colour[c] * lighting.ambient +
                                scene.isosurface->colour[c] * lit * lighting.lights[0].colour[c];
        // Gradients from floats of 2^-24 over differences of 1/4.
        ASSERT_NEAR(static_cast<double>(image.pixel(x, y)[c]), expected, 2e-5) << x << ", " << y;
      }
    }
  EXPECT_GT(seen, 200);
}

// Against the reference: the fronts of solids where clip planes, faces and the near plane cut them are met exactly.
TEST_P(Isosurfaces, AgreeWithTheReferenceWhereSolidsAreCut) {
  // Solid at the faces of the box, hollow inside: every ray starts in the solid.
  Scene scene = field_scene(17, -0.6, [](const glm::dvec3& p) { return glm::length(p) - 1.2; });
  light(scene);
  View inside = kPerspective;
  inside.eye = {0.1, 0.05, 0.9};
  inside.near = 0.01;
  scene.effects.clip_planes = {{glm::normalize(glm::dvec3(1, 0.2, -0.4)), -0.8}};
  for (const View& view : {kPerspective, kOrthographic, inside}) {
    const Image reference = render_reference(scene, view, 64, 64).image;
    const Image image = picture(scene, view, 64, 64, 1);
    const Errors e = errors(image, reference);
    EXPECT_LE(e.silhouette, 0.01) << "alpha";
    EXPECT_GT(e.shown, 500);
    const float* centre = image.pixel(32, 32);
    const float* expected = reference.pixel(32, 32);
    // The first sample is the point of entry itself.
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(centre[c], expected[c], 1e-4);
    EXPECT_LE(e.interior_rms, 0.02);
  }
}

// Error of the interior falls with order 1 in the distance of slices, with one step of the secant with order 2.
TEST_P(Isosurfaces, ConvergeAsStated) {
  Scene scene = sphere_scene(24, 0.75);
  light(scene);
  const int size = 128;
  const Image reference = render_reference(scene, kPerspective, size, size).image;
  const auto error = [&](double distance, const char* refine) {
    return errors(picture(scene, kPerspective, size, size, distance, {{"refine", refine}}), reference);
  };
  const Errors plain = error(1, "none"), finer = error(0.125, "none");
  const Errors linear = error(1, "linear"), linear_finer = error(0.125, "linear");
  RecordProperty("plain", fmt::format("{} {}", plain.interior_rms, finer.interior_rms));
  fmt::print("{}: none {:.2e} -> {:.2e}, linear {:.2e} -> {:.2e}; silhouettes {:.2e} -> {:.2e}, {:.2e} -> {:.2e}\n",
             method, plain.interior_rms, finer.interior_rms, linear.interior_rms, linear_finer.interior_rms,
             plain.silhouette, finer.silhouette, linear.silhouette, linear_finer.silhouette);
  EXPECT_NEAR(std::log(plain.interior_rms / finer.interior_rms) / std::log(8.), 1, 0.3);
  EXPECT_NEAR(std::log(linear.interior_rms / linear_finer.interior_rms) / std::log(8.), 2, 0.5);
  EXPECT_LE(linear_finer.silhouette, 0.002);
}

TEST_P(Isosurfaces, OrderOfDrawingChangesNoBit) {
  if (!has("order")) return;  // a ray has one
  Scene scene = sphere_scene(20, 0.8);
  light(scene);
  View inside = kPerspective;
  inside.eye = {0.2, 0.1, 0.95};
  for (const View& view : {kPerspective, kOrthographic, inside}) {
    const Image front = picture(scene, view, 80, 60, 0.5, {{"order", "front_to_back"}});
    const Image back = picture(scene, view, 80, 60, 0.5, {{"order", "back_to_front"}});
    EXPECT_EQ(front.rgba, back.rgba);
  }
}

// Everything of exactly the isovalue is inside, in every format that holds the data.
TEST_P(Isosurfaces, DataOfExactlyTheIsovalueAreInside) {
  for (const int value : {0, 1, 127, 200, 255}) {
    Scene scene = testing::scene_of(
        testing::volume_of<uint8_t>({5, 5, 5}, VoxelType::U8, std::vector<uint8_t>(125, static_cast<uint8_t>(value))));
    scene.display = Display::Isosurface;
    scene.isosurface.emplace();
    const View view = testing::view_at({9, 7, 12}, {2, 2, 2}, true);
    light(scene);
    std::vector<Extra> formats = {{}};
    if (has("gradient_format"))
      formats = {{{"gradient_format", "rgba8"}}, {{"gradient_format", "rgba16f"}}, {{"gradient_format", "rgba32f"}}};
    for (const Extra& settings : formats) {
      const std::string format = settings.empty() ? "" : settings.front().second;
      scene.isosurface->value = value;
      EXPECT_EQ(draw_with(device, scene, settings, view, 16, 16).pixel(8, 8)[3], 1.F) << value << " " << format;
      scene.isosurface->value = value + 0.25;
      EXPECT_EQ(draw_with(device, scene, settings, view, 16, 16).pixel(8, 8)[3], 0.F) << value << " " << format;
    }
  }
}

TEST_P(Isosurfaces, BackendsAgree) {
  Device other = make_device(backend_id() == "cpu" ? "gl" : "cpu");
  Scene scene = field_scene(24, 0.05, [](const glm::dvec3& p) {
    return std::sin(3 * p.x + 0.4) * std::sin(2.5 * p.y) + 0.5 * std::cos(4 * p.z + p.x) - 0.2;
  });
  light(scene);
  for (const bool cut : {false, true}) {
    if (cut) scene.effects.clip_planes = {{glm::normalize(glm::dvec3(0.2, -1, 0.3)), -0.4}};
    std::vector<Extra> each = {{}, {{"refine", "linear"}}};
    if (has("normals")) {
      each.push_back({{"normals", "interpolated"}});
      each.push_back({{"gradient_format", "rgba8"}, {"normals", "interpolated"}});
    } else {
      each.push_back({{"refine", "none"}});
      each.push_back({{"skip_empty", "none"}});
    }
    for (const Extra& settings : each) {
      const Image here = draw_with(device, scene, settings, kPerspective, 96, 96);
      const Image there = draw_with(other, scene, settings, kPerspective, 96, 96);
      const Parity agreement = parity(here, there);
      EXPECT_TRUE(agreement.agree) << "interior " << agreement.interior_max << " at " << agreement.interior_x << ", "
                                   << agreement.interior_y << "; silhouettes over the limit "
                                   << agreement.silhouette_over << " of " << agreement.silhouette_pixels;
      EXPECT_GT(agreement.interior_pixels, 1000);
    }
  }
}

TEST_P(Isosurfaces, ThreadsDoNotChangeABit) {
  if (backend_id() != "cpu") return;
  Scene scene = sphere_scene(20, 0.8);
  light(scene);
  std::vector<Image> images;
  for (const int threads : {1, 2, 5}) {
    DeviceOptions options;
    options.threads = threads;
    Device limited = make_device("cpu", options);
    images.push_back(draw_with(limited, scene, {}, kPerspective, 200, 120));
  }
  EXPECT_EQ(images[0].rgba, images[1].rgba);
  EXPECT_EQ(images[0].rgba, images[2].rgba);
}

TEST_P(Isosurfaces, IsovaluesOutsideOfTheDataAreAllOrNothing) {
  Scene scene = sphere_scene(9, 0.5);
  scene.isosurface->value = 1e6;
  for (const float value : picture(scene, kPerspective, 24, 24, 1).rgba) ASSERT_EQ(value, 0.F);
  scene.isosurface->value = -1e6;
  const Image all = picture(scene, kPerspective, 24, 24, 1);
  const Image reference = render_reference(scene, kPerspective, 24, 24).image;
  EXPECT_LE(errors(all, reference).silhouette, 0.01);
  EXPECT_EQ(all.pixel(12, 12)[3], 1.F);
}

}  // namespace
}  // namespace volumark
