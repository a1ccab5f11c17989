// Scenes as cells see them: loaded once an experiment, with the references of the chosen views.
#pragma once

#include "harness/cell.h"
#include "harness/progress.h"
#include "scenes/scene_io.h"

namespace volumark {

// Data that are missing or broken, and references that fail, end up in `missing` and `broken`.
SceneContext make_context(const Experiment& experiment, const std::string& scene, const DataOptions& data);

// References of all its views, through the cache; pictures of those that the experiment keeps. Says what took time.
void make_references(SceneContext& context, const Experiment& experiment, const ReferenceCache& cache,
                     const PictureStore& store, int threads, const std::atomic<bool>* stop, Progress& progress);

SceneResultInfo scene_result_info(const Scene& scene);

}  // namespace volumark
