#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "methods/method.h"
#include "test_scene.h"

namespace volumark {
namespace {

BackendInfo roomy_backend() {
  BackendInfo backend;
  backend.id = "null";
  backend.limits = {16384, 16384, 2048, size_t{1} << 27};
  backend.capabilities.assign(kAllCapabilities.begin(), kAllCapabilities.end());
  return backend;
}

TEST(Methods, NamesAreUniqueAndFound) {
  std::vector<std::string> names;
  for (const Method* method : method_list()) {
    names.push_back(method->info().name);
    EXPECT_EQ(&find_method(method->info().name), method);
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
}

TEST(Methods, UnknownNameNamesTheNearest) {
  try {
    find_method("texture3d_slice");
    FAIL() << "accepted";
  } catch (const ParameterError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("did you mean \"texture3d_slices\""));
  }
}

// What the command line, the docs and the harness rely on of every method.
TEST(Methods, DeclarationsHoldTogether) {
  for (const Method* method : method_list()) {
    const MethodInfo& info = method->info();
    SCOPED_TRACE(info.name);
    EXPECT_FALSE(info.title.empty());
    Values values = default_values(info.parameters);
    EXPECT_EQ(values.size(), info.parameters.size()) << "names are unique";
    int axes = 0;
    for (const ParameterInfo& parameter : info.parameters) {
      SCOPED_TRACE(parameter.name);
      EXPECT_FALSE(parameter.doc.empty());
      EXPECT_NO_THROW(set_value(info.parameters, values, parameter.name, to_string(parameter.default_value)));
      axes += parameter.quality_axis ? 1 : 0;
      EXPECT_EQ(parameter.quality_axis, !parameter.sweep.empty());
      for (const double value : parameter.sweep) {
        EXPECT_GE(value, parameter.lo);
        EXPECT_LE(value, parameter.hi);
      }
    }
    EXPECT_LE(axes, 1);
  }
}

Scene small_scene() {
  return testing::scene_of(testing::volume_of<uint8_t>({4, 4, 4}, VoxelType::U8, std::vector<uint8_t>(64, 9)));
}

TEST(Methods, SupportedSceneHasNoReason) {
  for (const Method* method : method_list()) {
    const Values values = default_values(method->info().parameters);
    if (method->info().displays.front() == Display::Shell) continue;  // no volume is theirs
    const Scene scene = testing::showing(small_scene(), method->info().displays.front());
    EXPECT_EQ(unsupported_reason(*method, scene, values, roomy_backend()), std::nullopt) << method->info().name;
  }
}

TEST(Methods, LimitsAndCombinationsGiveAReason) {
  const Method& slices = find_method("texture3d_slices");
  const auto reason = [&](const Scene& scene, const Values& values, const BackendInfo& backend) {
    return unsupported_reason(slices, scene, values, backend).value_or("supported");
  };
  Values values = default_values(slices.info().parameters);
  BackendInfo small = roomy_backend();
  small.limits.texture_3d = 3;
  EXPECT_THAT(reason(small_scene(), values, small), ::testing::HasSubstr("4x4x4"));
  small = roomy_backend();
  small.limits.texture_1d = 1000;
  EXPECT_THAT(reason(small_scene(), values, small), ::testing::HasSubstr("table_size"));

  Scene lit = small_scene();
  lit.effects.lighting.emplace();
  lit.effects.lighting->lights.resize(1);
  EXPECT_EQ(reason(lit, values, roomy_backend()), "supported");
  values["classification"] = std::string("pre");
  EXPECT_EQ(reason(small_scene(), values, roomy_backend()), "supported");
  EXPECT_THAT(reason(lit, values, roomy_backend()), ::testing::HasSubstr("gradient"));

  values = default_values(slices.info().parameters);
  lit.effects.lighting->lights.resize(65);
  EXPECT_THAT(reason(lit, values, roomy_backend()), ::testing::HasSubstr("65 lights"));
  Scene clipped = small_scene();
  clipped.effects.clip_planes.resize(17);
  EXPECT_THAT(reason(clipped, values, roomy_backend()), ::testing::HasSubstr("17 clip planes"));
}

// llvmpipe ends a program's loops after 65535 turns; with empty-space skipping a segment takes two.
TEST(Methods, RaysOfMoreSegmentsThanADriverLoopsAreRefused) {
  const Method& method = find_method("raycast");
  Scene deep = small_scene();
  auto volume = std::make_shared<Volume>(*deep.volume);
  volume->spacing = {1, 1, 100};  // a diagonal of 300 smallest spacings
  deep.volume = volume;
  Values values = default_values(method.info().parameters);
  BackendInfo mesa = roomy_backend();
  mesa.renderer = "llvmpipe (LLVM 15.0.6, 256 bits)";
  const auto refused = [&](double step, const char* skip, const BackendInfo& backend) {
    values["step"] = step;
    values["skip_empty"] = std::string(skip);
    return unsupported_reason(method, deep, values, backend).has_value();
  };
  EXPECT_TRUE(refused(300 / 40000., "bricks", mesa));
  EXPECT_FALSE(refused(300 / 40000., "none", mesa));
  EXPECT_TRUE(refused(300 / 70000., "none", mesa));
  EXPECT_FALSE(refused(300 / 30000., "bricks", mesa));
  EXPECT_FALSE(refused(300 / 70000., "bricks", roomy_backend()));
}

TEST(Methods, ExpectedOrderOfSlices) {
  const MethodInfo& info = find_method("texture3d_slices").info();
  const auto order = [&](std::initializer_list<std::pair<const char*, const char*>> changes) {
    Values values = default_values(info.parameters);
    for (const auto& [name, value] : changes) set_value(info.parameters, values, name, std::string(value));
    return info.expected_order(values);
  };
  EXPECT_EQ(order({}), 2);
  EXPECT_EQ(order({{"classification", "preintegrated"}}), 2);
  EXPECT_EQ(order({{"end_slabs", "full"}}), 1);
  EXPECT_EQ(order({{"opacity_correction", "linear"}}), 1);
  EXPECT_EQ(order({{"target_format", "rgba8"}}), 0);
}

TEST(Methods, RaycastStatesAnOrderOnlyWhereTheStepDecides) {
  const MethodInfo& info = find_method("raycast").info();
  const auto order = [&](std::initializer_list<std::pair<const char*, const char*>> changes) {
    Values values = default_values(info.parameters);
    set_value(info.parameters, values, "early_termination", std::string("0"));
    for (const auto& [name, value] : changes) set_value(info.parameters, values, name, std::string(value));
    return info.expected_order(values);
  };
  EXPECT_EQ(order({}), 2);
  EXPECT_EQ(order({{"classification", "preintegrated"}}), 2);
  EXPECT_EQ(order({{"volume_format", "r32f"}}), 2);
  EXPECT_EQ(order({{"volume_format", "r8"}}), 0);
  EXPECT_EQ(order({{"volume_format", "r16f"}}), 0);
  EXPECT_EQ(order({{"target_format", "rgba16f"}}), 0);
  EXPECT_EQ(order({{"early_termination", "0.001"}}), 0);
}

}  // namespace
}  // namespace volumark
