// The uniform blocks of a stack's pages in one buffer, as stack_page.glsl reads them.
#pragma once

#include <cstddef>
#include <vector>

#include "methods/slices2d/stacks.h"

namespace volumark {

// Bytes from the block of one page to that of the next.
inline constexpr size_t kPageBlock = (sizeof(VolumeUniforms) + 255) / 256 * 256;

// The block of each page of the stack, kPageBlock bytes apart: `uniforms` (turned into the stack's frame) with own[1],
// own[2] and own[3][3] set to what the page needs.
std::vector<std::byte> page_blocks(const StackLayout& layout, VolumeUniforms uniforms);

// The block of `page` in a buffer of page_blocks().
inline Binding bind_page_block(Buffer blocks, int page) {
  return bind_uniform(0, blocks, kPageBlock * static_cast<size_t>(page), sizeof(VolumeUniforms));
}

}  // namespace volumark
