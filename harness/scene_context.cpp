#include "harness/scene_context.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "harness/effect_variants.h"
#include "harness/image_io.h"
#include "harness/reference_cost.h"
#include "harness/scene_data.h"
#include "scenes/errors.h"

namespace volumark {

SceneContext make_context(const Experiment& experiment, const std::string& scene, const DataOptions& data) {
  SceneContext context;
  context.scene = load_scene(scene);
  try {
    load_data(context.scene, data);
  } catch (const DataMissing& missing) {
    context.missing = fmt::format("data not installed: {}", missing.what());
    if (context.missing->find(missing.how_to_get) == std::string::npos)
      *context.missing += "; to get them: " + missing.how_to_get;
  } catch (const std::exception& error) {
    context.broken = error.what();
  }
  context.width = experiment.width.value_or(context.scene.width);
  context.height = experiment.height.value_or(context.scene.height);
  context.views = chosen_views(experiment, static_cast<int>(context.scene.views.size()));
  if (context.views.empty()) context.broken = "the scene has none of the experiment's views";
  return context;
}

void make_references(SceneContext& context, const Experiment& experiment, const ReferenceCache& cache,
                     const PictureStore& store, int threads, const std::atomic<bool>* stop, Progress& progress) {
  if (context.missing || context.broken || !experiment.references) return;
  context.unreferenced = context.scene.effects.others;
  const Scene scene = without_effects(context.scene, context.unreferenced);
  ReferenceOptions options;
  options.tolerance = experiment.reference_tolerance;
  options.threads = threads;
  const auto absent = static_cast<size_t>(std::count_if(context.views.begin(), context.views.end(), [&](int index) {
    const View& view = scene.views[static_cast<size_t>(index)];
    return !std::filesystem::exists(cache.file_of(reference_key(scene, view, context.width, context.height, options)));
  }));
  context.missing = too_costly(scene, experiment, context.width, context.height, absent);
  if (context.missing) return;
  try {
    for (const int index : context.views) {
      if (stop != nullptr && stop->load()) throw Interrupted{};
      const View& view = scene.views[static_cast<size_t>(index)];
      bool cached = false;
      const Instant start = now();
      Reference reference = cache.get(scene, view, context.width, context.height, options, &cached);
      if (!cached)
        progress.line(fmt::format("reference {} view {}: {} (bound {:.1e})", context.scene.name, index,
                                  duration_text(since(start).wall), reference.max_bound));
      context.reference_infos[index] = {reference_key(scene, view, context.width, context.height, options),
                                        pixel_hash(reference.image), reference.max_bound, reference.estimate,
                                        context.unreferenced};
      const bool kept = experiment.images == Experiment::Images::All ||
                        (experiment.images == Experiment::Images::First && index == context.views.front());
      if (kept)
        context.reference_files[index] =
            store.linear(fmt::format("{}/reference-{}x{}-{}-v{}", context.scene.name, context.width, context.height,
                                     scene.hash.substr(0, 8), index),
                         reference.image, context.scene.background);
      context.regions[index] = region_map(scene, view, reference, threads);
      context.references[index] = std::move(reference);
    }
  } catch (const ImageError&) {
    throw;  // the folder, not the scene
  } catch (const std::exception& error) {
    context.broken = fmt::format("the reference cannot be made: {}", error.what());
  }
}

std::shared_ptr<SceneContext> variant_context(const SceneContext& context, const std::string& variant) {
  auto out = std::make_shared<SceneContext>();
  out->scene = scene_variant(context.scene, variant);
  out->missing = context.missing;
  out->broken = context.broken;
  out->width = context.width;
  out->height = context.height;
  out->views = context.views;
  return out;
}

SceneResultInfo scene_result_info(const Scene& scene) {
  SceneResultInfo out;
  out.name = scene.name;
  out.title = scene.title;
  out.description = scene.description;
  out.hash = scene.hash;
  const SceneData data = data_of(scene);
  out.voxels = {data.size.x, data.size.y, data.size.z};
  out.voxel_type = data.type;
  out.licence = scene.source.licence;
  out.origin = scene.source.origin;
  out.effects = effect_names(scene.effects);
  out.display = to_string(scene.display);
  for (const View& view : scene.views) out.views.push_back(view.name);
  out.background = {scene.background.r, scene.background.g, scene.background.b};
  return out;
}

}  // namespace volumark
