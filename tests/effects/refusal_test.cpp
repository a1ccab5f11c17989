// What a method cannot simulate: the refusal names the effect, and knows what to leave out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "methods/method.h"
#include "tests/unit/methods/test_scene.h"

namespace volumark {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

BackendInfo backend() { return make_device("null").info(); }

Scene lit_scene() {
  Scene scene = testing::scene_of(testing::volume_of<uint8_t>({4, 4, 4}, VoxelType::U8, std::vector<uint8_t>(64, 9)));
  scene.effects.lighting.emplace();
  scene.effects.lighting->lights.resize(1);
  return scene;
}

TEST(Refusal, NamesAnEffectThatNoSettingSimulates) {
  Scene scene = lit_scene();
  scene.effects.others = {"ground_fog"};
  for (const Method* method : method_list()) {
    const Values values = default_values(method->info().parameters);
    EXPECT_EQ(*missing_effect_reason(*method, Effects{.others = {"ground_fog"}}),
              "effect ground_fog: " + method->info().name + " does not simulate it");
    const Scene shown = testing::showing(scene, method->info().displays.front());
    EXPECT_THAT(*unsupported_reason(*method, shown, values, backend()), StartsWith("effect "));
  }
}

TEST(Refusal, NamesAnEffectThatThisSettingOrThisManyCannotBe) {
  const Method& slices = find_method("texture3d_slices");
  Values values = default_values(slices.info().parameters);
  Scene scene = lit_scene();
  scene.effects.clip_planes.resize(17);
  EXPECT_THAT(*unsupported_reason(slices, scene, values, backend()), StartsWith("effect clip_planes: 17 clip planes"));
  scene.effects.clip_planes.clear();
  values["classification"] = std::string("pre");
  EXPECT_THAT(*unsupported_reason(slices, scene, values, backend()), StartsWith("effect lighting: "));
}

TEST(Refusal, OfAnotherReasonBlamesNoEffect) {
  const Method& slices = find_method("texture3d_slices");
  BackendInfo small = backend();
  small.limits.texture_3d = 2;
  const Values values = default_values(slices.info().parameters);
  EXPECT_THAT(*unsupported_reason(slices, lit_scene(), values, small), StartsWith("the volume is 4x4x4"));
  EXPECT_THAT(effects_to_ignore(slices, lit_scene(), values, small), ElementsAre());
}

TEST(Refusal, WhatMustBeIgnoredIsNoMoreThanThat) {
  const Method& slices = find_method("texture3d_slices");
  Values values = default_values(slices.info().parameters);
  Scene scene = lit_scene();
  EXPECT_THAT(effects_to_ignore(slices, scene, values, backend()), ElementsAre());
  scene.effects.others = {"ground_fog", "morphing"};
  EXPECT_THAT(effects_to_ignore(slices, scene, values, backend()), ElementsAre("ground_fog", "morphing"));
  values["classification"] = std::string("pre");
  EXPECT_THAT(effects_to_ignore(slices, scene, values, backend()), ElementsAre("ground_fog", "morphing", "lighting"));
  scene.effects.others.clear();
  scene.effects.clip_planes.resize(17);
  EXPECT_THAT(effects_to_ignore(slices, scene, values, backend()), ElementsAre()) << "no single one is to blame";
}

}  // namespace
}  // namespace volumark
