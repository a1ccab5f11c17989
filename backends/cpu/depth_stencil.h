// The depth and stencil test of one fragment, as OpenGL 4.5 section 17.3.3 and 17.3.4 define them.
#pragma once

#include "backends/types.h"

namespace volumark {

template <class T>
bool compare_passes(Compare compare, T value, T stored) {
  switch (compare) {
    case Compare::Never:
      return false;
    case Compare::Less:
      return value < stored;
    case Compare::Equal:
      return value == stored;
    case Compare::LessEqual:
      return value <= stored;
    case Compare::Greater:
      return value > stored;
    case Compare::NotEqual:
      return value != stored;
    case Compare::GreaterEqual:
      return value >= stored;
    case Compare::Always:
      break;
  }
  return true;
}

inline uint8_t apply_stencil_op(StencilOp op, uint8_t stored, uint8_t reference) {
  switch (op) {
    case StencilOp::Keep:
      break;
    case StencilOp::Zero:
      return 0;
    case StencilOp::Replace:
      return reference;
    case StencilOp::IncrementClamp:
      return stored == 0xff ? stored : static_cast<uint8_t>(stored + 1);
    case StencilOp::DecrementClamp:
      return stored == 0 ? stored : static_cast<uint8_t>(stored - 1);
    case StencilOp::Invert:
      return static_cast<uint8_t>(~stored);
    case StencilOp::IncrementWrap:
      return static_cast<uint8_t>(stored + 1);
    case StencilOp::DecrementWrap:
      return static_cast<uint8_t>(stored - 1);
  }
  return stored;
}

// Whether the fragment passes; updates the stored values either way.
inline bool depth_stencil_test(const PipelineDesc& pipeline, bool front, float z, float& depth, uint8_t& stencil) {
  const StencilFace& face = front ? pipeline.stencil_front : pipeline.stencil_back;
  const auto update = [&](StencilOp op) {
    if (pipeline.stencil_test) {
      const uint8_t value = apply_stencil_op(op, stencil, pipeline.stencil_reference);
      const uint8_t mask = pipeline.stencil_write_mask;
      stencil = static_cast<uint8_t>((stencil & ~mask) | (value & mask));
    }
  };
  if (pipeline.stencil_test) {
    const uint8_t mask = pipeline.stencil_read_mask;
    if (!compare_passes<int>(face.compare, pipeline.stencil_reference & mask, stencil & mask)) {
      update(face.fail);
      return false;
    }
  }
  if (pipeline.depth_test && !compare_passes(pipeline.depth_compare, z, depth)) {
    update(face.depth_fail);
    return false;
  }
  update(face.pass);
  if (pipeline.depth_test && pipeline.depth_write) {
    depth = z;
  }
  return true;
}

}  // namespace volumark
