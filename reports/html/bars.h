// Horizontal bars as HTML: they fit any width, and each filling has a pattern of its own, so that they read without
// colour.
#pragma once

#include <string>
#include <vector>

namespace volumark::html {

inline constexpr size_t kPatterns = 8;

// A bar of `share` of its place (0..1, clamped), with its words after it.
std::string bar(double share, size_t pattern, const std::string& words);

// A bar that ends at its bound: the line at three quarters is 1, what is beyond it is hatched. Infinite fills it.
std::string bound_bar(double share);

// The square of a legend.
std::string swatch(size_t pattern);

struct Segment {
  double share = 0;  // of the whole; below 0: drawn to the left of zero
  size_t pattern = 0;
  std::string letter, title;
};
// Positive parts one after another from zero to the right, negative ones to the left, where the bar is cut at -1 and an
// arrow says so; a line marks 1.
std::string stacked_bar(const std::vector<Segment>& segments);

}  // namespace volumark::html
