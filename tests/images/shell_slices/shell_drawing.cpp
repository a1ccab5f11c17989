#include "tests/images/shell_slices/shell_drawing.h"

#include <cmath>
#include <cstring>
#include <stdexcept>

namespace volumark {

Scene scene_of(const Shell& shell) {
  Scene scene;
  scene.name = "hand-made shell";
  scene.shell = std::make_shared<Shell>(shell);
  scene.display = Display::Shell;
  return scene;
}

ShellPicture draw_shell(Device& device, const Method& method, const Scene& scene, Settings settings, const View& view,
                        int width, int height) {
  Values values = default_values(method.info().parameters);
  for (const auto& [name, value] : settings) {
    set_value(method.info().parameters, values, name, std::string(value));
  }
  if (const auto why = method.unsupported(scene, values, device.info())) throw std::runtime_error(*why);
  TextureDesc desc;
  desc.label = "picture";
  desc.width = width;
  desc.height = height;
  desc.target = true;
  const Texture target = device.create_texture(desc);
  ShellPicture out;
  out.image = Image(width, height);
  {
    const auto prepared = method.prepare(scene, values, device);
    prepared->render(view, device, target);
    device.submit_and_wait();
    const std::vector<std::byte> texels = device.read_texture(target);
    std::memcpy(out.image.rgba.data(), texels.data(), texels.size());
    out.counters = prepared->counters();
  }
  device.destroy(target);
  return out;
}

ShellDifference difference(const Image& a, const Image& b, double limit) {
  ShellDifference out;
  for (size_t i = 0; i < a.rgba.size(); i += 4) {
    double worst = 0;
    for (size_t c = 0; c < 4; ++c) {
      const double d = std::abs(static_cast<double>(a.rgba[i + c]) - static_cast<double>(b.rgba[i + c]));
      worst = d <= worst ? worst : std::isnan(d) ? INFINITY : d;
    }
    out.max = std::max(out.max, worst);
    out.over += worst > limit ? 1 : 0;
  }
  return out;
}

}  // namespace volumark
