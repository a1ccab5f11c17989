#include "backends/cpu/tile_raster.h"

#include <bit>

#include "backends/cpu/depth_stencil.h"
#include "backends/cpu/highway_targets.h"
#include "backends/cpu/texel.h"
#include "backends/cpu/tile_memory.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "backends/cpu/tile_raster.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "backends/cpu/sample-inl.h"
// After the lanes they are written in.
#include "backends/cpu/blend-inl.h"
#include "backends/cpu/coverage-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {
namespace {

// A plane moved to the tile: value at the centre of the tile's pixel (0, 0).
struct TilePlane {
  float value, dx, dy;
};

class TileRaster {
 public:
  TileRaster(const PassWork& work, int tile_x, int tile_y, TileScratch& scratch)
      : work_(work), scratch_(scratch), queue_(scratch.queue), origin_x_(tile_x * kTile), origin_y_(tile_y * kTile) {
    queue_.count = queue_.run_count = 0;
    std::fill_n(queue_.occupied, kTile, 0U);
  }

  void draw(const Triangle& triangle) {
    TileCoverage coverage;
    if (!cover_tile(triangle, origin_x_, origin_y_, coverage)) {
      return;
    }
    begin(triangle);
    for (int row = coverage.first_row; row < coverage.end_row; ++row) {
      uint32_t mask = coverage.rows[row];
      if (mask != 0 && early_tests_) {
        mask = test_row(row, mask, triangle.front);
      }
      if (mask != 0 && early_rejection_ && planes_[0].dx == 0 && planes_[0].dy == 0) {
        mask = reject_row(row, mask);
      }
      // Without tests a triangle covers one run a row; tests may break it up.
      while (mask != 0 && (state_->pipeline.colour_write || !early_tests_)) {
        const int start = std::countr_zero(mask);
        const int length = std::countr_one(mask >> start);
        add_run(triangle, row, start, length);
        mask &= length == 32 ? 0U : ~(((1U << length) - 1) << start);
      }
    }
  }

  void flush() {
    const size_t count = queue_.count;
    if (count == 0) {
      return;
    }
    const CpuKernels& kernels = state_->kernels;
    pad(count);
    FragmentBatch batch;
    batch.count = count;
    batch.x = queue_.x;
    batch.y = queue_.y;
    batch.z = kernels.reads_depth ? queue_.z : nullptr;
    for (int i = 0; i < kernels.varyings; ++i) {
      batch.varyings[i] = queue_.varyings[i];
    }
    for (int i = 0; i < 4; ++i) {
      batch.rgba[i] = queue_.rgba[i];
    }
    batch.front_facing = queue_.front;
    batch.discard = queue_.discard;
    if (kernels.discards) {
      std::fill_n(queue_.discard, FragmentQueue::kSize, uint8_t{0});
    }
    kernels.fragment(state_->bindings, batch);
    if (kernels.discards && state_->tests_depth_stencil) {
      late_tests();
    }
    if (state_->pipeline.colour_write) {
      blend_(queue_, scratch_, kernels.discards ? queue_.discard : nullptr);
    }
    queue_.count = queue_.run_count = 0;
    std::fill_n(queue_.occupied, kTile, 0U);
  }

 private:
  void begin(const Triangle& triangle) {
    const DrawState* state = work_.draws[triangle.draw].get();
    const bool facing_matters = state->kernels.reads_front_facing || state->pipeline.stencil_test;
    if (state != state_ || (facing_matters && triangle.front != queue_.front)) {
      flush();
    }
    if (state != state_) {
      state_ = state;
      blend_ = blend_function(state->pipeline.colour_format, state->pipeline.blend);
      early_tests_ = state->tests_depth_stencil && !state->kernels.discards;
      early_rejection_ = rejects_early(*state);
      needs_z_ = state->kernels.reads_depth || state->tests_depth_stencil;
    }
    queue_.front = triangle.front;
    const size_t count = 2 + static_cast<size_t>(state->kernels.varyings);
    const Plane* planes = work_.planes.data() + triangle.first_plane;
    const double dx = origin_x_ + 0.5 - triangle.reference_x;
    const double dy = origin_y_ + 0.5 - triangle.reference_y;
    for (size_t i = 0; i < count; ++i) {
      planes_[i] = {static_cast<float>(planes[i].value + dx * planes[i].dx + dy * planes[i].dy), planes[i].dx,
                    planes[i].dy};
    }
  }

  float depth_at(int column, int row) const {
    const TilePlane& z = planes_[0];
    const float value = z.value + z.dx * static_cast<float>(column) + z.dy * static_cast<float>(row);
    return std::clamp(value, 0.0F, 1.0F);
  }

  // Fragments that may be dropped by their program are tested behind it. One that fails now fails then too, where what
  // is written meanwhile can only bring the stored depth farther from passing; and nothing happens where it fails. Only
  // polygons of one depth: on others the two tests may round differently.
  static bool rejects_early(const DrawState& state) {
    const Compare compare = state.pipeline.depth_compare;
    const bool one_way = compare == Compare::Less || compare == Compare::LessEqual || compare == Compare::Greater ||
                         compare == Compare::GreaterEqual;
    return state.kernels.discards && state.pipeline.depth_test && !state.pipeline.stencil_test && one_way;
  }
  uint32_t reject_row(int row, uint32_t mask) const {
    const float z = depth_at(0, row);
    uint32_t passed = 0;
    for (uint32_t left = mask; left != 0; left &= left - 1) {
      const int column = std::countr_zero(left);
      if (compare_passes(state_->pipeline.depth_compare, z, scratch_.depth[row * kTile + column])) {
        passed |= 1U << column;
      }
    }
    return passed;
  }

  // Early depth and stencil: which pixels of the row survive.
  uint32_t test_row(int row, uint32_t mask, bool front) {
    uint32_t passed = 0;
    for (uint32_t left = mask; left != 0; left &= left - 1) {
      const int column = std::countr_zero(left);
      const int pixel = row * kTile + column;
      if (depth_stencil_test(state_->pipeline, front, depth_at(column, row), scratch_.depth[pixel],
                             scratch_.stencil[pixel])) {
        passed |= 1U << column;
      }
    }
    return passed;
  }

  void late_tests() {
    for (size_t r = 0; r < queue_.run_count; ++r) {
      const FragmentQueue::Run run = queue_.runs[r];
      for (size_t k = 0; k < run.count; ++k) {
        const size_t i = run.first + k;
        if (queue_.discard[i] == 0 &&
            !depth_stencil_test(state_->pipeline, queue_.front, queue_.z[i], scratch_.depth[run.pixel + k],
                                scratch_.stencil[run.pixel + k])) {
          queue_.discard[i] = 1;
        }
      }
    }
  }

  // Queues pixels [start, start + length) of a row.
  void add_run(const Triangle& triangle, int row, int start, int length) {
    const uint32_t mask = (length == 32 ? ~0U : (1U << length) - 1) << start;
    if ((queue_.occupied[row] & mask) != 0 || queue_.count + static_cast<size_t>(length) > kMaxBatch) {
      flush();
    }
    queue_.occupied[row] |= mask;
    const auto pixel = static_cast<uint16_t>(row * kTile + start);
    if (queue_.run_count > 0 &&
        queue_.runs[queue_.run_count - 1].pixel + queue_.runs[queue_.run_count - 1].count == pixel) {
      queue_.runs[queue_.run_count - 1].count += static_cast<uint16_t>(length);
    } else {
      queue_.runs[queue_.run_count++] = {static_cast<uint16_t>(queue_.count), pixel, static_cast<uint16_t>(length)};
    }
    interpolate(triangle, row, start, length);
    queue_.count += static_cast<size_t>(length);
  }

  void interpolate(const Triangle& triangle, int row, int start, int length) {
    const FloatTag d;
    const auto frow = static_cast<float>(row);
    const int varyings = state_->kernels.varyings;
    const Floats y = hn::Set(d, static_cast<float>(origin_y_ + row) + 0.5F);
    const auto at_row = [&](const TilePlane& plane) { return plane.value + plane.dy * frow; };
    for (size_t k = 0; k < static_cast<size_t>(length); k += hn::Lanes(d)) {
      const Floats column = hn::Iota(d, static_cast<float>(start) + static_cast<float>(k));
      const size_t to = queue_.count + k;
      hn::StoreU(hn::Add(column, hn::Set(d, static_cast<float>(origin_x_) + 0.5F)), d, queue_.x + to);
      hn::StoreU(y, d, queue_.y + to);
      const auto value = [&](const TilePlane& plane)
                             HWY_ATTR { return hn::MulAdd(column, hn::Set(d, plane.dx), hn::Set(d, at_row(plane))); };
      if (needs_z_) {
        hn::StoreU(clamp_unit(value(planes_[0])), d, queue_.z + to);
      }
      if (triangle.perspective) {
        const Floats w = hn::Div(hn::Set(d, 1.0F), value(planes_[1]));
        for (int i = 0; i < varyings; ++i) {
          hn::StoreU(hn::Mul(value(planes_[i + 2]), w), d, queue_.varyings[i] + to);
        }
      } else {
        for (int i = 0; i < varyings; ++i) {
          hn::StoreU(value(planes_[i + 2]), d, queue_.varyings[i] + to);
        }
      }
    }
  }

  // Repeats the last fragment up to the next multiple of the padding: kernels need no masked tail.
  void pad(size_t count) {
    if (count % kBatchPadding == 0) {
      return;
    }
    const auto repeat = [&](float* values) {
      std::fill(values + count, values + (count + kBatchPadding - 1) / kBatchPadding * kBatchPadding,
                values[count - 1]);
    };
    repeat(queue_.x);
    repeat(queue_.y);
    if (needs_z_) {
      repeat(queue_.z);
    }
    for (int i = 0; i < state_->kernels.varyings; ++i) {
      repeat(queue_.varyings[i]);
    }
  }

  const PassWork& work_;
  TileScratch& scratch_;
  FragmentQueue& queue_;
  const int origin_x_, origin_y_;
  const DrawState* state_ = nullptr;
  BlendFunction blend_ = nullptr;
  bool early_tests_ = false, early_rejection_ = false, needs_z_ = false;
  TilePlane planes_[kMaxVaryings + 2];
};

void raster_tile_impl(const PassWork& work, int tile_x, int tile_y, TileScratch& scratch) {
  const size_t tile = static_cast<size_t>(tile_y) * static_cast<size_t>(work.tiles_x) + static_cast<size_t>(tile_x);
  const uint32_t begin = work.bin_starts[tile], end = work.bin_starts[tile + 1];
  if (begin == end && !work.desc.clear_colour && (work.depth_stencil == nullptr || !work.desc.clear_depth_stencil)) {
    return;
  }
  load_tile(work, tile_x, tile_y, scratch);
  TileRaster raster(work, tile_x, tile_y, scratch);
  for (uint32_t i = begin; i < end; ++i) {
    raster.draw(work.triangles[work.bin_entries[i]]);
  }
  raster.flush();
  store_tile(work, tile_x, tile_y, scratch);
}

int simd_bits_impl() { return static_cast<int>(hn::Lanes(hn::ScalableTag<float>())) * 32; }
const char* simd_name_impl() { return hwy::TargetName(HWY_TARGET); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumark {
HWY_EXPORT(raster_tile_impl);
HWY_EXPORT(simd_bits_impl);
HWY_EXPORT(simd_name_impl);

void raster_tile(const PassWork& work, int tile_x, int tile_y, TileScratch& scratch) {
  HWY_DYNAMIC_DISPATCH(raster_tile_impl)(work, tile_x, tile_y, scratch);
}
bool simd_supported() { return (hwy::SupportedTargets() & HWY_TARGETS) != 0; }
int chosen_simd_bits() { return HWY_DYNAMIC_DISPATCH(simd_bits_impl)(); }
const char* chosen_simd_name() { return HWY_DYNAMIC_DISPATCH(simd_name_impl)(); }
}  // namespace volumark
#endif
