// The volume as texels of the wanted format, whatever textures they go into. Volume data as stored where the format is
// the native one; otherwise converted once.
#pragma once

#include <span>
#include <vector>

#include "methods/volume/volume_resources.h"

namespace volumark {

struct VolumeTexels {
  Format format = Format::R32F;
  std::vector<std::byte> converted;  // empty: the voxels as they are stored
  // s_n = (texel - origin) * scale, with the texel as a texture returns it. Of scalars; classified texels are colours.
  float value_origin = 0, value_scale = 1;

  // size.x * size.y * size.z texels, x fastest; lives as long as both.
  std::span<const std::byte> of(const Volume& volume) const;
};

// Scalars in settings.volume_format, or with Classification::Pre associated colours (opacity over one smallest spacing)
// of as many bits a channel. `scene.volume` is loaded.
VolumeTexels volume_texels(const Scene& scene, const VolumeSettings& settings);

// Writes channel number `index` of texels of `format`: from 0..1 to nearest, or any value for float formats.
void put_channel(std::vector<std::byte>& texels, Format format, size_t index, double value);

}  // namespace volumark
