// The gradients of the volume as texels: gradient in RGB, and with it the value or the opacity in alpha
// (rezksalama2000, sections 7 and 8). Gradients are those of scenes/scene.h at the samples.
#pragma once

#include <string>
#include <vector>

#include "methods/volume/volume_resources.h"

namespace volumark {

enum class GradientAlpha : uint8_t {
  None,     // 0
  Scalar,   // the value: s_n = (alpha - value_origin) * value_scale
  Opacity,  // of the transfer function at the voxel, over one smallest spacing
};

struct GradientSettings {
  // false: gradients in the unit of sample_gradient() in volume_common.glsl (change of s_n over two smallest spacings),
  // for programs that normalise what they interpolate. true: normals, -g / max(|g|, floor) at the sample, as the boards
  // of 2000 stored them.
  bool normals = false;
  GradientAlpha alpha = GradientAlpha::Scalar;
  std::string format = "rgba32f";  // "rgba32f", "rgba16f" or "rgba8"
};

struct GradientTexels {
  Format format = Format::RGBA32F;
  std::vector<std::byte> texels;  // size.x * size.y * size.z, x fastest; vectors along the volume's own axes
  // The vector: texel * scale + offset; not 1 and 0 only where texels have no sign (RGBA8).
  float scale = 1, offset = 0;
  float value_origin = 0, value_scale = 1;  // with GradientAlpha::Scalar
};

// `scene.volume` is loaded.
GradientTexels gradient_texels(const Scene& scene, const GradientSettings& settings);

}  // namespace volumark
