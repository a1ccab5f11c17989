// What a run says while it works: one line a cell, and on a terminal a bar with the time left under it.
#pragma once

#include <cstdio>
#include <string>

#include "harness/clock.h"

namespace volumark {

class Progress {
 public:
  Progress(std::FILE* out, size_t cells);
  ~Progress();
  Progress(const Progress&) = delete;

  void line(const std::string& text);                           // a remark, outside of the count
  void cell(const std::string& name, const std::string& text);  // one more cell is done
  void skip() { ++skipped_; }                                   // a cell of an earlier run

 private:
  void bar();
  void clear_bar();
  std::FILE* out_;
  size_t cells_, done_ = 0, skipped_ = 0;
  bool terminal_;
  Instant started_;
};

std::string duration_text(double seconds);  // 12.3 ms, 4.5 s, 3 min 20 s

}  // namespace volumark
