// Scenes as cells see them: loaded once an experiment, with the references of the chosen views.
#pragma once

#include "harness/cell.h"
#include "harness/progress.h"
#include "scenes/scene_io.h"

namespace volumark {

// Data that are missing or broken, and references that fail, end up in `missing` and `broken`.
SceneContext make_context(const Experiment& experiment, const std::string& scene, const DataOptions& data);

// The same scene with its effects switched: no references yet.
std::shared_ptr<SceneContext> variant_context(const SceneContext& context, const std::string& variant);

// References of all its views, through the cache; pictures of those that the experiment keeps. Says what took time.
// Effects that the reference does not draw are left out of it, and noted in `unreferenced` (fixed_point apart: the
// truth of a picture in fixed point is the exact one).
void make_references(SceneContext& context, const Experiment& experiment, const ReferenceCache& cache,
                     const PictureStore& store, int threads, const std::atomic<bool>* stop, Progress& progress);

SceneResultInfo scene_result_info(const Scene& scene);

}  // namespace volumark
