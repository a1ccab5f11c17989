#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "methods/method.h"
#include "methods/raycast/raycast.h"
#include "methods/raycast/raycast_iso.h"
#include "methods/shell_slices/shell_slices.h"
#include "methods/slices2d/slice_mpr.h"
#include "methods/slices2d/slices2d.h"
#include "methods/slices2d/slices2d_iso.h"
#include "methods/slices2d/slices2d_shaded.h"
#include "methods/slices2d/slices2d_viewport.h"
#include "methods/texture3d_slices/texture3d_slices.h"
#include "methods/texture3d_slices/texture3d_slices_iso.h"

namespace volumark {

// The one list of methods: add yours here.
std::span<const Method* const> method_list() {
  static const std::array<const Method*, 12> list = {
      &texture3d_slices(), &texture3d_slices_iso(), &raycast(),      &raycast_iso(),
      &slices2d(),         &slices2d_viewport(),    &slice_mpr(),    &slices2d_iso(),
      &slices2d_shaded(),  &shell_software(),       &shell_hybrid(), &shell_hardware()};
  return list;
}

const Method& find_method(const std::string& name) {
  std::vector<std::string> names;
  for (const Method* method : method_list()) {
    if (method->info().name == name) return *method;
    names.push_back(method->info().name);
  }
  throw ParameterError(
      fmt::format("unknown method \"{}\"{}; known: {}", name, did_you_mean(name, names), fmt::join(names, ", ")));
}

Format target_format(const Method& method, const Scene& scene, const Values& values) {
  return scene.effects.fixed_point ? Format::RGBA8 : method.target_format(values);
}

std::vector<std::string> missing_effects(const Method& method, const Effects& effects) {
  const std::vector<std::string>& simulated = method.info().effects;
  std::vector<std::string> out;
  for (const std::string& effect : effect_names(effects))
    if (std::find(simulated.begin(), simulated.end(), effect) == simulated.end()) out.push_back(effect);
  return out;
}

std::optional<std::string> display_reason(const Method& method, const Scene& scene) {
  const std::vector<Display>& drawn = method.info().displays;
  if (std::find(drawn.begin(), drawn.end(), scene.display) != drawn.end()) return std::nullopt;
  std::vector<std::string> names;
  for (const Display display : drawn) names.emplace_back(to_string(display));
  return fmt::format("the scene's display is \"{}\"; {} draws: {}", to_string(scene.display), method.info().name,
                     fmt::join(names, ", "));
}

std::optional<std::string> missing_effect_reason(const Method& method, const Effects& effects) {
  const std::vector<std::string> missing = missing_effects(method, effects);
  if (missing.empty()) return std::nullopt;
  return fmt::format("effect {}: {} does not simulate it", missing.front(), method.info().name);
}

namespace {

// The first effect without which the method would not refuse the cell; empty: no single one is to blame.
std::string refused_effect(const Method& method, const Scene& scene, const Values& values, const BackendInfo& backend) {
  for (const std::string& effect : effect_names(scene.effects)) {
    Scene other = scene;
    other.effects = without_effect(scene.effects, effect);
    if (!method.unsupported(other, values, backend)) return effect;
  }
  return {};
}

}  // namespace

std::optional<std::string> unsupported_reason(const Method& method, const Scene& scene, const Values& values,
                                              const BackendInfo& backend) {
  if (auto other = display_reason(method, scene)) return other;
  if (auto missing = missing_effect_reason(method, scene.effects)) return missing;
  const auto reason = method.unsupported(scene, values, backend);
  if (!reason) return std::nullopt;
  const std::string effect = refused_effect(method, scene, values, backend);
  return effect.empty() ? *reason : fmt::format("effect {}: {}", effect, *reason);
}

std::vector<std::string> effects_to_ignore(const Method& method, const Scene& scene, const Values& values,
                                           const BackendInfo& backend) {
  const std::vector<std::string> missing = missing_effects(method, scene.effects);
  Scene left = scene;
  for (const std::string& effect : missing) left.effects = without_effect(left.effects, effect);
  std::vector<std::string> out = missing;
  while (method.unsupported(left, values, backend)) {
    const std::string effect = refused_effect(method, left, values, backend);
    if (effect.empty()) return missing;
    left.effects = without_effect(left.effects, effect);
    out.push_back(effect);
  }
  return out;
}

}  // namespace volumark
