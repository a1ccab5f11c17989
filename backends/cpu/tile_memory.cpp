#include "backends/cpu/tile_memory.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "backends/cpu/texel.h"

namespace volumark {
namespace {

struct TileRect {
  int x, y, width, height;  // pixels of the target
};

TileRect tile_rect(const PassWork& work, int tile_x, int tile_y) {
  const int x = tile_x * kTile, y = tile_y * kTile;
  return {x, y, std::min(kTile, work.width - x), std::min(kTile, work.height - y)};
}

// What 1 is in the tile's planes: 8-bit targets are held in levels, so that blending is exact in them (blend-inl.h).
float unit_of(Format format) {
  return format == Format::R8 || format == Format::RG8 || format == Format::RGBA8 ? 255.0F : 1.0F;
}
float to_plane(float value, float unit) { return unit == 1 ? value : std::nearbyintf(value * unit); }

void clear_colour(const PassWork& work, TileScratch& scratch) {
  const Format format = work.colour->format();
  const auto& value = work.desc.colour_value;
  std::byte texel[16] = {};
  cpu::encode_texel(format, {value[0], value[1], value[2], value[3]}, texel);
  CpuTexture one;
  one.data = texel;
  one.format = format;
  const int32_t at = 0;
  float rgba[4];
  cpu::decode_texels(one, &at, 1, rgba, rgba + 1, rgba + 2, rgba + 3);
  for (int c = 0; c < 4; ++c) {
    std::fill_n(scratch.colour[c], kTilePixels, to_plane(rgba[c], unit_of(format)));
  }
}

void load_colour(const PassWork& work, const TileRect& rect, TileScratch& scratch) {
  const CpuTexture texture = work.colour->view({});
  const float unit = unit_of(texture.format);
  int32_t at[kTile];
  for (int row = 0; row < rect.height; ++row) {
    for (int i = 0; i < rect.width; ++i) {
      at[i] = static_cast<int32_t>((rect.y + row) * texture.row_stride) + rect.x + i;
    }
    const int to = row * kTile;
    cpu::decode_texels(texture, at, static_cast<size_t>(rect.width), scratch.colour[0] + to, scratch.colour[1] + to,
                       scratch.colour[2] + to, scratch.colour[3] + to);
    for (int c = 0; c < 4 && unit != 1; ++c) {
      for (int i = to; i < to + rect.width; ++i) scratch.colour[c][i] = to_plane(scratch.colour[c][i], unit);
    }
  }
}

}  // namespace

void load_tile(const PassWork& work, int tile_x, int tile_y, TileScratch& scratch) {
  const TileRect rect = tile_rect(work, tile_x, tile_y);
  if (work.desc.clear_colour) {
    clear_colour(work, scratch);
  } else {
    load_colour(work, rect, scratch);
  }
  if (work.depth_stencil == nullptr) {
    return;
  }
  if (work.desc.clear_depth_stencil) {
    std::fill_n(scratch.depth, kTilePixels, work.desc.depth_value);
    std::fill_n(scratch.stencil, kTilePixels, work.desc.stencil_value);
    return;
  }
  for (int row = 0; row < rect.height; ++row) {
    const ptrdiff_t from = (rect.y + row) * work.depth_stencil->row_stride() + rect.x;
    std::copy_n(work.depth_stencil->depth_plane() + from, rect.width, scratch.depth + row * kTile);
    std::copy_n(work.depth_stencil->stencil_plane() + from, rect.width, scratch.stencil + row * kTile);
  }
}

void store_tile(const PassWork& work, int tile_x, int tile_y, const TileScratch& scratch) {
  const TileRect rect = tile_rect(work, tile_x, tile_y);
  const Format format = work.colour->format();
  const size_t texel = texel_bytes(format);
  const float unit = unit_of(format);
  for (int row = 0; row < rect.height; ++row) {
    std::byte* to =
        work.colour->texels() + static_cast<size_t>((rect.y + row) * work.colour->row_stride() + rect.x) * texel;
    for (int i = 0; i < rect.width; ++i, to += texel) {
      const int pixel = row * kTile + i;
      cpu::encode_texel(format,
                        {scratch.colour[0][pixel] / unit, scratch.colour[1][pixel] / unit,
                         scratch.colour[2][pixel] / unit, scratch.colour[3][pixel] / unit},
                        to);
    }
  }
  if (work.depth_stencil == nullptr) {
    return;
  }
  for (int row = 0; row < rect.height; ++row) {
    const ptrdiff_t to = (rect.y + row) * work.depth_stencil->row_stride() + rect.x;
    std::copy_n(scratch.depth + row * kTile, rect.width, work.depth_stencil->depth_plane() + to);
    std::copy_n(scratch.stencil + row * kTile, rect.width, work.depth_stencil->stencil_plane() + to);
  }
}

}  // namespace volumark
