// Packets of one SIMD vector of rays, taken from neighbouring pixels of a batch. Include after march-inl.h.
#if defined(VOLUMARK_RAYCAST_PACKETS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMARK_RAYCAST_PACKETS_INL_H_
#undef VOLUMARK_RAYCAST_PACKETS_INL_H_
#else
#define VOLUMARK_RAYCAST_PACKETS_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {

// raycast.vert
inline void raycast_vertex(const CpuBindings&, VertexBatch& batch) {
  for (size_t i = 0; i < batch.count; ++i) {
    const uint32_t index = batch.vertex_index[i];
    const float x = index == 1 ? 3.0F : -1.0F;
    const float y = index == 2 ? 3.0F : -1.0F;
    const float position[4] = {x, y, 0, 1};
    std::memcpy(batch.position + 4 * i, position, sizeof(position));
    batch.varyings[batch.varying_stride * i] = x;
    batch.varyings[batch.varying_stride * i + 1] = y;
  }
}

struct Queue {
  alignas(64) int32_t ray[Rays::kCapacity];
  size_t count = 0;
};

// Rays that meet the volume, neighbours together. A batch is a block of rows of a tile: packets take 4 x 4 (or 4 x 2,
// 2 x 2) pixels of it. Any other order would be right too, only slower. The last packet is filled up with rays of no
// length.
inline void queue_rays(const FragmentBatch& batch, Rays& rays, Queue& queue) {
  size_t width = 1;
  while (width < batch.count && batch.y[width] == batch.y[0]) {
    ++width;
  }
  const size_t rows = (batch.count + width - 1) / width;
  const size_t lanes = hn::Lanes(FloatTag());
  const size_t block_width = lanes >= 8 ? 4 : 2;
  const size_t block_height = std::max<size_t>(lanes / block_width, 1);
  size_t count = 0;
  for (size_t top = 0; top < rows; top += block_height) {
    for (size_t left = 0; left < width; left += block_width) {
      for (size_t y = top; y < std::min(top + block_height, rows); ++y) {
        for (size_t x = left; x < std::min(left + block_width, width); ++x) {
          const size_t i = y * width + x;
          if (i < batch.count && rays.steps[i] > 0) queue.ray[count++] = static_cast<int32_t>(i);
        }
      }
    }
  }
  queue.count = count;
  rays.steps[kMaxBatch] = 0;
  for (int axis = 0; axis < 3; ++axis) rays.entry[axis][kMaxBatch] = rays.stride[axis][kMaxBatch] = 0;
  std::fill_n(queue.ray + count, lanes, static_cast<int32_t>(kMaxBatch));
}

inline void write(const Rgba& colour, const int32_t* fragments, size_t count, FragmentBatch& batch) {
  alignas(64) float rgba[4][kMaxLanes];
  store(colour.r, rgba[0]);
  store(colour.g, rgba[1]);
  store(colour.b, rgba[2]);
  store(colour.a, rgba[3]);
  for (size_t lane = 0; lane < count; ++lane) {
    for (int c = 0; c < 4; ++c) batch.rgba[c][fragments[lane]] = rgba[c][lane];
  }
}

template <bool clip_planes>
HWY_NOINLINE void set_up_batch(const VolumeUniforms& vm, FragmentBatch& batch, Rays& rays) {
  const Floats zero = splat(0.F);
  for_lanes(batch.count, [&](size_t i) HWY_ATTR {
    set_up_rays<clip_planes>(vm, load(batch.varyings[0] + i), load(batch.varyings[1] + i), i, rays);
    store_rgba(batch, i, {zero, zero, zero, zero});
  });
}
using SetUp = void (*)(const VolumeUniforms&, FragmentBatch&, Rays&);

}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#endif
