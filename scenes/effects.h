// The vocabulary of effects, in one place. A scene lists those that it calls for; the program that runs is compiled
// without the rest; a method that cannot simulate one of them refuses the cell before any work.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace volumark {

struct Effects;  // scenes/scene.h

struct EffectInfo {
  const char* name;   // key in a scene's "effects"
  const char* title;  // one line
};
// All names that a scene may call for, in the order in which they are reported.
std::span<const EffectInfo> effect_list();

// The names of those that are called for, in the vocabulary's order.
std::vector<std::string> effect_names(const Effects& effects);

// The same effects with only `name`, or without it. Throws std::invalid_argument for a name out of the vocabulary.
Effects only_effect(const Effects& effects, const std::string& name);
Effects without_effect(const Effects& effects, const std::string& name);

}  // namespace volumark
