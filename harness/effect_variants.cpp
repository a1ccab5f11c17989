#include "harness/effect_variants.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "scenes/sha256.h"

namespace volumark {
namespace {

constexpr const char* kOnly = "only ";
constexpr const char* kWithout = "without ";

std::vector<std::string> all_words(const std::vector<std::string>& effects) {
  std::vector<std::string> words = {"", "none"};
  for (const std::string& effect : effects) words.push_back(kOnly + effect);
  for (const std::string& effect : effects) words.push_back(kWithout + effect);
  return words;
}

}  // namespace

std::vector<std::string> variant_effects(const std::vector<std::string>& effects, const std::string& variant) {
  if (variant.empty()) return effects;
  if (variant == "none") return {};
  const bool only = variant.starts_with(kOnly);
  const std::string name = only                            ? variant.substr(std::string(kOnly).size())
                           : variant.starts_with(kWithout) ? variant.substr(std::string(kWithout).size())
                                                           : "";
  if (std::find(effects.begin(), effects.end(), name) == effects.end())
    throw std::invalid_argument(
        fmt::format("\"{}\" is no variant of a scene that calls for {}", variant,
                    effects.empty() ? "no effect" : fmt::format("{}", fmt::join(effects, ", "))));
  if (only) return {name};
  std::vector<std::string> left = effects;
  std::erase(left, name);
  return left;
}

std::vector<std::string> effect_variants(const std::vector<std::string>& effects) {
  std::vector<std::string> variants;
  std::vector<std::vector<std::string>> pictures;
  for (const std::string& word : all_words(effects)) {
    std::vector<std::string> left = variant_effects(effects, word);
    if (std::find(pictures.begin(), pictures.end(), left) != pictures.end()) continue;
    pictures.push_back(std::move(left));
    variants.push_back(word);
  }
  return variants;
}

std::string canonical_variant(const std::vector<std::string>& effects, const std::string& variant) {
  const std::vector<std::string> left = variant_effects(effects, variant);
  for (const std::string& word : effect_variants(effects))
    if (variant_effects(effects, word) == left) return word;
  throw std::logic_error("a variant that effect_variants does not know: " + variant);
}

std::string variant_from_word(const std::string& word) { return word == "all" ? "" : word; }
std::string variant_word(const std::string& variant) { return variant.empty() ? "all" : variant; }

Scene without_effects(Scene scene, const std::vector<std::string>& names) {
  std::vector<std::string> gone;
  for (const std::string& name : effect_names(scene.effects))
    if (std::find(names.begin(), names.end(), name) != names.end()) gone.push_back(name);
  for (const std::string& name : gone) scene.effects = without_effect(scene.effects, name);
  if (!gone.empty()) scene.hash = sha256_hex(fmt::format("{} without {}", scene.hash, fmt::join(gone, " ")));
  return scene;
}

std::string ignored_note(const std::vector<std::string>& ignored) {
  return ignored.empty() ? "" : fmt::format("effects of the scene that are ignored here: {}", fmt::join(ignored, ", "));
}

Scene scene_variant(const Scene& scene, const std::string& variant) {
  const std::vector<std::string> effects = effect_names(scene.effects);
  const std::vector<std::string> left = variant_effects(effects, variant);
  std::vector<std::string> gone;
  for (const std::string& name : effects)
    if (std::find(left.begin(), left.end(), name) == left.end()) gone.push_back(name);
  return without_effects(scene, gone);
}

}  // namespace volumark
