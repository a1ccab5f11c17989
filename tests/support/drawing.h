// Pictures for tests: a scene from JSON text or by name, drawn by any method on any backend, and its reference.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>

#include "backends/device.h"
#include "methods/method.h"
#include "scenes/image.h"
#include "scenes/scene.h"

namespace volumark {

// Of a shipped scene, with its data; of a scene given as JSON text.
Scene shipped_scene(const std::string& name);
Scene scene_from_text(const std::string& text);

using Settings = std::initializer_list<std::pair<const char*, const char*>>;  // as --set name=value

struct Drawing {
  Image image;
  Counters counters;
};
// Throws what the method throws; std::runtime_error with the reason where the method says unsupported.
Drawing draw(Device& device, const Scene& scene, const std::string& method, Settings settings, const View& view,
             int width, int height);

// Root mean square and largest difference over all four channels.
struct Difference {
  double rmse = 0, max = 0;
  int x = -1, y = -1;  // of max
};
Difference difference(const Image& a, const Image& b);

}  // namespace volumark
