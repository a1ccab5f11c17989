#include "methods/volume/isosurface.h"

#include <cmath>
#include <glm/gtc/packing.hpp>

namespace volumark {

SurfaceUniforms surface_uniforms(const Scene& scene, const SurfaceTexels& texels) {
  const Isosurface& surface = *scene.isosurface;
  double value = (surface.value - scene.transfer.lo) / (scene.transfer.hi - scene.transfer.lo);
  const double origin = texels.value_origin, scale = texels.value_scale;
  if (texels.format == Format::R16F || texels.format == Format::RGBA16F) {
    const uint16_t stored = glm::packHalf1x16(static_cast<float>(value / scale + origin));
    value = (static_cast<double>(glm::unpackHalf1x16(stored)) - origin) * scale;
  }
  const double rounding = 0x1p-22 * (std::abs(value) + std::abs(origin * scale) + 1);
  const double ambient = scene.effects.lighting ? scene.effects.lighting->ambient : 0;
  const glm::dvec3 c = surface.colour, a = surface.ambient_colour * ambient;
  return {
      {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z), static_cast<float>(value - rounding)},
      {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z), 0},
      {texels.vector_scale, texels.vector_offset, 0, 0}};
}

DepthTarget::~DepthTarget() {
  for (const Texture texture : textures_) device_.destroy(texture);
}

Texture DepthTarget::of(int width, int height) {
  for (const Texture texture : textures_) {
    const TextureDesc& desc = device_.desc(texture);
    if (desc.width == width && desc.height == height) return texture;
  }
  TextureDesc desc;
  desc.label = "depth of slices";
  desc.format = Format::D32FS8;
  desc.width = width;
  desc.height = height;
  desc.target = true;
  textures_.push_back(device_.create_texture(desc));
  return textures_.back();
}

std::vector<float> drawing_depths(const std::vector<uint32_t>& indices, size_t vertices, int polygons) {
  std::vector<float> depths(vertices);
  int polygon = -1;
  uint32_t base = 0;
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    if (polygon < 0 || indices[i] != base) {
      base = indices[i];
      ++polygon;
    }
    const float depth = (static_cast<float>(polygon) + 0.5F) / static_cast<float>(polygons);
    for (size_t corner = i; corner < i + 3; ++corner) depths[indices[corner]] = depth;
  }
  return depths;
}

}  // namespace volumark
