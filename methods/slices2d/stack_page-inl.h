// The twin of stack_page.glsl on SIMD lanes. Include inside a foreach_target file.
#include "methods/volume/volume_twin-inl.h"

// After the sampler it is made of.
#include "methods/slices2d/tile_fetch-inl.h"

#if defined(VOLUMARK_METHODS_SLICES2D_STACK_PAGE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMARK_METHODS_SLICES2D_STACK_PAGE_INL_H_
#undef VOLUMARK_METHODS_SLICES2D_STACK_PAGE_INL_H_
#else
#define VOLUMARK_METHODS_SLICES2D_STACK_PAGE_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {

struct PageBindings : VolumeBindings {
  const CpuTexture& page;
  explicit PageBindings(const CpuBindings& bindings, size_t slot = 4)
      : VolumeBindings(bindings), page(bindings.textures[slot]) {}
};

// Texture coordinates of a slice alone.
struct Place {
  Floats x, y;
};
HWY_INLINE Place place_in_slice(const VolumeUniforms& vm, const Floats3& box) {
  return {hn::MulAdd(clamp01(box.x), splat(vm.texture_scale[0]), splat(vm.texture_offset[0])),
          hn::MulAdd(clamp01(box.y), splat(vm.texture_scale[1]), splat(vm.texture_offset[1]))};
}

// A tile of the page, in texels.
struct Tile {
  Floats x, y;
};
HWY_INLINE Tile tile_of(const VolumeUniforms& vm, float width, float height, Floats stored) {
  const Floats place = hn::Sub(stored, splat(vm.own[2][3])), columns = splat(vm.own[2][2]);
  // Half a tile away from the next row at least: a product finds the same row as the division of the GLSL.
  const Floats row = hn::Floor(hn::Mul(hn::Add(place, splat(.5F)), splat(1.F / vm.own[2][2])));
  return {hn::Mul(hn::NegMulAdd(row, columns, place), splat(width)), hn::Mul(row, splat(height))};
}

// texel_of: scalars of R8, R16 and R32F and vectors of RGBA32F by fast paths; everything else by the general sampler.
struct PageCell {
  Ints offset;  // of the lower left texel, in texels
  Floats fx, fy;
};
HWY_INLINE PageCell page_cell(const PageBindings& b, Floats stored, const Place& at) {
  const VolumeUniforms& vm = b.vm;
  const IntTag di;
  const FloatTag d;
  const Tile tile = tile_of(vm, vm.size[0] + 2, vm.size[1] + 2, stored);
  // Texel coordinates (centre of texel i at i) in the tile.
  const Floats tx = hn::MulAdd(at.x, splat(vm.size[0]), splat(.5F));
  const Floats ty = hn::MulAdd(at.y, splat(vm.size[1]), splat(.5F));
  const Ints ix = truncate(tx), iy = truncate(ty);
  const Ints row = hn::Add(iy, truncate(tile.y));
  return {hn::Add(hn::Add(ix, truncate(tile.x)), hn::Mul(row, hn::Set(di, static_cast<int32_t>(b.page.row_stride)))),
          hn::Sub(tx, hn::ConvertTo(d, ix)), hn::Sub(ty, hn::ConvertTo(d, iy))};
}

template <Format format>
struct ScalarPage {
  const PageBindings& b;
  HWY_INLINE Rgba operator()(Floats stored, const Place& at) const {
    const PageCell cell = page_cell(b, stored, at);
    alignas(64) int32_t index[kMaxLanes];
    hn::Store(cell.offset, IntTag(), index);
    keep_in_memory(index);
    const TileCells cells{b.page.data, b.page.row_stride, index, cell.fx, cell.fy};
    const Floats value = fetch_tile<format>(cells);
    return {value, value, value, value};
  }
};

struct VectorPage {
  const PageBindings& b;
  HWY_INLINE Rgba operator()(Floats stored, const Place& at) const {
    const PageCell cell = page_cell(b, stored, at);
    const auto* texels = reinterpret_cast<const float*>(b.page.data);
    return lerp(lerp_entries(texels, cell.offset, cell.fx),
                lerp_entries(texels + 4 * b.page.row_stride, cell.offset, cell.fx), cell.fy);
  }
};

struct AnyPage {
  const PageBindings& b;
  HWY_INLINE Rgba operator()(Floats stored, const Place& at) const {
    const VolumeUniforms& vm = b.vm;
    const Tile tile = tile_of(vm, vm.own[1][0], vm.own[1][1], stored);
    return sample_2d(b.page, hn::MulAdd(at.x, splat(vm.own[1][2]), hn::Add(tile.x, splat(vm.own[2][0]))),
                     hn::MulAdd(at.y, splat(vm.own[1][3]), hn::Add(tile.y, splat(vm.own[2][1]))));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#endif
