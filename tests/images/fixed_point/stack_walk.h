// slices2d under the effect fixed_point once more, in plain scalar code for single pixels: no pages, no polygons, no
// turned frames. It shares with the programs the frame's uniforms, the texels and the palette (scalar_walk.h).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "methods/slices2d/fixed_slices2d.h"

namespace volumark {

class StackWalk {
 public:
  // Square pictures of `size` pixels. Several slices on a polygon: for eyes outside of the stack.
  StackWalk(const Scene& scene, const SliceSettings& settings, Classification classification, const View& view,
            int size);

  // Premultiplied colour and opacity of pixel (x, y), levels.
  std::array<int, 4> pixel(int x, int y) const;

 private:
  using Place = std::array<int, 3>;  // along the volume's axes, 1/256 of a texel
  bool inside(const Place& t) const;
  int texel(const Place& at, int channel) const;
  int filtered(const Place& t, int channel) const;
  std::array<int, 4> sample(const Place& t) const;

  SliceSettings settings_;
  size_t axis_, across_[2];  // of the stack, and along its slices
  FixedUniforms fx_;
  Slices slices_;
  float near_;
  glm::ivec3 size_;
  int channels_;
  std::vector<uint8_t> texels_, palette_;
};

}  // namespace volumark
