// What is particular to ray casting: that skipping empty space changes nothing, the closed form of the sphere, the
// bound of early termination, and pictures whose rows do not fill the packets of the cpu backend. What all volume
// methods have in common is tested in tests/images/methods.
#include <gtest/gtest.h>

#include <cmath>

#include "methods/reference/reference.h"
#include "tests/support/backend.h"
#include "tests/support/drawing.h"

namespace volumark {
namespace {

class RaycastImages : public testing::Test {
 protected:
  Image picture(const Scene& scene, Settings settings, int width = 96, int height = 96, size_t view = 0) {
    return draw(device, scene, "raycast", settings, scene.views.at(view), width, height).image;
  }
  Device device = make_device(backend_id(), device_options());
};

// Samples stay where they are and only transparent ones are left out, so that all sums are the same. Not bit for bit: a
// sample that rounding puts on the other side of a brick's face has an opacity of rounding size.
constexpr double kRounding = 2e-5;

TEST_F(RaycastImages, SkippingChangesNothing) {
  for (const char* name : {"engine", "brain", "ch2", "marschner_lobb", "cloud", "sphere", "slab"}) {
    const Scene scene = shipped_scene(name);
    for (const char* step : {"3", "0.7"}) {
      for (const char* classification : {"post", "preintegrated"}) {
        const Image all =
            picture(scene, {{"step", step}, {"classification", classification}, {"skip_empty", "none"}}, 48, 48);
        for (const char* brick : {"3", "16"}) {
          const Image skipped = picture(
              scene,
              {{"step", step}, {"classification", classification}, {"skip_empty", "bricks"}, {"brick_size", brick}}, 48,
              48);
          const Difference d = difference(all, skipped);
          EXPECT_LE(d.max, kRounding) << name << " step " << step << " " << classification << " bricks of " << brick
                                      << " at " << d.x << ", " << d.y;
        }
      }
    }
  }
}

TEST_F(RaycastImages, SkippingChangesNothingFromInside) {
  Scene scene = shipped_scene("cloud");
  View& view = scene.views[0];
  view.perspective = true;
  view.fov_y = 1.4;
  view.eye = {0.31, -0.52, 0.77};
  view.target = {-0.4, 0.2, -0.6};
  view.near = 1e-3;
  const Difference d = difference(picture(scene, {{"skip_empty", "none"}}), picture(scene, {{"skip_empty", "bricks"}}));
  EXPECT_LE(d.max, kRounding);
}

// Texture formats round values by up to half a step: bricks must be judged by what the texture holds.
TEST_F(RaycastImages, SkippingChangesNothingInCoarserTextures) {
  const Scene scene = shipped_scene("cloud");
  for (const char* format : {"r8", "r16", "r16f"}) {
    const Difference d = difference(picture(scene, {{"volume_format", format}, {"skip_empty", "none"}}),
                                    picture(scene, {{"volume_format", format}, {"skip_empty", "bricks"}}));
    EXPECT_LE(d.max, kRounding) << format;
  }
}

TEST_F(RaycastImages, SphereHasItsClosedForm) {
  const Scene scene = shipped_scene("sphere");
  constexpr int kSize = 128;
  constexpr double kRadius = 0.8, kTau = 1.25;
  const double spacing = 2.0 / 127;
  for (const char* step : {"1", "0.25"}) {
    const Image image = picture(scene, {{"step", step}}, kSize, kSize);
    double alpha = 0;
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const double px = (x + 0.5) / (kSize / 2) - 1, py = (y + 0.5) / (kSize / 2) - 1;
        const double b2 = px * px + py * py;
        const double got = static_cast<double>(image.pixel(x, y)[3]);
        alpha += got;
        // Near the rim the path's length changes faster than the surface's tolerance tells.
        if (std::abs(std::sqrt(b2) - kRadius) < 2 * spacing) continue;
        const double path = b2 < kRadius * kRadius ? 2 * std::sqrt(kRadius * kRadius - b2) : 0;
        // Each end of the path is missed by up to half a step; the table's jump (1020 intervals over 1.75) and the
        // trilinear distance (7.8e-5) move the surface, which a slanting ray meets 1 / cos later.
        const double slant = path > 0 ? kRadius / (path / 2) : 0;
        const double tolerance = kTau * (std::stod(step) * spacing + 2 * slant * (1.75 / 1020 + 8e-5));
        EXPECT_NEAR(got, -std::expm1(-kTau * path), tolerance + 1e-6) << "pixel " << x << ", " << y << " step " << step;
      }
    }
    // Over the disc these errors average out.
    constexpr double kPi = 3.14159265358979323846;
    const double covered = kPi * kRadius * kRadius * (kSize / 2) * (kSize / 2);
    EXPECT_NEAR(alpha / covered, 1 - 0.2969970751, 3e-3) << "step " << step;
  }
}

TEST_F(RaycastImages, EarlyTerminationErrsWithinItsBound) {
  const Scene scene = shipped_scene("ch2");
  const Image all = picture(scene, {{"early_termination", "0"}});
  // Lit, so emission may exceed 1; its largest value is that of the lights' sum.
  double brightest = 0;
  for (const float value : all.rgba) brightest = std::max(brightest, static_cast<double>(value));
  const Image early = picture(scene, {{"early_termination", "0.05"}});
  const Difference d = difference(all, early);
  EXPECT_GT(d.max, 0) << "nothing ended early";
  EXPECT_LE(d.max, 0.05 * 1.5 * brightest);
  EXPECT_LE(difference(all, picture(scene, {})).max, 1.5 * brightest / 4096);
}

TEST_F(RaycastImages, SizesThatFillNoPacketShowTheSamePixels) {
  // Pixels of a small picture lie on those of one with three times as many a side.
  const Scene scene = shipped_scene("marschner_lobb");
  for (const int size : {1, 2, 5, 31, 33}) {
    const Image small = picture(scene, {}, size, size);
    const Image large = picture(scene, {}, 3 * size, 3 * size);
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        for (int c = 0; c < 4; ++c) {
          ASSERT_NEAR(small.pixel(x, y)[c], large.pixel(3 * x + 1, 3 * y + 1)[c], 2e-4f)
              << "size " << size << ", pixel " << x << ", " << y;
        }
      }
    }
  }
}

TEST_F(RaycastImages, VolumeFormatsConvergeToTheReference) {
  const Scene scene = shipped_scene("cloud");
  const Image reference = render_reference(scene, scene.views[0], 64, 64).image;
  const auto rmse = [&](const char* format) {
    return difference(picture(scene, {{"step", "0.5"}, {"volume_format", format}}, 64, 64), reference).rmse;
  };
  EXPECT_LE(rmse("native"), 2e-4);
  EXPECT_LE(rmse("r16"), 2e-4);
  EXPECT_LE(rmse("r16f"), 5e-4);
  EXPECT_LE(rmse("r8"), 1e-2);
}

}  // namespace
}  // namespace volumark
