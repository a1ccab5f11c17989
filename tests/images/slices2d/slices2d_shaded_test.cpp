// Shaded slices of 2D textures (rezksalama2000, section 8): lit by stored gradients they tend to the reference; the
// paper's two forms are, on fields whose normals are known, sums of pictures without light; bits and backends.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "harness/metrics/metrics.h"
#include "methods/reference/reference.h"
#include "tests/support/backend.h"
#include "tests/support/drawing.h"

namespace volumark {
namespace {

class Slices2dShaded : public testing::Test {
 protected:
  Device device = make_device(backend_id(), device_options());

  Image picture(const Scene& scene, Settings settings, const char* method = "slices2d_shaded", int size = 64) {
    return draw(device, scene, method, settings, scene.views.at(0), size, size).image;
  }
};

constexpr const char* kTransfer = R"({"points": [{"value": 0, "colour": [0.2, 0.4, 1], "extinction": 0.2},
  {"value": 1, "colour": [1, 0.6, 0.2], "extinction": 2}], "window": [0, 1]})";

Scene scene_of(const std::string& generator, const std::string& eye, const std::string& effects) {
  return scene_from_text(fmt::format(R"({{
    "volumark_scene": 1, "title": "lit", "volume": {{"generator": {}}}, "transfer": {},
    "views": [{{"eye": {}, "target": [0, 0, 0], "up": [0, 1, 0.01], "units": "world", "fov_y": 40}}],
    "effects": {{{}}}}})",
                                     generator, kTransfer, eye, effects));
}
// Smooth, with detail along all axes.
Scene smooth_scene(const std::string& effects, const std::string& eye = "[1.1, 1.4, 3]") {
  return scene_of(R"({"kind": "marschner_lobb", "size": 48, "type": "f32", "frequency": 1, "alpha": 0.25})", eye,
                  effects);
}
// One normal everywhere: -x, -y or -z.
Scene ramp_scene(char axis, const std::string& eye, const std::string& effects) {
  return scene_of(
      fmt::format(R"({{"kind": "ramp", "size": 24, "type": "f32", "axis": "{}", "from": 0, "to": 1}})", axis), eye,
      effects);
}

constexpr const char* kBlinnPhong = R"("lighting": {
  "ambient": 0.2, "diffuse": 0.7, "specular": 0.3, "shininess": 12, "two_sided": false,
  "lights": [{"directional": [0.5, 1, 0.3], "colour": [1, 0.9, 0.8]},
             {"point": [2, 0.5, 2], "colour": [0.3, 0.4, 0.6]}]})";
// Of eq. 6: ambient and diffuse.
std::string diffuse_lights(double ambient, double diffuse, int lights, bool two_sided = false) {
  return fmt::format(R"("lighting": {{"ambient": {}, "diffuse": {}, "specular": 0, "two_sided": {}, "lights": [
    {{"directional": [-0.5, 0.6, -0.8], "colour": [1, 0.9, 0.8]}}{}]}})",
                     ambient, diffuse, two_sided,
                     lights > 1 ? R"(, {"directional": [0.7, -0.4, -0.2], "colour": [0.3, 0.4, 0.6]})" : "");
}

// ---- The full form ----

// The bounds are what order 2 leaves at 400 %, measured once and rounded up; a stack whose vectors are not turned, or a
// gradient of the wrong length, is far above them.
TEST_F(Slices2dShaded, FullAgreesWithTheReference) {
  for (const char* eye : {"[3, 1.1, 1.4]", "[1.4, 3, 1.1]", "[1.1, 1.4, 3]"}) {
    for (const std::string& more : {std::string(), std::string(R"(, "clip_planes": [
           {"normal": [1, 0.3, 0.2], "distance": -0.3}, {"normal": [-0.2, 1, -0.5], "distance": -0.4}])")}) {
      const Scene scene = smooth_scene(kBlinnPhong + more, eye);
      const Image reference = render_reference(scene, scene.views[0], 64, 64).image;
      const Difference d = difference(picture(scene, {{"slices", "400"}}), reference);
      EXPECT_LE(d.rmse, 1e-3) << eye << more;
      EXPECT_LE(d.max, 2e-2) << eye << more << " at " << d.x << ", " << d.y;
    }
  }
}

// At 100 % slices lie on the samples, where the gradient has its kinks: the constant of the error is another one there
// (measured: 5.1e-4 at 100 %, then 2.0e-4, 5.8e-5, 1.5e-5).
TEST_F(Slices2dShaded, FullConvergesWithOrderTwo) {
  const Scene scene = smooth_scene(kBlinnPhong);
  const Image reference = render_reference(scene, scene.views[0], 64, 64).image;
  const auto error = [&](const char* slices) {
    return difference(picture(scene, {{"slices", slices}}), reference).rmse;
  };
  const double order = std::log(error("200") / error("800")) / std::log(4.0);
  EXPECT_NEAR(order, 2, 0.2);
}

TEST_F(Slices2dShaded, AnisotropicVoxelsHaveTheirOwnNormals) {
  Scene scene = smooth_scene(kBlinnPhong);
  auto volume = std::make_shared<Volume>(*scene.volume);
  volume->spacing *= glm::dvec3(1, 1, 0.4);
  volume->origin *= glm::dvec3(1, 1, 0.4);
  scene.volume = volume;
  const Image reference = render_reference(scene, scene.views[0], 64, 64).image;
  EXPECT_LE(difference(picture(scene, {{"slices", "400"}}), reference).rmse, 1e-3);
}

// ---- Without light: the pictures of slices2d ----

TEST_F(Slices2dShaded, WithoutLightItIsSlices2d) {
  const Scene scene = smooth_scene("");
  EXPECT_EQ(picture(scene, {}).rgba, picture(scene, {}, "slices2d").rgba);
  EXPECT_EQ(picture(scene, {{"form", "separate"}}).rgba, picture(scene, {{"classification", "pre"}}, "slices2d").rgba);
}

// Form separate: colours of the voxels are the ambient ones.
TEST_F(Slices2dShaded, SeparateUnderAmbientLightAloneIsPreClassified) {
  const Scene lit = smooth_scene(diffuse_lights(1, 0, 2)), plain = smooth_scene("");
  for (const char* interpolation : {"true", "false"}) {
    for (const char* normals : {"normalised", "interpolated"}) {
      const Image image = picture(lit, {{"form", "separate"}, {"interpolation", interpolation}, {"normals", normals}});
      const Image expected = picture(plain, {{"classification", "pre"}, {"interpolation", interpolation}}, "slices2d");
      // The same operations but for + 0 and * 1.
      EXPECT_LE(difference(image, expected).max, 48 * 0x1p-24) << interpolation << normals;
    }
  }
}

// What a pixel of the paper's forms is where the normal is the same everywhere: eq. 6 times opacity.
struct Lit {
  double ambient;
  glm::dvec3 diffuse;  // sum over the lights
};
Lit light_on(const Scene& scene, const glm::dvec3& normal) {
  const Lighting& lighting = *scene.effects.lighting;
  Lit lit{lighting.ambient, glm::dvec3(0)};
  for (const Light& light : lighting.lights) {
    const double nl = glm::dot(normal, glm::normalize(light.vector));
    lit.diffuse += light.colour * lighting.diffuse * (lighting.two_sided ? std::abs(nl) : std::max(nl, 0.));
  }
  return lit;
}

// Ramps along each axis, from in front of each stack: the vectors of a stack are turned as its slices are.
TEST_F(Slices2dShaded, FormsOnARampAreEquationSixTimesOpacity) {
  const glm::dvec3 normals[3] = {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  for (const char* eye : {"[3, 1.1, 1.4]", "[1.4, 3, 1.1]", "[1.1, 1.4, 3]"}) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool two_sided : {false, true}) {
        const auto ramp = [&](const std::string& effects) {
          return ramp_scene("xyz"[static_cast<size_t>(axis)], eye, effects);
        };
        const Scene two = ramp(diffuse_lights(0.3, 0.7, 2, two_sided)),
                    one = ramp(diffuse_lights(0.3, 0.7, 1, two_sided));
        const Image pre = picture(ramp(""), {{"classification", "pre"}}, "slices2d", 32);
        const Image separate = picture(two, {{"form", "separate"}}, "slices2d_shaded", 32);
        const Image gradient = picture(one, {{"form", "gradient"}}, "slices2d_shaded", 32);
        const Lit by_two = light_on(two, normals[axis]), by_one = light_on(one, normals[axis]);
        double worst = 0;
        for (size_t i = 0; i < pre.rgba.size(); i += 4) {
          const double alpha = pre.rgba[i + 3];
          for (size_t c = 0; c < 3; ++c) {
            const auto channel = static_cast<int>(c);
            const double colour = pre.rgba[i + c];
            worst = std::max(
                {worst, std::abs(separate.rgba[i + c] - (by_two.ambient * colour + by_two.diffuse[channel] * alpha)),
                 std::abs(gradient.rgba[i + c] - (by_one.ambient + by_one.diffuse[channel]) * alpha)});
          }
          worst = std::max({worst, std::abs(separate.rgba[i + 3] - alpha), std::abs(gradient.rgba[i + 3] - alpha)});
        }
        // Four roundings for each of 24 slices, of numbers up to 2.
        EXPECT_LE(worst, 24 * 4 * 2 * 0x1p-24) << eye << " axis " << axis << (two_sided ? ", two sided" : "");
      }
    }
  }
}

// ---- What the boards could not do ----

TEST_F(Slices2dShaded, NormalsThatAreNotNormalisedAgainAreShorter) {
  const Scene scene = smooth_scene(diffuse_lights(0, 1, 2, true));
  const auto light_in = [&](const char* normals) {
    double sum = 0;
    for (const float value : picture(scene, {{"normals", normals}, {"slices", "400"}}).rgba)
      sum += static_cast<double>(value);
    return sum;
  };
  const double full = light_in("normalised"), shortened = light_in("interpolated");
  EXPECT_LT(shortened, full) << "two-sided light grows with the length of the normal";
  EXPECT_GT(shortened, 0.9 * full);
}

TEST_F(Slices2dShaded, FormatsOfGradientsDifferByTheirRounding) {
  const Scene scene = smooth_scene(kBlinnPhong);
  const Image exact = picture(scene, {});
  const auto apart = [&](const char* format, const char* normals) {
    return difference(picture(scene, {{"gradient_format", format}, {"normals", normals}}),
                      picture(scene, {{"normals", normals}}))
        .rmse;
  };
  EXPECT_LE(apart("rgba16f", "normalised"), 1e-3);
  EXPECT_LE(apart("rgba16f", "interpolated"), 1e-3);
  EXPECT_LE(apart("rgba8", "interpolated"), 2e-2);
  EXPECT_GT(apart("rgba8", "interpolated"), 1e-4);
}

// ---- Backends and threads ----

TEST_F(Slices2dShaded, BackendsAgree) {
  Device other = make_device(backend_id() == "cpu" ? "gl" : "cpu");
  Scene engine = shipped_scene("engine");
  const auto expect_parity = [&](const Scene& scene, Settings settings) {
    std::string said;
    for (const auto& [name, value] : settings) said += fmt::format(" {}={}", name, value);
    const Image here = draw(device, scene, "slices2d_shaded", settings, scene.views[1], 96, 96).image;
    const Image there = draw(other, scene, "slices2d_shaded", settings, scene.views[1], 96, 96).image;
    const Parity agreement = parity(here, there);
    EXPECT_TRUE(agreement.agree) << said << ": interior " << agreement.interior_max << " at " << agreement.interior_x
                                 << ", " << agreement.interior_y;
    EXPECT_GT(agreement.interior_pixels, 0) << said;
  };
  expect_parity(engine, {});
  expect_parity(engine, {{"normals", "interpolated"}, {"gradient_format", "rgba8"}, {"opacity_correction", "linear"}});
  expect_parity(engine, {{"form", "separate"}, {"interpolation", "false"}, {"normals", "interpolated"}});
  expect_parity(engine, {{"form", "separate"}, {"gradient_format", "rgba16f"}, {"opacity_correction", "linear"}});
  expect_parity(engine, {{"form", "gradient"}, {"interpolation", "false"}});
  engine.effects.lighting->lights.resize(1);
  expect_parity(engine, {{"form", "gradient"}, {"normals", "interpolated"}, {"gradient_format", "rgba8"}});
}

TEST_F(Slices2dShaded, ThreadsDoNotChangeABit) {
  if (backend_id() != "cpu") return;
  const Scene scene = smooth_scene(diffuse_lights(0.2, 0.8, 2));
  for (const char* form : {"full", "separate"}) {
    std::vector<Image> images;
    for (const int threads : {1, 2, 5}) {
      DeviceOptions options;
      options.threads = threads;
      Device limited = make_device("cpu", options);
      images.push_back(draw(limited, scene, "slices2d_shaded", {{"form", form}}, scene.views[0], 200, 120).image);
    }
    EXPECT_EQ(images[0].rgba, images[1].rgba) << form;
    EXPECT_EQ(images[0].rgba, images[2].rgba) << form;
  }
}

// ---- What the combiners of the paper cannot do ----

TEST_F(Slices2dShaded, FormsRefuseWhatTheirRegistersDoNotHold) {
  const auto why = [&](const Scene& scene, Settings settings) -> std::string {
    try {
      picture(scene, settings, "slices2d_shaded", 8);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "drawn";
  };
  const Scene one = smooth_scene(diffuse_lights(0.2, 0.8, 1)), two = smooth_scene(diffuse_lights(0.2, 0.8, 2));
  const Scene point = smooth_scene(kBlinnPhong);
  EXPECT_EQ(why(one, {{"form", "gradient"}}), "drawn");
  EXPECT_NE(why(two, {{"form", "gradient"}}).find("registers for 1"), std::string::npos);
  EXPECT_EQ(why(two, {{"form", "gradient"}, {"interpolation", "false"}}), "drawn");
  EXPECT_EQ(why(two, {{"form", "separate"}}), "drawn");
  EXPECT_NE(why(point, {{"form", "separate"}}).find("point light"), std::string::npos);
  EXPECT_NE(why(smooth_scene(""), {{"form", "gradient"}}).find("calls for none"), std::string::npos);
  Scene three = two;
  three.effects.lighting->lights.push_back(three.effects.lighting->lights[0]);
  EXPECT_NE(why(three, {{"form", "separate"}}).find("registers for 2"), std::string::npos);
  EXPECT_EQ(why(three, {}), "drawn");
}

}  // namespace
}  // namespace volumark
