// Draws strips (strips.h) with a fragment program: pipeline, buffers and one draw a run of strips from one page.
#pragma once

#include "backends/device.h"
#include "methods/method.h"
#include "methods/slices2d/strips.h"
#include "methods/volume/growing_buffer.h"

namespace volumark {

namespace stack_parameters {

inline const Choice kWeights{"weights",
                             "of the two stored slices beside a strip; corners: given at its corners and interpolated "
                             "over it; pixels: from each pixel's own place",
                             {"corners", "pixels"},
                             "corners"};

}  // namespace stack_parameters

class StripDrawing {
 public:
  // `program`: fragment stage alone, bindings of SliceStacks, constants, twin. `stacks` lives longer.
  StripDrawing(const SliceStacks& stacks, ProgramDesc program, Blend blend, Format target, Device& device);
  ~StripDrawing();
  StripDrawing(const StripDrawing&) = delete;
  StripDrawing& operator=(const StripDrawing&) = delete;

  // Clears `target` and draws. `uniforms`: in the frame of the stack of `axis`; the rest is put in here (page_blocks).
  void draw(const StripBuilder& strips, int axis, const VolumeUniforms& uniforms, Texture target);
  // What `strips` are, and the textures.
  Counters counters(const StripBuilder& strips, int axis) const;

 private:
  const SliceStacks& stacks_;
  Device& device_;
  GrowingBuffer uniforms_, vertices_, indices_;
  Program program_;
  Pipeline pipeline_;
};

}  // namespace volumark
