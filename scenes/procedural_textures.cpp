#include "scenes/procedural_textures.h"

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

#include "scenes/texture_painters.h"

namespace volumark {
namespace {

struct Painter {
  const char* kind;
  void (*paint)(TextureCanvas& canvas, uint32_t seed);
};
constexpr std::array kPainters{
    Painter{"egg_torus", paint_egg_torus}, Painter{"outdoor", paint_outdoor}, Painter{"chain", paint_chain},
    Painter{"car_park", paint_car_park},   Painter{"volcano", paint_volcano}, Painter{"fur", paint_fur},
};

constexpr auto kKinds = [] {
  std::array<const char*, kPainters.size()> names{};
  for (size_t i = 0; i < names.size(); ++i) names[i] = kPainters[i].kind;
  return names;
}();

}  // namespace

std::span<const char* const> texture_kinds() { return kKinds; }

ShellTexture TextureCanvas::finish(double extinction) const {
  ShellTexture texture;
  texture.size = size_;
  texture.texels.reserve(texels_.size());
  for (const glm::dvec4& texel : texels_) texture.texels.emplace_back(texel * extinction);
  return texture;
}

ShellTexture make_texture(const TextureSpec& spec) {
  for (int axis = 0; axis < 3; ++axis) {
    if (spec.size[axis] < 1 || spec.size[axis] > 1024) throw std::invalid_argument("shell texture: size out of range");
  }
  for (const Painter& painter : kPainters) {
    if (std::string_view(painter.kind) != spec.kind) continue;
    TextureCanvas canvas(spec.size);
    painter.paint(canvas, spec.seed);
    return canvas.finish(spec.extinction);
  }
  throw std::invalid_argument("shell texture: unknown kind " + std::string(spec.kind));
}

}  // namespace volumark
