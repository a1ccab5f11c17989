// A logarithmic axis: from values to pixels, and where its ticks are.
#pragma once

#include <cmath>
#include <vector>

namespace volumark::html {

class LogAxis {
 public:
  // Holds lo..hi (positive) with a margin. `from` and `to` are the pixels of its two ends.
  LogAxis(double lo, double hi, double from, double to);

  double pixel(double value) const;  // values outside are put on the nearer end
  double lo() const { return std::pow(10, lo_); }
  double hi() const { return std::pow(10, hi_); }

  struct Tick {
    double value;
    bool labelled;
  };
  std::vector<Tick> ticks() const;

 private:
  double lo_, hi_, from_, to_;  // exponents, pixels
};

}  // namespace volumark::html
