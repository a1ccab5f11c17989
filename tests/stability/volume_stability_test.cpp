// Hard cases of volume methods: pictures that must not depend on the size and place of the scene, must follow the
// camera in proportion, and must stall just where 8 bits do.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/support/backend.h"
#include "tests/support/drawing.h"

namespace volumark {
namespace {

constexpr int kSize = 64;

class Stability : public testing::TestWithParam<const char*> {
 protected:
  Image picture(const Scene& scene, const View& view) {
    return draw(device, scene, GetParam(), {{"step", "1"}}, view, kSize, kSize).image;
  }
  Device device = make_device(backend_id(), device_options());
};
INSTANTIATE_TEST_SUITE_P(Each, Stability, testing::Values("texture3d_slices", "raycast"),
                         [](const auto& tested) { return std::string(tested.param); });

Scene cloud_in_perspective() {
  return scene_from_text(R"({
    "volumark_scene": 1, "title": "cloud",
    "volume": {"generator": {"kind": "perlin_cloud", "size": 32, "type": "f32", "seed": 7, "octaves": 2, "frequency": 2}},
    "transfer": {"points": [{"value": 0.1, "colour": [0.2, 0.4, 1], "extinction": 0},
                            {"value": 1, "colour": [1, 0.6, 0.2], "extinction": 6}], "window": [0, 1]},
    "views": [{"orbit": {"count": 2, "azimuth": 30, "elevation": 20, "distance": 3.2, "fov_y": 40, "units": "world",
                         "target": [0, 0, 0]}}]})");
}

// The same scene, `scale` times as large, its origin at `place`; optical depths stay what they are.
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

// Case 16. The host works in double precision in a frame at the volume's centre, so what is left is float rounding that
// falls differently: a sample's place is good to 2^-20 of the box (plane equations of small polygons), the field
// changes by at most 20 over the box and the extinction by 6 a unit of value, over a path of one unit: 1.1e-4.
constexpr double kPlaceBound = 0x1p-20 * 20 * 6;

TEST_P(Stability, Case16ScaleAndPlaceDoNotMatter) {
  const Scene scene = cloud_in_perspective();
  const Image base = picture(scene, scene.views[0]);
  for (const double scale : {1e-6, 1e6}) {
    const Scene other = transformed(scene, scale, glm::dvec3(0));
    EXPECT_LE(difference(picture(other, other.views[0]), base).max, kPlaceBound) << "scale " << scale;
  }
  const Scene moved = transformed(scene, 1, {1e6, -1e6, 1e6});
  EXPECT_LE(difference(picture(moved, moved.views[0]), base).max, kPlaceBound);
}

// Case 24. The camera moves by 1e-6 of the scene's size in 16 directions: no pixel may change by more than twenty times
// its share of the largest change under a hundred times the motion, plus float rounding.
TEST_P(Stability, Case24ThePictureFollowsTheCameraInProportion) {
  const Scene scene = cloud_in_perspective();
  const View& view = scene.views[0];
  const Image base = picture(scene, view);
  const auto change = [&](double distance, int k) {
    const double azimuth = 2 * std::numbers::pi * k / 16, height = std::sin(1.7 * k);
    const glm::dvec3 motion = distance * glm::dvec3(std::cos(azimuth) * std::cos(height), std::sin(height),
                                                    std::sin(azimuth) * std::cos(height));
    View other = view;
    other.eye += motion;
    other.target += motion;
    return difference(picture(scene, other), base);
  };
  double coarse = 0;
  for (int k = 0; k < 16; ++k) coarse = std::max(coarse, change(2e-4, k).max);
  ASSERT_GT(coarse, 0);
  for (int k = 0; k < 16; ++k) {
    const Difference d = change(2e-6, k);
    EXPECT_LE(d.max, 20 * coarse / 100 + 2e-5) << "direction " << k << ", worst pixel " << d.x << ", " << d.y;
  }
}

// Case 9. White blended over itself in 8 bits: a slab of optical depth 1 in 256 slices stalls where the product takes
// back what a layer of 1/255 adds: at ceil(255 - 127.5) = 128. In 512 slices a layer is below half a level: 0. Exact:
// 161.19. GPUs that do not round the layer itself to 1/255 first may stall at 127, above (255 a - 1/2) / a levels.
TEST(EightBits, Case9AccumulationStalls) {
  Device device = make_device(backend_id(), device_options());
  Scene scene = shipped_scene("slab");
  const auto level = [&](const char* step) {
    const Image image =
        draw(device, scene, "texture3d_slices", {{"step", step}, {"target_format", "rgba8"}}, scene.views[0], 32, 32)
            .image;
    return std::lround(255 * image.pixel(16, 16)[0]);
  };
  const long of_256 = level("0.0625"), of_512 = level("0.03125");
  std::printf("8 bits, slab of optical depth 1: 256 slices give %ld, 512 give %ld (exact 161)\n", of_256, of_512);
  if (device.info().software) {
    EXPECT_EQ(of_256, 128);
    EXPECT_EQ(of_512, 0);
  } else {
    EXPECT_LE(of_256, 128);
    EXPECT_LE(of_512, of_256);
  }
}

}  // namespace
}  // namespace volumark
