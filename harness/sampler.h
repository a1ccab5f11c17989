// The samples of one cell: which frames are drawn, timed and read back, and when enough is known.
// Pass 0 draws every view once, untimed but for the very first frame, and reads the pictures back. Then passes over all
// views, one frame each, until the interval of the median is narrow enough or the budget is spent.
#pragma once

#include <atomic>
#include <map>

#include "harness/cell.h"
#include "harness/frame.h"

namespace volumark {

struct TimedOut {
  std::string reason;
};

class FrameSampler {
 public:
  FrameSampler(const Experiment& experiment, const SceneContext& context, const std::atomic<bool>* stop);

  // Throws TimedOut, Interrupted, and what the method and the Device throw. Fills metrics and views of `result`.
  void run(const Method& method, const Values& values, Device& device, Result& result, std::map<int, Image>& images);
  // Statistics of the samples so far; run() ends with it.
  void finish(Result& result) const;

 private:
  void first_pass(FrameSource& source, Result& result, std::map<int, Image>& images);
  void timed_passes(FrameSource& source);
  void add(const FrameCost& frame, int view);
  bool precise() const;
  void check_limits() const;

  const Experiment& experiment_;
  const SceneContext& context_;
  const std::atomic<bool>* stop_;
  Instant started_;
  Metrics metrics_;
  bool drawn_ = false;
};

}  // namespace volumark
