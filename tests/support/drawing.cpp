#include "tests/support/drawing.h"

#include <cmath>
#include <stdexcept>

#include "harness/frame.h"
#include "scenes/scene_io.h"

namespace volumark {

Scene shipped_scene(const std::string& name) { return load_scene(name, data_options_from_environment()); }

Scene scene_from_text(const std::string& text) {
  Scene scene = parse_scene(text, "test.json");
  load_data(scene, data_options_from_environment());
  return scene;
}

Drawing draw(Device& device, const Scene& scene, const std::string& method_name, Settings settings, const View& view,
             int width, int height) {
  const Method& method = find_method(method_name);
  Values values = default_values(method.info().parameters);
  for (const auto& [name, value] : settings) {
    set_value(method.info().parameters, values, name, std::string(value));
  }
  if (const auto why = unsupported_reason(method, scene, values, device.info())) throw std::runtime_error(*why);
  FrameSource source(scene, method, values, device, width, height);
  source.frame(view);
  return {source.read_back(), source.counters()};
}

Difference difference(const Image& a, const Image& b) {
  Difference out;
  double squares = 0;
  for (size_t i = 0; i < a.rgba.size(); ++i) {
    const double d = std::abs(static_cast<double>(a.rgba[i]) - static_cast<double>(b.rgba[i]));
    squares += d * d;
    if (!(d <= out.max)) {  // a NaN is the worst
      out.max = std::isnan(d) ? INFINITY : d;
      out.x = static_cast<int>(i / 4) % a.width;
      out.y = static_cast<int>(i / 4) / a.width;
    }
  }
  out.rmse = std::sqrt(squares / static_cast<double>(a.rgba.size()));
  return out;
}

}  // namespace volumark
