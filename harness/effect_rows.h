// What an effect costs, from the cells of the variants of one scene: time, picture and instructions with and without
// it.
#pragma once

#include <map>
#include <vector>

#include "reports/results.h"
#include "scenes/image.h"
#include "scenes/scene.h"

namespace volumark {

// A cell of one variant, and its picture of each view (by index in the scene).
struct VariantCell {
  const Result* result = nullptr;
  const std::map<int, Image>* images = nullptr;
};

// `cells`: the variants of one scene, method, backend and set of parameters, measured alike. For each effect of `scene`
// (as the file says, nothing switched): a row "single" (it alone against none), and, where the scene calls for several,
// a row "leave_one_out" (all against all but it). A row needs both of its cells measured (ok or wrong_image); the
// picture figures are the worst over the views that both have.
std::vector<EffectRow> effect_rows(const Scene& scene, const std::vector<VariantCell>& cells);

}  // namespace volumark
