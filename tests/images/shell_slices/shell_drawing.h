// Pictures of hand-made shells by the variants of methods/shell_slices, on the backend under test.
#pragma once

#include <initializer_list>
#include <utility>

#include "methods/method.h"
#include "methods/shell_slices/shell_frame.h"
#include "methods/shell_slices/shell_slices.h"
#include "scenes/image.h"
#include "scenes/shell.h"

namespace volumark {

Scene scene_of(const Shell& shell);

struct ShellPicture {
  Image image;
  Counters counters;
};
using Settings = std::initializer_list<std::pair<const char*, const char*>>;  // as --set name=value
// Of RGBA32F targets. Throws std::runtime_error where the method says unsupported.
ShellPicture draw_shell(Device& device, const Method& method, const Scene& scene, Settings settings, const View& view,
                        int width, int height);

// Largest difference over all channels, and how many pixels differ by more than `limit`.
struct ShellDifference {
  double max = 0;
  int over = 0;
};
ShellDifference difference(const Image& a, const Image& b, double limit);

}  // namespace volumark
