// A child process that holds one Device and draws frames on request. Benchmarks of several backends and thread counts
// can so be interleaved in one run: drivers read their thread count once a process.
#pragma once

#include <functional>
#include <string>

#include "harness/frame.h"

namespace volumark::cli {

struct BenchFrame {
  double wall = 0, cpu = 0;
};

// Made in the child, once, before the first frame; returns the frame function. May throw.
using BenchSetup = std::function<std::function<BenchFrame()>()>;

class BenchWorker {
 public:
  BenchWorker() = default;
  ~BenchWorker();
  BenchWorker(const BenchWorker&) = delete;

  // Forks at the first call, with LP_NUM_THREADS set for `threads`. Throws std::runtime_error with the child's reason.
  BenchFrame frame(const BenchSetup& setup, int threads);

 private:
  void start(const BenchSetup& setup, int threads);
  int to_child_ = -1, from_child_ = -1, pid_ = -1;
};

}  // namespace volumark::cli
