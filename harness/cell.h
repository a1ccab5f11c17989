// One cell, from opening the Device to its outcome. Whatever goes wrong inside ends as an outcome with a reason; only
// Interrupted leaves.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "harness/picture_store.h"
#include "harness/plan.h"
#include "harness/reference_cache.h"
#include "harness/regions.h"

namespace volumark {

class FrameSampler;

// The user asked to stop: the cell that was being measured is dropped.
struct Interrupted {};

// A scene as all cells of an experiment share it.
struct SceneContext {
  Scene scene;
  std::optional<std::string> missing;  // data that are not installed, references too costly: every cell is unsupported
  std::optional<std::string> broken;   // its data or its references cannot be had: every cell has failed
  int width = 0, height = 0;
  std::vector<int> views;
  std::map<int, Reference> references;  // by view
  std::map<int, ReferenceInfo> reference_infos;
  std::map<int, RegionMap> regions;
  std::map<int, ImageFile> reference_files;  // of the views whose pictures are kept
  // Effects of the scene that the references lack, because nothing draws them exactly: they are the truth of a picture
  // that lacks them too.
  std::vector<std::string> unreferenced;
  // Makes references, regions and reference_files, once: called by the first cell that is going to draw. Empty: made.
  std::function<void()> want_references;
  // The scene with its effects switched, by CellKey::variant. "" is this one.
  std::map<std::string, std::shared_ptr<SceneContext>> variants;
  const SceneContext& of(const std::string& variant) const { return variant.empty() ? *this : *variants.at(variant); }
};

struct CellOptions {
  DeviceOptions device;
  bool require_backends = false;  // a backend that cannot be opened is a failure
  const std::atomic<bool>* stop = nullptr;
};

// A cell while it is measured. Passes of several cells can take turns, so that a drift of the machine meets all alike.
class CellRun {
 public:
  // All arguments outlive it. `context` is that of the scene as it is: the cell's variant is chosen here.
  CellRun(const Group& group, const Cell& cell, const SceneContext& context, const CellOptions& options);
  ~CellRun();
  CellRun(const CellRun&) = delete;

  // Opens the Device, prepares and draws every view once. Throws Interrupted alone, as pass().
  void open();
  // One timed frame of every view; false: enough is known, or the cell has ended.
  bool pass();
  // Errors, pictures and the outcome; the Device is closed. Once.
  Result finish(const PictureStore& store);

  // What the Device says of itself; nothing where none could be opened.
  const std::optional<BackendInfo>& backend() const { return backend_; }
  const std::map<int, Image>& images() const { return images_; }  // of each view that was drawn
  // Of the process's memory, so much was held by other cells when this one was opened: not its own.
  void held_by_others(int64_t bytes) { held_by_others_ = bytes; }

 private:
  template <class Work>
  bool guarded(Work work);
  void end(Outcome outcome, const std::string& reason);
  void ignore_effects();

  const Group& group_;
  const Cell& cell_;
  const SceneContext& context_;  // of the variant
  const CellOptions& options_;
  std::optional<BackendInfo> backend_;
  std::map<int, Image> images_;
  Scene scene_;  // without the effects that are ignored
  Result result_;
  std::unique_ptr<Device> device_;
  std::unique_ptr<FrameSampler> sampler_;  // destroyed before the Device
  int64_t held_by_others_ = 0;
  bool ended_ = false;
};

// The pictures alone, untimed: for a cell that an earlier process measured. Empty where it cannot be drawn. `context`
// as in CellRun.
std::map<int, Image> draw_cell(const Group& group, const Cell& cell, const SceneContext& context,
                               const CellOptions& options);

// Hash of everything that the figures depend on: an edited case is a new series. `context` as in CellRun.
std::string case_version(const Group& group, const Cell& cell, const SceneContext& context);

}  // namespace volumark
