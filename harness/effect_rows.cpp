#include "harness/effect_rows.h"

#include <algorithm>
#include <limits>

#include "harness/effect_variants.h"
#include "harness/metrics/metrics.h"

namespace volumark {
namespace {

const VariantCell* find(const std::vector<VariantCell>& cells, const std::vector<std::string>& effects,
                        const std::string& variant) {
  const std::string wanted = canonical_variant(effects, variant);
  const auto found = std::find_if(cells.begin(), cells.end(),
                                  [&](const VariantCell& cell) { return cell.result->key.variant == wanted; });
  if (found == cells.end() || !found->result->metrics) return nullptr;
  const Outcome outcome = found->result->outcome;
  return outcome == Outcome::Ok || outcome == Outcome::WrongImage ? &*found : nullptr;
}

int64_t instructions(const Result& result) {
  int64_t sum = 0;
  for (const ProgramCost& program : result.programs) sum += program.instructions;
  return sum;
}

void compare_pictures(const VariantCell& with, const VariantCell& without, const glm::dvec3& background,
                      EffectRow& row) {
  CompareOptions options;
  options.background = background;
  bool compared = false;
  for (const auto& [view, image] : *with.images) {
    const auto other = without.images->find(view);
    if (other == without.images->end()) continue;
    compared = true;
    const Errors errors = compare_images(image, other->second, options);
    row.rmse = std::max(row.rmse, errors.rmse);
    row.flip_p99 = std::max(row.flip_p99, errors.flip_p99.value_or(0));
  }
  if (!compared) row.rmse = row.flip_p99 = std::numeric_limits<double>::quiet_NaN();
}

bool apart(const Stats& a, const Stats& b) { return a.median_lo > b.median_hi || b.median_lo > a.median_hi; }

}  // namespace

std::vector<EffectRow> effect_rows(const Scene& scene, const std::vector<VariantCell>& cells) {
  const std::vector<std::string> effects = effect_names(scene.effects);
  std::vector<EffectRow> rows;
  const auto add = [&](const std::string& effect, const char* mode, const std::string& with_word,
                       const std::string& without_word) {
    const VariantCell* with = find(cells, effects, with_word);
    const VariantCell* without = find(cells, effects, without_word);
    if (with == nullptr || without == nullptr) return;
    EffectRow row;
    row.key = with->result->key;
    row.key.variant.clear();
    row.effect = effect;
    row.mode = mode;
    row.with = with->result->metrics->frame_wall.stats;
    row.without = without->result->metrics->frame_wall.stats;
    row.time_differs = row.with.count > 0 && row.without.count > 0 && apart(row.with, row.without);
    row.instructions_with = instructions(*with->result);
    row.instructions_without = instructions(*without->result);
    compare_pictures(*with, *without, scene.background, row);
    rows.push_back(std::move(row));
  };
  for (const std::string& effect : effects) add(effect, "single", "only " + effect, "none");
  if (effects.size() > 1)
    for (const std::string& effect : effects) add(effect, "leave_one_out", "", "without " + effect);
  return rows;
}

}  // namespace volumark
