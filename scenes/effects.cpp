#include "scenes/effects.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "scenes/scene.h"

namespace volumark {
namespace {

constexpr std::array<EffectInfo, 8> kEffects = {{
    {"lighting", "Blinn-Phong at every sample, from the gradient of the data"},
    {"clip_planes", "half spaces that are cut away"},
    {"fixed_point", "8-bit frame buffer and 9-bit signed combiner arithmetic, as the boards of 2000 had"},
    {"clip_geometry", "a closed mesh that cuts the volume"},
    {"spherical_domain", "the volume wound around a sphere"},
    {"ground_fog", "fog of a density that falls with height"},
    {"morphing", "levels of detail that pass into each other"},
    {"near_clipping", "cells that are cut where they reach behind the near plane"},
}};

const EffectInfo& find_effect(const std::string& name) {
  for (const EffectInfo& effect : kEffects)
    if (name == effect.name) return effect;
  throw std::invalid_argument("unknown effect \"" + name + "\"");
}

}  // namespace

std::span<const EffectInfo> effect_list() { return kEffects; }

std::vector<std::string> effect_names(const Effects& effects) {
  std::vector<std::string> names;
  if (effects.lighting) names.emplace_back("lighting");
  if (!effects.clip_planes.empty()) names.emplace_back("clip_planes");
  if (effects.fixed_point) names.emplace_back("fixed_point");
  names.insert(names.end(), effects.others.begin(), effects.others.end());
  return names;
}

Effects without_effect(const Effects& effects, const std::string& name) {
  find_effect(name);
  Effects out = effects;
  if (name == "lighting") out.lighting.reset();
  if (name == "clip_planes") out.clip_planes.clear();
  if (name == "fixed_point") out.fixed_point = false;
  std::erase(out.others, name);
  return out;
}

Effects only_effect(const Effects& effects, const std::string& name) {
  find_effect(name);
  Effects out = effects;
  for (const EffectInfo& effect : kEffects)
    if (name != effect.name) out = without_effect(out, effect.name);
  return out;
}

}  // namespace volumark
