// The samples of one cell: which frames are drawn, timed and read back, and when enough is known.
// begin() draws every view once, untimed but for the very first frame, and reads the pictures back. Each pass() then
// draws one timed frame of every view, until the interval of the cell's figure is narrow enough or the budget is spent.
// Only time inside these calls counts: the passes of several cells can take turns.
#pragma once

#include <atomic>
#include <map>
#include <optional>

#include "harness/cell.h"
#include "harness/frame.h"

namespace volumark {

struct TimedOut {
  std::string reason;
};

class FrameSampler {
 public:
  FrameSampler(const Experiment& experiment, const SceneContext& context, const std::atomic<bool>* stop);

  // Each throws TimedOut, Interrupted, and what the method and the Device throw. The Device outlives the sampler.
  // `scene`: that of the context, or without the effects that are ignored.
  void begin(const Scene& scene, const Method& method, const Values& values, Device& device, Result& result,
             std::map<int, Image>& images);
  bool pass();  // false: enough is known
  // Metrics and statistics of the samples so far, into `result`.
  void finish(Result& result) const;

 private:
  void first_frames(Result& result, std::map<int, Image>& images);
  void add(const FrameCost& frame, int view);
  bool precise() const;
  void check_limits() const;

  const Experiment& experiment_;
  const SceneContext& context_;
  const std::atomic<bool>* stop_;
  Metrics metrics_;
  std::optional<FrameSource> source_;
  double spent_ = 0, sampled_ = 0;  // seconds: in all, and in passes
  Instant entered_;                 // the call that is running
  int passes_ = 0, next_check_ = 0;
  bool drawn_ = false;
};

}  // namespace volumark
