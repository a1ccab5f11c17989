// One cell, from opening the Device to its outcome. Whatever goes wrong inside ends as an outcome with a reason; only
// Interrupted leaves.
#pragma once

#include <atomic>
#include <map>
#include <optional>

#include "harness/picture_store.h"
#include "harness/plan.h"
#include "harness/reference_cache.h"

namespace volumark {

// The user asked to stop: the cell that was being measured is dropped.
struct Interrupted {};

// A scene as all cells of an experiment share it.
struct SceneContext {
  Scene scene;
  std::optional<std::string> missing;  // its data are not installed: every cell is unsupported
  std::optional<std::string> broken;   // its data or its references cannot be had: every cell has failed
  int width = 0, height = 0;
  std::vector<int> views;
  std::map<int, Reference> references;  // by view
  std::map<int, ReferenceInfo> reference_infos;
  std::map<int, ImageFile> reference_files;  // of the views whose pictures are kept
};

struct CellOptions {
  DeviceOptions device;
  bool require_backends = false;  // a backend that cannot be opened is a failure
  const std::atomic<bool>* stop = nullptr;
};

// `backend` receives what the Device says of itself; `images` the picture of each view (for comparison between
// backends).
Result run_cell(const Group& group, const Cell& cell, const SceneContext& context, const CellOptions& options,
                const PictureStore& store, std::optional<BackendInfo>& backend, std::map<int, Image>& images);

// The pictures alone, untimed: for a cell that an earlier process measured. Empty where it cannot be drawn.
std::map<int, Image> draw_cell(const Group& group, const Cell& cell, const SceneContext& context,
                               const CellOptions& options);

// Hash of everything that the figures depend on: an edited case is a new series.
std::string case_version(const Group& group, const SceneContext& context);

}  // namespace volumark
