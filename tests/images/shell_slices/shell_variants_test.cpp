// The three variants of lensch2002 draw the same picture; on one backend, and on this one and cpu.
#include <gtest/gtest.h>

#include "backends/device.h"
#include "tests/images/shell_slices/shell_drawing.h"
#include "tests/support/backend.h"
#include "tests/unit/shell_slices/hand_made.h"

namespace volumark {
namespace {

constexpr int kSize = 96;
constexpr const char* kPlanes = "80";

// A texture that differs everywhere, with empty and opaque texels.
Shell painted_torus() {
  Shell shell = torus_shell(24, 12, 1, .4, .1);
  auto colours = std::make_shared<ShellTexture>();
  colours->size = {16, 12, 8};
  for (int i = 0; i < 16 * 12 * 8; ++i) {
    const float tau = i % 3 == 0 ? 0.F : static_cast<float>(i % 17) * 2.F;
    colours->texels.push_back(tau * glm::vec4(static_cast<float>(i % 5) / 4, static_cast<float>(i % 7) / 6, .5F, 1.F));
  }
  shell.colours = colours;
  return shell;
}

View view_from(const glm::dvec3& eye, bool perspective) {
  View view;
  view.eye = eye;
  view.up = {.1, .2, 1};
  view.perspective = perspective;
  view.fov_y = .75;
  view.half_height = 1.6;
  view.near = perspective ? .01 : -10;
  return view;
}

const std::vector<View>& views() {
  static const std::vector<View> list = {
      view_from({3, 2, 2.5}, true), view_from({0, 0, 4}, true), view_from({4, 0, 0}, false),
      view_from({1.1, .1, .2}, true),  // in the torus
  };
  return list;
}

class ShellVariants : public testing::Test {
 protected:
  Device device = make_device(backend_id(), device_options());
};

// Where programs round as the host does, all variants hand the same corners to the rasterizer. Those of the drivers may
// differ by a few roundings of a division, which can move a corner by one step of the sub-pixel grid (1/256), and so
// a pixel at the edge of a slice from one polygon to the next, with texture coordinates that differ by a sub-pixel:
// no pixel is lost, and few change at all.
TEST_F(ShellVariants, DrawTheSamePicture) {
  const Scene scene = scene_of(painted_torus());
  const bool exact = backend_id() == "cpu";
  for (const View& view : views()) {
    const ShellPicture software =
        draw_shell(device, shell_software(), scene, {{"planes", kPlanes}}, view, kSize, kSize);
    double largest = 0;
    for (const float c : software.image.rgba) largest = std::max(largest, static_cast<double>(c));
    ASSERT_GT(largest, .2);
    const auto compare = [&](const char* what, const Method& method, Settings settings) {
      const ShellPicture other = draw_shell(device, method, scene, settings, view, kSize, kSize);
      const ShellDifference d = difference(software.image, other.image, 1e-4);
      std::printf("%s: largest difference %.2g, %d pixels over 1e-4\n", what, d.max, d.over);
      if (exact) {
        EXPECT_EQ(d.max, 0) << what;
      } else {
        EXPECT_LE(d.max, 2e-3) << what;
        EXPECT_LE(d.over, kSize * kSize / 1000) << what;
      }
      return other.counters;
    };
    const Counters shared = compare("hybrid, shared", shell_hybrid(), {{"planes", kPlanes}});
    const Counters own = compare("hybrid, own", shell_hybrid(), {{"planes", kPlanes}, {"share_edges", "false"}});
    const Counters hardware = compare("hardware, select", shell_hardware(), {{"planes", kPlanes}});
    compare("hardware, branch", shell_hardware(), {{"planes", kPlanes}, {"selection", "branch"}});
    if (&view == &views().front()) {
      for (const char* reject : {"none", "spheres"}) {
        compare("software, reject", shell_software(), {{"planes", kPlanes}, {"reject", reject}});
        compare("hybrid, reject", shell_hybrid(), {{"planes", kPlanes}, {"reject", reject}});
        compare("hardware, reject", shell_hardware(), {{"planes", kPlanes}, {"reject", reject}});
      }
    }
    for (const char* name : {"triangles", "quadrilaterals", "pentagons"}) {
      EXPECT_EQ(shared.at(name), software.counters.at(name));
      EXPECT_EQ(own.at(name), software.counters.at(name));
    }
    EXPECT_EQ(own.at("vertex_bytes"), 243 * 1024);       // lensch2002: 243 kB
    EXPECT_EQ(hardware.at("vertex_bytes"), 486 * 1024);  // 486 kB
    EXPECT_EQ(software.counters.at("draws"), 1);
    EXPECT_EQ(shared.at("draws"), 1);
    EXPECT_EQ(hardware.at("draws"), 1);
  }
}

TEST_F(ShellVariants, DrawTheSameLitPicture) {
  Scene scene = scene_of(painted_torus());
  scene.effects.lighting.emplace();
  scene.effects.lighting->specular = .4;
  scene.effects.lighting->lights = {{Light::Kind::Directional, {.6, 0, .8}, {1, .9, .8}},
                                    {Light::Kind::Point, {1, 2, 2}, {.3, .4, .5}}};
  Device cpu = make_device("cpu", device_options());
  const View& view = views().front();
  const ShellPicture software = draw_shell(device, shell_software(), scene, {{"planes", kPlanes}}, view, kSize, kSize);
  const ShellPicture hybrid = draw_shell(device, shell_hybrid(), scene, {{"planes", kPlanes}}, view, kSize, kSize);
  const ShellPicture select = draw_shell(device, shell_hardware(), scene, {{"planes", kPlanes}}, view, kSize, kSize);
  const ShellPicture branch =
      draw_shell(device, shell_hardware(), scene, {{"planes", kPlanes}, {"selection", "branch"}}, view, kSize, kSize);
  const ShellPicture there = draw_shell(cpu, shell_hybrid(), scene, {{"planes", kPlanes}}, view, kSize, kSize);
  for (const ShellPicture* other : {&hybrid, &select, &branch, &there}) {
    const ShellDifference d = difference(software.image, other->image, 2e-3);
    std::printf("largest difference %.2g, %d pixels over 2e-3\n", d.max, d.over);
    EXPECT_LE(d.over, kSize * kSize / 1000);
  }
  scene.effects.lighting.reset();
  const ShellPicture dark = draw_shell(device, shell_hybrid(), scene, {{"planes", kPlanes}}, view, kSize, kSize);
  EXPECT_GT(difference(software.image, dark.image, .05).over, 100);
}

TEST_F(ShellVariants, AgreeWithCpu) {
  const Scene scene = scene_of(painted_torus());
  Device cpu = make_device("cpu", device_options());
  for (const View& view : views()) {
    const ShellPicture here = draw_shell(device, shell_software(), scene, {{"planes", kPlanes}}, view, kSize, kSize);
    const ShellPicture there = draw_shell(cpu, shell_software(), scene, {{"planes", kPlanes}}, view, kSize, kSize);
    const ShellDifference d = difference(here.image, there.image, 2e-3);
    std::printf("largest difference %.2g, %d pixels over 2e-3\n", d.max, d.over);
    EXPECT_LE(d.over, kSize * kSize / 1000);  // hard case 25: at silhouettes, .1 % of the pixels
  }
}

TEST_F(ShellVariants, LeaveNothingOnTheDevice) {
  const Scene scene = scene_of(painted_torus());
  for (const Method* method : {&shell_software(), &shell_hybrid(), &shell_hardware()}) {
    draw_shell(device, *method, scene, {{"planes", "3"}}, views()[0], 16, 16);
    EXPECT_EQ(device.live_bytes(), 0U);
  }
}

// A shell none of whose prisms can be drawn, and one behind the eye: an empty picture.
TEST_F(ShellVariants, DrawNothingWhereThereIsNothing) {
  const Scene flat = scene_of(one_prism(1, {0, 0, 0})), torus = scene_of(painted_torus());
  const View away = [] {
    View view = view_from({3, 2, 2.5}, true);
    view.target = {6, 4, 5};
    return view;
  }();
  for (const Method* method : {&shell_software(), &shell_hybrid(), &shell_hardware()}) {
    for (const char* reject : {"none", "spheres", "active_list"}) {
      for (const auto& [scene, view] : {std::pair(&flat, &views()[0]), std::pair(&torus, &away)}) {
        const ShellPicture picture = draw_shell(device, *method, *scene, {{"reject", reject}}, *view, 16, 16);
        for (const float c : picture.image.rgba) EXPECT_EQ(c, 0);
      }
    }
  }
}

}  // namespace
}  // namespace volumark
