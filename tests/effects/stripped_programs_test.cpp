// A scene that calls for no effect runs no instruction for any: each program of each method, with the constants of its
// effects at 0, is after optimisation the same as the program of a build whose GLSL has never heard of them
// (VM_WITHOUT_NAME), instruction for instruction. Every method of the list and every choice of its parameters is taken.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "harness/program_cost.h"
#include "methods/method.h"
#include "tests/effects/stripped_text.h"
#include "tests/unit/methods/test_scene.h"

namespace volumark {
namespace {

using Stream = std::vector<std::string>;

Scene plain_scene() {
  std::vector<uint8_t> values(4 * 4 * 4);
  for (size_t i = 0; i < values.size(); ++i) values[i] = static_cast<uint8_t>(i * 4);
  return testing::scene_of(testing::volume_of<uint8_t>({4, 4, 4}, VoxelType::U8, values));
}

// Effects that a method of the list simulates, each as a scene would call for it.
Scene scene_with(const std::string& effect) {
  Scene scene = plain_scene();
  if (effect == "lighting") {
    scene.effects.lighting.emplace();
    scene.effects.lighting->lights.resize(1);
    scene.effects.lighting->specular = 0.5;
  } else if (effect == "clip_planes") {
    scene.effects.clip_planes.push_back({{1, 0, 0}, 0});
  } else if (effect == "fixed_point") {
    scene.effects.fixed_point = true;
  } else {
    ADD_FAILURE() << "a method simulates " << effect << ": say here how a scene calls for it";
  }
  return scene;
}

// The method's own values, and each choice and flag changed on its own.
std::vector<Values> settings(const Method& method) {
  const std::vector<ParameterInfo>& parameters = method.info().parameters;
  std::vector<Values> out = {default_values(parameters)};
  for (const ParameterInfo& parameter : parameters) {
    std::vector<Value> others;
    for (const std::string& choice : parameter.choices) others.emplace_back(choice);
    if (const bool* flag = std::get_if<bool>(&parameter.default_value)) others.emplace_back(!*flag);
    for (const Value& other : others) {
      if (other == parameter.default_value) continue;
      Values values = out.front();
      values[parameter.name] = other;
      out.push_back(values);
    }
  }
  return out;
}

// The programs that a method makes for a scene, showing what it draws; nothing where it cannot draw it.
std::vector<ProgramRecord> programs_of(const Method& method, const Scene& volume, const Values& values) {
  const Scene scene = testing::showing(volume, method.info().displays.front());
  Device device = make_device("null");
  if (unsupported_reason(method, scene, values, device.info())) return {};
  const auto prepared = method.prepare(scene, values, device);
  return {device.programs().begin(), device.programs().end()};
}

// As spirv_without(), each once.
const std::vector<uint32_t>& stripped(const ShaderText& text, const std::vector<std::string>& effects) {
  static std::map<std::pair<std::string, std::vector<std::string>>, std::vector<uint32_t>> known;
  const auto [entry, fresh] = known.try_emplace({text.name, effects});
  if (fresh) entry->second = spirv_without(text, effects);
  return entry->second;
}

std::string first_difference(const Stream& a, const Stream& b) {
  const size_t length = std::min(a.size(), b.size());
  size_t i = 0;
  while (i < length && a[i] == b[i]) ++i;
  return fmt::format("{} and {} instructions; the first that differs is {}: {} / {}", a.size(), b.size(), i,
                     i < a.size() ? a[i] : "-", i < b.size() ? b[i] : "-");
}

Stream stream_of(std::span<const uint32_t> spirv, const ProgramRecord& program) {
  return instruction_stream(optimised_stage(spirv, program.constants));
}

void expect_nothing_of(const std::vector<std::string>& effects, const ProgramRecord& program) {
  for (const ShaderText* stage : program.stages) {
    const Stream full = stream_of(stage->spirv, program);
    const Stream without = stream_of(stripped(*stage, effects), program);
    EXPECT_EQ(full, without) << stage->name << " against a build without "
                             << fmt::format("{}", fmt::join(effects, ", ")) << ": " << first_difference(full, without);
  }
}

std::set<Stream> streams_of(const std::vector<ProgramRecord>& programs) {
  std::set<Stream> out;
  for (const ProgramRecord& program : programs)
    for (const ShaderText* stage : program.stages) out.insert(stream_of(stage->spirv, program));
  return out;
}

TEST(StrippedPrograms, ASceneWithoutEffectsRunsNothingForAny) {
  for (const Method* method : method_list()) {
    SCOPED_TRACE(method->info().name);
    size_t compared = 0;
    for (const Values& values : settings(*method))
      for (const ProgramRecord& program : programs_of(*method, plain_scene(), values)) {
        expect_nothing_of(method->info().effects, program);
        ++compared;
      }
    EXPECT_GT(compared, 0u) << "no program was compared";
  }
}

// With one effect called for, nothing of the others is there.
TEST(StrippedPrograms, ASceneWithOneEffectRunsNothingForTheOthers) {
  for (const Method* method : method_list())
    for (const std::string& effect : method->info().effects) {
      SCOPED_TRACE(method->info().name + " with " + effect);
      std::vector<std::string> others = method->info().effects;
      std::erase(others, effect);
      for (const Values& values : settings(*method))
        for (const ProgramRecord& program : programs_of(*method, scene_with(effect), values))
          expect_nothing_of(others, program);
    }
}

// Or the comparison above could not fail: an effect that is called for does change what runs. (In some settings it may
// be done by the host alone, such as slices that are clipped as polygons.)
TEST(StrippedPrograms, EachEffectChangesWhatRuns) {
  for (const Method* method : method_list())
    for (const std::string& effect : method->info().effects) {
      bool changes = false;
      for (const Values& values : settings(*method)) {
        const std::set<Stream> with = streams_of(programs_of(*method, scene_with(effect), values));
        changes = changes || (!with.empty() && with != streams_of(programs_of(*method, plain_scene(), values)));
      }
      EXPECT_TRUE(changes) << method->info().name << ": the programs with and without " << effect << " are the same";
    }
}

// And the define does take something away.
TEST(StrippedPrograms, TheDefineRemovesTheEffect) {
  for (const Method* method : method_list())
    for (const char* effect : {"lighting", "clip_planes"}) {
      const std::vector<std::string>& simulated = method->info().effects;
      if (std::find(simulated.begin(), simulated.end(), effect) == simulated.end()) continue;
      bool changes = false;
      for (const ProgramRecord& program :
           programs_of(*method, scene_with(effect), default_values(method->info().parameters)))
        for (const ShaderText* stage : program.stages)
          changes = changes || stream_of(stage->spirv, program) != stream_of(stripped(*stage, {effect}), program);
      EXPECT_TRUE(changes) << method->info().name << ": VM_WITHOUT_ ... of " << effect << " changes no program";
    }
}

}  // namespace
}  // namespace volumark
