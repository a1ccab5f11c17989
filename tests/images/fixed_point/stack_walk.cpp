#include "tests/images/fixed_point/stack_walk.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>

namespace volumark {
namespace {

int product(int a, int b) {
  const int p = a * b;
  return (p + (p >> 8) + 128) >> 8;
}

void blend(const std::array<int, 4>& over, std::array<int, 4>& sum) {
  for (size_t c = 0; c < 4; ++c) sum[c] = std::min(over[c] + product(sum[c], 255 - over[3]), 255);
}

float reciprocal(float x) {
  const float magnitude = std::max(std::abs(x), 1e-12F);
  float r = std::bit_cast<float>(0x7ef311c7 - std::bit_cast<int32_t>(magnitude));
  for (int i = 0; i < 4; ++i) r = r * (2 - magnitude * r);
  return x < 0 ? -r : r;
}

}  // namespace

StackWalk::StackWalk(const Scene& scene, const SliceSettings& settings, Classification classification, const View& view,
                     int size)
    : settings_(settings), fx_(fixed_uniforms(scene, view, size, size, 1)), size_(scene.volume->size) {
  const ViewRays rays = view_rays(*scene.volume, view, size, size);
  const int axis = best_stack(*scene.volume, rays);
  axis_ = static_cast<size_t>(axis);
  across_[0] = (axis_ + 1) % 3;
  across_[1] = (axis_ + 2) % 3;
  near_ = static_cast<float>(rays.z_near);
  slices_ = slices_of(size_[axis], settings.percent);
  channels_ = classification == Classification::Pre ? 4 : 1;
  const FixedSettings fixed{classification, false, slab_thickness(*scene.volume, axis, settings.percent)};
  texels_ = fixed_texels(scene, fixed);
  palette_ = fixed_palette(scene, fixed);
}

bool StackWalk::inside(const Place& t) const {
  for (size_t i = 0; i < 3; ++i)
    if (t[i] < 0 || t[i] > static_cast<int>(fx_.limit[i])) return false;
  for (size_t p = 0; p < static_cast<size_t>(fx_.counts[1]); ++p) {
    const Float4& plane = fx_.clip_planes[p];
    const auto term = [&](size_t i) { return plane[i] * static_cast<float>(t[i]); };
    if ((term(across_[0]) + term(across_[1])) + term(axis_) < plane[3]) return false;
  }
  return true;
}

int StackWalk::texel(const Place& at, int channel) const {
  const glm::ivec3 p = glm::clamp(glm::ivec3(at[0], at[1], at[2]), glm::ivec3(0), size_ - 1);
  return texels_[static_cast<size_t>(((p.z * size_.y + p.y) * size_.x + p.x) * channels_ + channel)];
}

int StackWalk::filtered(const Place& t, int channel) const {
  const auto between = [](int a, int b, int f) { return a + (((b - a) * (f & 255) + 128) >> 8); };
  const auto corner = [&](int x, int y, int z) {
    Place at{};
    at[across_[0]] = (t[across_[0]] >> 8) + x;
    at[across_[1]] = (t[across_[1]] >> 8) + y;
    at[axis_] = (t[axis_] >> 8) + z;
    return texel(at, channel);
  };
  const auto row = [&](int y, int z) { return between(corner(0, y, z), corner(1, y, z), t[across_[0]]); };
  const auto slice = [&](int z) { return between(row(0, z), row(1, z), t[across_[1]]); };
  return between(slice(0), slice(1), t[axis_]);
}

std::array<int, 4> StackWalk::sample(const Place& t) const {
  if (!inside(t)) return {};
  if (channels_ == 4) return {filtered(t, 0), filtered(t, 1), filtered(t, 2), filtered(t, 3)};
  const uint8_t* entry = palette_.data() + 4 * filtered(t, 0);
  return {product(entry[0], entry[3]), product(entry[1], entry[3]), product(entry[2], entry[3]), entry[3]};
}

std::array<int, 4> StackWalk::pixel(int x, int y) const {
  const float wx = static_cast<float>(x) + 0.5F, wy = static_cast<float>(y) + 0.5F;
  std::array<float, 3> origin{}, direction{};
  for (size_t i = 0; i < 3; ++i) {
    origin[i] = (fx_.origin[i] + wx * fx_.origin_x[i]) + wy * fx_.origin_y[i];
    direction[i] = (fx_.direction[i] + wx * fx_.direction_x[i]) + wy * fx_.direction_y[i];
  }
  const float inverse = reciprocal(direction[axis_]);
  const int cells = std::max(slices_.stored - 1, 1);
  const auto first = static_cast<float>(slices_.first * cells), distance = static_cast<float>(slices_.distance * cells);
  struct Slice {
    float z, stored;
  };
  std::vector<Slice> order;
  for (int k = 0; k < slices_.count; ++k) {
    const float stored = first + static_cast<float>(k) * distance;
    order.push_back({(stored - origin[axis_]) * inverse, stored});
  }
  std::stable_sort(order.begin(), order.end(), [](const Slice& a, const Slice& b) { return a.z > b.z; });
  std::array<int, 4> target{};
  for (size_t group = 0; group < order.size(); group += static_cast<size_t>(settings_.textures)) {
    std::array<int, 4> polygon{};
    float z = 0;
    for (size_t i = group; i < std::min(group + static_cast<size_t>(settings_.textures), order.size()); ++i) {
      if (settings_.corrected || i == group) z = order[i].z;
      if (!(z >= near_)) continue;
      Place t{};
      for (const size_t a : across_) {
        const float p = std::clamp(origin[a] + z * direction[a], -16.F, 16384.F);
        t[a] = static_cast<int>(std::floor(p * 256 + 0.5F));
      }
      t[axis_] = settings_.interpolate ? static_cast<int>(std::floor(order[i].stored * 256 + 0.5F))
                                       : 256 * static_cast<int>(std::nearbyint(order[i].stored));
      blend(sample(t), polygon);
    }
    blend(polygon, target);
  }
  return target;
}

}  // namespace volumark
