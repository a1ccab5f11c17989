// Ray profiles against closed forms, on the cpu backend.
#include "harness/probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "harness/probe_output.h"
#include "scenes/scene_io.h"

namespace volumark {
namespace {

class ProbeTest : public testing::Test {
 protected:
  ProbeTest() {
    scene = load_scene("slab");  // extinction 2, z from -.25 to .25
    load_data(scene, data_options_from_environment());
  }
  ProbeSubject subject(const std::string& name, std::initializer_list<std::pair<const char*, const char*>> settings) {
    const Method& method = find_method(name);
    Values values = default_values(method.info().parameters);
    for (const auto& [key, value] : settings) set_value(method.info().parameters, values, key, std::string(value));
    return {name, &method, std::move(values)};
  }
  Probe run(const std::vector<ProbeSubject>& subjects) {
    return probe(scene, scene.views[0], subjects, &device, options);
  }
  void expect_error(const std::vector<ProbeSubject>& subjects, const std::string& part) {
    try {
      run(subjects);
      ADD_FAILURE() << "no error; expected " << part;
    } catch (const ProbeError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }

  Device device = make_device("cpu", {});
  Scene scene;
  ProbeOptions options{.width = 32, .height = 32, .x = 16, .y = 16, .depths = 9};
};

TEST_F(ProbeTest, TransmittanceOfASlabIsAnExponential) {
  options.threshold = 1e-5;
  const Probe result =
      run({subject("raycast", {{"step", "3"}}), subject("texture3d_slices", {{"step", "0.7"}}), {"reference"}});
  ASSERT_EQ(result.curves.size(), 3U);
  EXPECT_NEAR(result.last - result.first, 0.5, 1e-12);
  EXPECT_FALSE(result.parting);
  for (const ProbeCurve& curve : result.curves) {
    ASSERT_EQ(curve.samples.size(), 9U);
    for (size_t i = 0; i < 9; ++i) {
      const double expected = std::exp(-2 * (result.ray[i].depth - result.first));
      EXPECT_NEAR(curve.samples[i].transmittance, expected, 3e-6) << curve.label << " depth " << i;
      EXPECT_NEAR(curve.samples[i].colour.g, 1 - expected, 3e-6) << curve.label << " depth " << i;
      EXPECT_NEAR(result.ray[i].value, 1, 1e-12);
      EXPECT_NEAR(result.ray[i].extinction, 2, 1e-12);
    }
  }
}

// In perspective the ray is longer than the depth it spans, and slices stay where the near end puts them.
TEST_F(ProbeTest, DepthsCountAlongTheViewDirection) {
  scene.views[0].perspective = true;
  scene.views[0].near = 0.1;
  scene.views[0].fov_y = 0.6;
  options.x = 20;
  options.y = 11;
  const Probe result = run({subject("raycast", {}), subject("texture3d_slices", {}), {"reference"}});
  const double dx = (20.5 / 32 * 2 - 1) * std::tan(0.3), dy = (1 - 11.5 / 32 * 2) * std::tan(0.3);
  const double longer = std::sqrt(1 + dx * dx + dy * dy);
  const View& view = scene.views[0];
  EXPECT_NEAR(result.first, glm::distance(view.eye, view.target) - 0.25, 1e-9);
  for (const ProbeCurve& curve : result.curves)
    for (size_t i = 0; i < result.ray.size(); ++i)
      EXPECT_NEAR(curve.samples[i].transmittance, std::exp(-2 * longer * (result.ray[i].depth - result.first)), 3e-6)
          << curve.label;
}

// With alpha = tau h instead of 1 - exp(-tau h) and one step of .125, T is 1 - 2 x after x: the two curves are
// threshold apart where exp(-y) - 1 + y = threshold, y = 2 x, long before the first step ends.
TEST_F(ProbeTest, FindsTheDepthWhereTwoPart) {
  options.precision = 1e-4;
  const Probe result = run({subject("texture3d_slices", {{"step", "4"}, {"opacity_correction", "linear"}}),
                            subject("raycast", {{"step", "4"}})});
  ASSERT_TRUE(result.parting);
  const double y = 0.06391931;
  ASSERT_NEAR(std::exp(-y) - 1 + y, options.threshold, 1e-9);
  EXPECT_NEAR(result.parting->depth - result.first, y / 2, 1e-5);
  EXPECT_NEAR(result.parting->at_a.transmittance, 1 - y, 2e-5);
  EXPECT_NEAR(result.parting->at_b.transmittance, std::exp(-y), 2e-5);
  EXPECT_NEAR(result.parting->point.extinction, 2, 1e-12);
  EXPECT_NEAR(glm::length(result.parting->gradient), 0, 1e-12);
}

TEST_F(ProbeTest, DataAlongTheRayAreTheScenes) {
  scene = load_scene("sphere");  // value = distance from the centre
  load_data(scene, data_options_from_environment());
  options.x = 20;
  const Probe result = run({{"reference"}});
  const Ray ray = pixel_ray(scene.views[0], 32, 32, 20, 16);
  for (const ProbePoint& point : result.ray) {
    const double distance = glm::length(ray.origin + ray.direction * point.depth);  // orthographic: depth = distance
    EXPECT_NEAR(point.value, distance, 2e-3);  // trilinear interpolation near the centre
    EXPECT_EQ(point.extinction, scene.transfer.at(point.value).w);
  }
  EXPECT_FALSE(result.parting);
}

TEST_F(ProbeTest, SaysWhyThereIsNoProfile) {
  const std::vector<ProbeSubject> subjects = {subject("raycast", {})};
  options.x = 32;
  expect_error(subjects, "pixel 32,16 is not in the picture: it is 32x32");
  options.x = 0;
  options.y = 0;
  expect_error(subjects, "misses the volume");
  options.depths = 1;
  expect_error(subjects, "at least two depths");
}

class NoClipPlanes final : public Method {
 public:
  const MethodInfo& info() const override {
    static const MethodInfo kInfo{"flat", "draws nothing", "", {}, {"lighting"}};
    return kInfo;
  }
  std::optional<std::string> unsupported(const Scene&, const Values&, const BackendInfo&) const override {
    return std::nullopt;
  }
  std::unique_ptr<PreparedMethod> prepare(const Scene&, const Values&, Device&) const override { return nullptr; }
  Format target_format(const Values&) const override { return Format::RGBA32F; }
};

TEST_F(ProbeTest, MethodWithoutClipPlanesIsRefused) {
  const NoClipPlanes method;
  expect_error({{"flat", &method}, {"reference"}}, "flat does not simulate clip_planes");
}

TEST_F(ProbeTest, JsonHasWhatTheTableHas) {
  const Probe result =
      run({subject("texture3d_slices", {{"step", "16"}, {"opacity_correction", "linear"}}), {"reference"}});
  const ProbeHeading heading{"slab", "cpu", 0, "volumark probe slab"};
  const auto json = nlohmann::json::parse(probe_json(result, heading));
  EXPECT_EQ(json["ray"].size(), 9U);
  EXPECT_EQ(json["curves"][0]["method"], "texture3d_slices");
  EXPECT_EQ(json["curves"][0]["parameters"]["opacity_correction"], "linear");
  EXPECT_EQ(json["curves"][1]["samples"][4]["transmittance"], result.curves[1].samples[4].transmittance);
  EXPECT_EQ(json["parting"]["between"][1], "reference");
  const std::string plot = probe_plot(result, 40, 10), table = probe_table(result);
  EXPECT_NE(plot.find('A'), std::string::npos);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 10);
  EXPECT_NE(probe_html(result, heading).find("volumark probe slab"), std::string::npos);
}

}  // namespace
}  // namespace volumark
