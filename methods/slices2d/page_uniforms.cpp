#include "methods/slices2d/page_uniforms.h"

#include <algorithm>
#include <glm/vec2.hpp>

namespace volumark {

std::vector<std::byte> page_blocks(const StackLayout& layout, VolumeUniforms uniforms) {
  std::vector<std::byte> blocks(kPageBlock * layout.pages.size());
  for (size_t i = 0; i < layout.pages.size(); ++i) {
    const StackPage& page = layout.pages[i];
    const glm::dvec2 texel = 1. / glm::dvec2(layout.extent(page));
    const glm::dvec2 tile = texel * glm::dvec2(layout.tile()), slice = texel * glm::dvec2(layout.slice);
    uniforms.own[1] = {static_cast<float>(tile.x), static_cast<float>(tile.y), static_cast<float>(slice.x),
                       static_cast<float>(slice.y)};
    uniforms.own[2] = {static_cast<float>(texel.x), static_cast<float>(texel.y), static_cast<float>(page.columns),
                       static_cast<float>(page.first)};
    uniforms.own[3][3] = static_cast<float>(page.last);
    const std::span<const std::byte> block = bytes_of(uniforms);
    std::copy(block.begin(), block.end(), blocks.begin() + static_cast<ptrdiff_t>(kPageBlock * i));
  }
  return blocks;
}

}  // namespace volumark
