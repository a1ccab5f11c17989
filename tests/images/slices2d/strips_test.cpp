// Slices of any direction through 2D textures (rezksalama2000, section 9): strips between stored slices are trilinear
// interpolation, which 3D textures show for viewport-aligned slices, and a computation on the host for a single one.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>

#include "tests/support/backend.h"
#include "tests/support/drawing.h"

namespace volumark {
namespace {

constexpr int kPicture = 64;

// Places of samples: a few roundings of a ray's, and of corners' over a picture of 64 pixels, of the box (docs/
// stability.md: n 2^-23).
constexpr double kPlace = (kPicture + 4) * 0x1p-23;

// Noise in [0, 1): neighbours have nothing in common, and any mistaken slice, weight or place shows.
Scene noise_scene(const glm::ivec3& size, const std::string& view) {
  Scene scene = scene_from_text(fmt::format(R"({{
    "volumark_scene": 1, "title": "noise",
    "volume": {{"generator": {{"kind": "constant", "size": [{}, {}, {}], "type": "f32", "value": 0}}}},
    "transfer": {{"points": [{{"value": 0, "colour": [0.1, 0.3, 0.9], "extinction": 0.3}},
                             {{"value": 1, "colour": [0.9, 0.6, 0.1], "extinction": 1.3}}], "window": [0, 1]}},
    "views": [{}]}})",
                                            size.x, size.y, size.z, view));
  auto volume = std::make_shared<Volume>(*scene.volume);
  std::mt19937 random(7);
  std::vector<float> values(volume->voxels.size() / sizeof(float));
  for (float& value : values) value = static_cast<float>(random()) * 0x1p-32F;
  std::memcpy(volume->voxels.data(), values.data(), volume->voxels.size());
  volume->min_value = 0;
  volume->max_value = 1;
  scene.volume = volume;
  return scene;
}
std::string from(const char* eye, const char* more = R"("fov_y": 45)") {
  return fmt::format(R"({{"eye": {}, "target": [0, 0, 0], "up": [0, 1, 0.01], "units": "world", {}}})", eye, more);
}
const char* const kOrthographic = R"("half_height": 1.7)";

// What kPlace may change of a value in noise: each axis by a whole range a voxel.
double value_error(const Volume& volume) {
  const glm::dvec3 cells(volume.size - 1);
  return kPlace * (cells.x + cells.y + cells.z);
}

// ---- Viewport-aligned slices ----

class Strips : public testing::Test {
 protected:
  Device device = make_device(backend_id(), device_options());
};

struct Pair {
  Image strips, texture3d;
};
Pair both(Device& device, const Scene& scene, Settings settings) {
  const View& view = scene.views.at(0);
  return {draw(device, scene, "slices2d_viewport", settings, view, kPicture, kPicture).image,
          draw(device, scene, "texture3d_slices", settings, view, kPicture, kPicture).image};
}

TEST_F(Strips, AreTheSlicesOfA3dTexture) {
  // A colour's change: the optical depth of the longest ray (the diagonal of a box of at most 2 units) times the change
  // of extinction (1 a unit of value), and as much for the colours.
  const double diagonal = 2 * std::sqrt(3.);
  for (const char* view : {"[1.1, 0.9, 3]", "[-3, 0.4, 0.9]", "[0.4, 3, -2.9]", "[0, 0, 3]", "[2.5, 0, 2.5]"}) {
    for (const char* more : {R"("fov_y": 45)", kOrthographic}) {
      const Scene scene = noise_scene({17, 13, 15}, from(view, more));
      for (const char* step : {"1", "0.4"}) {
        const Pair pair = both(device, scene, {{"step", step}});
        const Difference d = difference(pair.strips, pair.texture3d);
        const double bound = 2 * diagonal * value_error(*scene.volume) + 100 * 0x1p-23;
        EXPECT_LE(d.max, bound) << view << " " << more << " step " << step << " at " << d.x << ", " << d.y;
        // Few pixels are of polygons one pixel wide, and roundings have both signs.
        EXPECT_LE(d.rmse, bound / 500) << view << " " << more << " step " << step;
      }
    }
  }
}

TEST_F(Strips, AreTheSlicesOfA3dTextureInEverySetting) {
  const Scene scene = noise_scene({17, 13, 15}, from("[1.1, 0.9, 3]"));
  const double bound = 4 * std::sqrt(3.) * value_error(*scene.volume) + 100 * 0x1p-23;
  for (const char* name : {"order=front_to_back", "opacity_correction=linear", "classification=pre"}) {
    const std::string text = name, parameter = text.substr(0, text.find('=')), value = text.substr(text.find('=') + 1);
    const Pair pair = both(device, scene, {{parameter.c_str(), value.c_str()}});
    const Difference d = difference(pair.strips, pair.texture3d);
    EXPECT_LE(d.max, bound) << name << " at " << d.x << ", " << d.y;
  }
  const Image corners = both(device, scene, {}).strips;
  const Image pixels =
      draw(device, scene, "slices2d_viewport", {{"weights", "pixels"}}, scene.views[0], kPicture, kPicture).image;
  EXPECT_LE(difference(corners, pixels).max, bound);
}

// Plain slices end where rasterizers have it, who move corners to grids of 1/256 of a pixel, and a strip has other
// corners than the whole slice: a sample may be gained or lost in pixels that an edge passes so near. 25 slices of at
// most 150 pixels around have 25 * 150 * 2 / 256 such pixels.
TEST_F(Strips, ArePlainSlicesOfA3dTextureButForTheirEdges) {
  const Scene scene = noise_scene({17, 13, 15}, from("[1.1, 0.9, 3]"));
  const double bound = 4 * std::sqrt(3.) * value_error(*scene.volume) + 100 * 0x1p-23;
  const Pair pair = both(device, scene, {{"end_slabs", "full"}});
  // Along rays of the picture, at most 22.5 degrees (and the frame's corners) from the view's direction.
  const double slab = -std::expm1(-1.3 * scene.volume->spacing.x / 0.85);
  int at_edges = 0;
  for (size_t i = 0; i < pair.strips.rgba.size(); i += 4) {
    double apart = 0;
    for (size_t c = 0; c < 4; ++c)
      apart = std::max(apart, std::abs(static_cast<double>(pair.strips.rgba[i + c]) -
                                       static_cast<double>(pair.texture3d.rgba[i + c])));
    EXPECT_LE(apart, slab);
    at_edges += apart > bound ? 1 : 0;
  }
  EXPECT_LE(at_edges, 29);
}

TEST_F(Strips, AreTheSlicesOfA3dTextureFromInsideAndUnderClipPlanes) {
  Scene scene = noise_scene({17, 13, 15}, from("[0.1, 0.2, 0.4]", R"("fov_y": 70)"));
  const double bound = 4 * std::sqrt(3.) * value_error(*scene.volume) + 100 * 0x1p-23;
  const Pair inside = both(device, scene, {});
  EXPECT_LE(difference(inside.strips, inside.texture3d).max, bound);
  scene.views = noise_scene({2, 2, 2}, from("[1.1, 0.9, 3]")).views;
  scene.effects.clip_planes = {{glm::normalize(glm::dvec3(1, 0.3, 0.2)), -0.3},
                               {glm::normalize(glm::dvec3(-0.2, 1, -0.5)), -0.4}};
  const Pair cut = both(device, scene, {});
  EXPECT_LE(difference(cut.strips, cut.texture3d).max, bound);
}

TEST_F(Strips, OfSeveralPagesMeetWithoutASeam) {
  // 256 slices of 258 x 258 texels: two pages a stack, and slabs of 24 voxels, whose cut ends lie far from their slice.
  const Scene scene = scene_from_text(R"({
    "volumark_scene": 1, "title": "pages",
    "volume": {"generator": {"kind": "ramp", "size": 256, "type": "u8", "axis": "z", "from": 0, "to": 255}},
    "transfer": {"points": [{"value": 0, "colour": [0, 0.2, 1], "extinction": 0.2},
                            {"value": 255, "colour": [1, 0.4, 0], "extinction": 2}], "window": [0, 255]},
    "views": [{"eye": [0.4, 0.7, 4], "target": [0, 0, 0], "up": [0, 1, 0], "units": "world", "fov_y": 40}]})");
  for (const char* step : {"24", "3"}) {
    const Pair pair = both(device, scene, {{"step", step}});
    // 8-bit filters of drivers have weights of 8 bits: on this ramp half a level of 255 of 256.
    EXPECT_LE(difference(pair.strips, pair.texture3d).max, 1e-3) << step;
  }
  const Drawing drawing = draw(device, scene, "slices2d_viewport", {{"step", "24"}}, scene.views[0], 32, 32);
  EXPECT_GT(drawing.counters.at("draws"), 1);
  EXPECT_LE(drawing.counters.at("draws"), 2 * drawing.counters.at("polygons"));
}

TEST_F(Strips, AreCounted) {
  // Slices in the direction of the stored ones: each in one strip, four corners. Turned, the strips are many.
  const Scene along = noise_scene({16, 16, 16}, from("[0, 0, 3]", kOrthographic));
  const auto counters = [&](const Scene& scene) {
    return draw(device, scene, "slices2d_viewport", {}, scene.views[0], 32, 32).counters;
  };
  const Counters straight = counters(along);
  EXPECT_EQ(straight.at("slices"), 15);
  EXPECT_EQ(straight.at("strips"), 15);
  EXPECT_EQ(straight.at("draws"), 1);
  const Counters turned = counters(noise_scene({16, 16, 16}, from("[2, 1, 3]", kOrthographic)));
  EXPECT_GT(turned.at("strips"), 4 * turned.at("polygons"));
}

// ---- One slice ----

double voxel(const Volume& volume, const glm::ivec3& p) {
  float value = 0;
  const auto at = static_cast<size_t>(p.x + volume.size.x * (p.y + volume.size.y * p.z));
  std::memcpy(&value, volume.voxels.data() + 4 * at, 4);
  return static_cast<double>(value);
}

// Trilinear at lattice coordinates.
double interpolated(const Volume& volume, const glm::dvec3& at) {
  const glm::dvec3 inside = glm::clamp(at, glm::dvec3(0), glm::dvec3(volume.size - 1));
  const glm::ivec3 base = glm::min(glm::ivec3(inside), glm::max(volume.size - 2, glm::ivec3(0)));
  const glm::dvec3 f = inside - glm::dvec3(base);
  double sum = 0;
  for (int i = 0; i < 8; ++i) {
    const glm::ivec3 bit(i & 1, (i >> 1) & 1, i >> 2);
    const glm::dvec3 w = glm::mix(1. - f, f, glm::dvec3(bit));
    sum += w.x * w.y * w.z * voxel(volume, glm::min(base + bit, volume.size - 1));
  }
  return sum;
}

struct Hit {
  bool inside = false;
  glm::dvec3 lattice;
  double slant = 0;  // of the ray against the plane, cosine
};
Hit hit_of(const Scene& scene, double x, double y) {
  const Volume& volume = *scene.volume;
  const Ray ray = pixel_ray(scene.views[0], kPicture, kPicture, x, y);
  Hit hit;
  const double slope = glm::dot(scene.slice_plane->normal, ray.direction);
  hit.slant = std::abs(slope);
  if (hit.slant < 1e-9) return hit;
  const double t = glm::dot(scene.slice_plane->normal, scene.slice_plane->point - ray.origin) / slope;
  const glm::dvec3 p = ray.origin + t * ray.direction;
  hit.lattice = (glm::transpose(volume.axes) * (p - volume.origin)) / volume.spacing;
  const glm::dvec3 last(volume.size - 1);
  hit.inside = t >= ray.t_near && glm::all(glm::greaterThanEqual(hit.lattice, glm::dvec3(0))) &&
               glm::all(glm::lessThanEqual(hit.lattice, last));
  for (const ClipPlane& plane : scene.effects.clip_planes)
    hit.inside = hit.inside && glm::dot(plane.normal, p) >= plane.distance;
  return hit;
}

// Every pixel against the host: exactly nothing outside, the colour of the interpolated value inside. A rasterizer
// moves corners by up to 1/256 of a pixel: where a hundredth of a pixel decides, either is right. Returns the pixels
// inside.
int expect_slice(const Image& image, const Scene& scene, double (*value_at)(const Volume&, const glm::dvec3&)) {
  int inside = 0;
  for (int y = 0; y < kPicture; ++y) {
    for (int x = 0; x < kPicture; ++x) {
      const Hit hit = hit_of(scene, x, y);
      const float* pixel = image.pixel(x, y);
      bool decided = true;
      for (const auto& [dx, dy] : {std::pair(.01, 0.), {-.01, 0.}, {0., .01}, {0., -.01}})
        decided = decided && hit_of(scene, x + dx, y + dy).inside == hit.inside;
      if (!decided) continue;
      if (!hit.inside) {
        for (int c = 0; c < 4; ++c) EXPECT_EQ(pixel[c], 0) << x << ", " << y;
        continue;
      }
      ++inside;
      const glm::dvec4 expected = scene.transfer.at(value_at(*scene.volume, hit.lattice));
      // Colours change by less than 1 a unit of value; a place on the plane moves by 1 / slant.
      const double bound = value_error(*scene.volume) / hit.slant + 0x1p-20;
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], expected[c], bound) << x << ", " << y;
      EXPECT_EQ(pixel[3], 1) << x << ", " << y;
      if (::testing::Test::HasFailure()) return inside;
    }
  }
  return inside;
}

class SliceMpr : public Strips {
 protected:
  Scene scene_of(const char* eye, const glm::dvec3& normal, const glm::dvec3& point,
                 const char* more = R"("fov_y": 45)", const glm::ivec3& size = {17, 13, 15}) {
    Scene scene = noise_scene(size, from(eye, more));
    scene.slice_plane = SlicePlane{point, glm::normalize(normal)};
    scene.display = Display::SlicePlane;
    return scene;
  }
  Drawing drawn(const Scene& scene, Settings settings = {}) {
    return draw(device, scene, "slice_mpr", settings, scene.views[0], kPicture, kPicture);
  }
};

TEST_F(SliceMpr, IsTrilinearInterpolation) {
  for (const char* more : {R"("fov_y": 45)", kOrthographic}) {
    for (const glm::dvec3& normal : {glm::dvec3(0.3, 0.4, 1), glm::dvec3(1, 0.2, 0.1), glm::dvec3(-0.1, 1, 0.6),
                                     glm::dvec3(1, 1, 1), glm::dvec3(1, 0, 1)}) {
      const Scene scene = scene_of("[1.1, 0.9, 3]", normal, {0.05, 0.02, -0.07}, more);
      for (const char* weights : {"corners", "pixels"}) {
        SCOPED_TRACE(fmt::format("{} {} normal {} {} {}", more, weights, normal.x, normal.y, normal.z));
        EXPECT_GT(expect_slice(drawn(scene, {{"weights", weights}}).image, scene, interpolated), 300);
      }
    }
  }
}

TEST_F(SliceMpr, AlongStoredSlices) {
  // 15 samples over 2 units: z = 0 is on the eighth, 1 on the last face of the box.
  for (const double z : {0., 1., -1., 0.07}) {
    const Scene scene = scene_of("[1.1, 0.9, 3]", {0, 0, 1}, {0, 0, z}, R"("fov_y": 45)", {15, 15, 15});
    const Drawing drawing = drawn(scene);
    EXPECT_EQ(drawing.counters.at("strips"), 1) << z;
    EXPECT_EQ(drawing.counters.at("stack_axis"), 2);
    EXPECT_GT(expect_slice(drawing.image, scene, interpolated), 300) << z;
  }
}

TEST_F(SliceMpr, TakesTheStackOfTheFewestStrips) {
  EXPECT_EQ(drawn(scene_of("[1.1, 0.9, 3]", {1, 0.1, 0.2}, {0, 0, 0})).counters.at("stack_axis"), 0);
  EXPECT_EQ(drawn(scene_of("[1.1, 0.9, 3]", {0.2, 1, 0.1}, {0, 0, 0})).counters.at("stack_axis"), 1);
}

TEST_F(SliceMpr, WithoutInterpolationIsTheNearestStoredSlice) {
  const Scene scene = scene_of("[1.1, 0.9, 3]", {0, 0.02, 1}, {0, 0, 0.31}, R"("fov_y": 45)", {15, 15, 15});
  const Drawing drawing = drawn(scene, {{"interpolation", "false"}});
  EXPECT_EQ(drawing.counters.at("stack_axis"), 2);
  EXPECT_EQ(drawing.counters.at("strips"), 1) << "all of it nearest to one slice";
  const auto nearest = [](const Volume& volume, const glm::dvec3& at) {
    return interpolated(volume, {at.x, at.y, std::floor(at.z + 0.5)});
  };
  EXPECT_GT(expect_slice(drawing.image, scene, nearest), 300);
}

TEST_F(SliceMpr, PreClassifiedColoursAreInterpolated) {
  const Scene scene = scene_of("[1.1, 0.9, 3]", {0.3, 0.4, 1}, {0, 0, 0});
  // With colours that are linear in the value the order of both does not matter.
  EXPECT_GT(expect_slice(drawn(scene, {{"classification", "pre"}}).image, scene, interpolated), 300);
}

TEST_F(SliceMpr, OutsideAndFromItsEdgeIsNothing) {
  for (const Scene& scene :
       {scene_of("[1.1, 0.9, 3]", {0, 0, 1}, {0, 0, 1.5}), scene_of("[0, 0, 3]", {1, 0, 0}, {0.2, 0, 0}, kOrthographic),
        scene_of("[0.5, 0.6, 3]", {0.6, -0.5, 0}, {0, 0, 0}), scene_of("[0, 0, 0.4]", {1, 0, 0}, {0, 0, 0})}) {
    for (const float value : drawn(scene).image.rgba) ASSERT_EQ(value, 0.F);
  }
}

TEST_F(SliceMpr, FromInsideAndUnderClipPlanes) {
  const Scene inside = scene_of("[0.1, 0.5, 0.4]", {0.1, 1, 0.2}, {0, -0.2, 0}, R"("fov_y": 70)");
  EXPECT_GT(expect_slice(drawn(inside).image, inside, interpolated), 300);
  Scene cut = scene_of("[1.1, 0.9, 3]", {0.3, 0.4, 1}, {0, 0, 0});
  cut.effects.clip_planes = {{glm::normalize(glm::dvec3(1, 0.3, 0)), -0.2}, {{0, -1, 0}, -0.5}};
  const int all = expect_slice(drawn(scene_of("[1.1, 0.9, 3]", {0.3, 0.4, 1}, {0, 0, 0})).image,
                               scene_of("[1.1, 0.9, 3]", {0.3, 0.4, 1}, {0, 0, 0}), interpolated);
  const int left = expect_slice(drawn(cut).image, cut, interpolated);
  EXPECT_GT(left, 100);
  EXPECT_LT(left, all);
}

TEST_F(SliceMpr, OfAThinVolume) {
  for (const glm::ivec3& size : {glm::ivec3(9, 9, 1), glm::ivec3(1, 9, 9), glm::ivec3(1, 1, 1), glm::ivec3(2, 2, 2)}) {
    const Scene scene = scene_of("[1.1, 0.9, 3]", {0.2, 0.3, 1}, {0, 0, 0}, R"("fov_y": 45)", size);
    const Image image = drawn(scene).image;
    for (const float value : image.rgba) ASSERT_TRUE(std::isfinite(value) && value >= 0 && value <= 1) << size.x;
    EXPECT_EQ(image.pixel(kPicture / 2, kPicture / 2)[3], 1) << size.x << size.y << size.z;
  }
}

TEST_F(SliceMpr, ThreadsDoNotChangeABit) {
  if (backend_id() != "cpu") return;
  const Scene mpr = scene_of("[1.1, 0.9, 3]", {0.3, 0.4, 1}, {0, 0, 0});
  const Scene viewport = noise_scene({17, 13, 15}, from("[1.1, 0.9, 3]"));
  std::vector<std::vector<float>> pictures[2];
  for (const int threads : {1, 2, 5}) {
    DeviceOptions options;
    options.threads = threads;
    Device limited = make_device("cpu", options);
    pictures[0].push_back(draw(limited, mpr, "slice_mpr", {}, mpr.views[0], 200, 120).image.rgba);
    pictures[1].push_back(draw(limited, viewport, "slices2d_viewport", {}, viewport.views[0], 200, 120).image.rgba);
  }
  for (const auto& picture : pictures) {
    EXPECT_EQ(picture[0], picture[1]);
    EXPECT_EQ(picture[0], picture[2]);
  }
}

}  // namespace
}  // namespace volumark
