// The effect fixed_point once more, in plain scalar code for single pixels: what the programs on SIMD lanes and GPUs
// must give bit for bit. It shares with them the uniforms, the texels and the palette, which other tests hold against
// the scene's geometry and against the transfer function.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "methods/volume/fixed_point.h"

namespace volumark {

using Levels = std::array<int, 4>;  // premultiplied colour, opacity

class ScalarWalk {
 public:
  ScalarWalk(const Scene& scene, const FixedSettings& settings, const View& view, int size);

  // Pixel (x, y) of slices blended over each other, and of a ray.
  Levels back_to_front(int x, int y) const;
  Levels along_ray(int x, int y) const;
  // Texel coordinates at `depth` world units in front of the eye's plane.
  glm::dvec3 position(int x, int y, double depth) const;

 private:
  struct Pixel {
    std::array<float, 3> origin, direction;
  };
  Pixel pixel_of(int x, int y) const;
  std::array<int, 3> place(const Pixel& pixel, float z) const;
  Levels sample(const std::array<int, 3>& t) const;
  int texel(int x, int y, int z, int channel) const;
  int filtered(const std::array<int, 3>& t, int channel) const;
  std::array<int, 3> lit(const std::array<int, 3>& colour, const std::array<int, 3>& normal) const;

  FixedUniforms fx_;
  FixedDepths depths_;
  double reference_depth_;
  glm::ivec3 size_;
  int channels_;
  std::vector<uint8_t> texels_, palette_;
};

}  // namespace volumark
