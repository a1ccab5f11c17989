// A scene with its effects switched: as it is, with none, with one alone, with one left out. A variant is a word in the
// key of a cell: "" (as the scene says), "none", "only NAME", "without NAME"; two words that leave the same effects are
// one variant, and go by the first of them.
#pragma once

#include <string>
#include <vector>

#include "scenes/scene.h"

namespace volumark {

// The variants of a scene that calls for `effects`, no two of them the same picture: "" first.
std::vector<std::string> effect_variants(const std::vector<std::string>& effects);

// The effects that are left. Throws std::invalid_argument for a word that is no variant of a scene with these effects.
std::vector<std::string> variant_effects(const std::vector<std::string>& effects, const std::string& variant);

// The one of effect_variants() that leaves the same effects. Throws as variant_effects().
std::string canonical_variant(const std::vector<std::string>& effects, const std::string& variant);

// "" is "all" on the command line, where an empty word is easily lost.
std::string variant_from_word(const std::string& word);
std::string variant_word(const std::string& variant);

// The same scene without some of its effects: another picture, so another hash. Names that it does not call for change
// nothing. The scene's data are loaded, or placements relative to them would miss what was taken away.
Scene without_effects(Scene scene, const std::vector<std::string>& names);
Scene scene_variant(const Scene& scene, const std::string& variant);

// What a picture says of itself that lacks effects of its scene: "effects of the scene that are ignored here: fog".
// Empty for none.
std::string ignored_note(const std::vector<std::string>& ignored);

}  // namespace volumark
