#include "tests/images/fixed_point/scalar_walk.h"

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

int signed_dot(const std::array<int, 3>& a, const Float4& b) {
  int sum = 0;
  for (size_t i = 0; i < 3; ++i) sum += a[i] * static_cast<int>(b[i]);
  const int m = std::abs(sum), level = std::min((m + (m >> 8) + 128) >> 8, 255);
  return sum < 0 ? -level : level;
}

void blend(const Levels& from, int rest, Levels& to) {
  for (size_t c = 0; c < 4; ++c) to[c] = std::min(to[c] + product(from[c], rest), 255);
}

}  // namespace

ScalarWalk::ScalarWalk(const Scene& scene, const FixedSettings& settings, const View& view, int size)
    : fx_(fixed_uniforms(scene, view, size, size, settings.step)),
      size_(scene.volume->size),
      channels_(scene.effects.lighting || settings.classification == Classification::Pre ? 4 : 1),
      texels_(fixed_texels(scene, settings)),
      palette_(fixed_palette(scene, settings)) {
  const ViewRays rays = view_rays(*scene.volume, view, size, size);
  depths_ = fixed_depths(*scene.volume, rays, settings.step);
  reference_depth_ = rays.reference_depth;
}

ScalarWalk::Pixel ScalarWalk::pixel_of(int x, int y) const {
  const float wx = static_cast<float>(x) + 0.5F, wy = static_cast<float>(y) + 0.5F;
  Pixel pixel{};
  for (size_t i = 0; i < 3; ++i) {
    pixel.origin[i] = (fx_.origin[i] + wx * fx_.origin_x[i]) + wy * fx_.origin_y[i];
    pixel.direction[i] = (fx_.direction[i] + wx * fx_.direction_x[i]) + wy * fx_.direction_y[i];
  }
  return pixel;
}

std::array<int, 3> ScalarWalk::place(const Pixel& pixel, float z) const {
  std::array<int, 3> t{};
  for (size_t i = 0; i < 3; ++i) {
    const float p = std::clamp(pixel.origin[i] + z * pixel.direction[i], -16.F, 16384.F);
    t[i] = static_cast<int>(std::floor(p * 256 + 0.5F));
  }
  return t;
}

glm::dvec3 ScalarWalk::position(int x, int y, double depth) const {
  const std::array<int, 3> t = place(pixel_of(x, y), static_cast<float>(depth - reference_depth_));
  return glm::dvec3(t[0], t[1], t[2]) / 256.;
}

int ScalarWalk::texel(int x, int y, int z, int channel) const {
  const glm::ivec3 p = glm::clamp(glm::ivec3(x, y, z), glm::ivec3(0), size_ - 1);
  const int index = ((p.z * size_.y + p.y) * size_.x + p.x) * channels_ + channel;
  return texels_[static_cast<size_t>(index)];
}

int ScalarWalk::filtered(const std::array<int, 3>& t, int channel) const {
  const auto between = [](int a, int b, int f) { return a + (((b - a) * (f & 255) + 128) >> 8); };
  const int x = t[0] >> 8, y = t[1] >> 8, z = t[2] >> 8;
  const auto row = [&](int j, int k) { return between(texel(x, j, k, channel), texel(x + 1, j, k, channel), t[0]); };
  const auto plane = [&](int k) { return between(row(y, k), row(y + 1, k), t[1]); };
  return between(plane(z), plane(z + 1), t[2]);
}

std::array<int, 3> ScalarWalk::lit(const std::array<int, 3>& colour, const std::array<int, 3>& normal) const {
  const std::array<int, 3> n{2 * normal[0] - 255, 2 * normal[1] - 255, 2 * normal[2] - 255};
  const bool two_sided = fx_.counts[3] > 0;
  std::array<int, 3> diffuse{}, specular{};
  for (size_t c = 0; c < 3; ++c) diffuse[c] = static_cast<int>(fx_.lighting[c]);
  for (size_t i = 0; i < static_cast<size_t>(fx_.counts[0]); ++i) {
    const FixedLight& light = fx_.lights[i];
    const int nl = signed_dot(n, light.direction);
    int nh = signed_dot(n, light.half);
    nh = two_sided ? std::abs(nh) : nl > 0 ? std::max(nh, 0) : 0;
    for (int k = 1; k < static_cast<int>(fx_.counts[2]); ++k) nh = product(nh, nh);
    const int facing = two_sided ? std::abs(nl) : std::max(nl, 0);
    for (size_t c = 0; c < 3; ++c) {
      diffuse[c] = std::min(diffuse[c] + product(facing, static_cast<int>(light.diffuse[c])), 255);
      if (fx_.counts[2] > 0) {
        specular[c] = std::min(specular[c] + product(nh, static_cast<int>(light.specular[c])), 255);
      }
    }
  }
  std::array<int, 3> out{};
  for (size_t c = 0; c < 3; ++c) out[c] = std::min(product(colour[c], diffuse[c]) + specular[c], 255);
  return out;
}

Levels ScalarWalk::sample(const std::array<int, 3>& t) const {
  for (size_t i = 0; i < 3; ++i) {
    if (t[i] < 0 || t[i] > static_cast<int>(fx_.limit[i])) return {};
  }
  for (size_t i = 0; i < static_cast<size_t>(fx_.counts[1]); ++i) {
    const Float4& plane = fx_.clip_planes[i];
    const float side = (plane[0] * static_cast<float>(t[0]) + plane[1] * static_cast<float>(t[1])) +
                       plane[2] * static_cast<float>(t[2]);
    if (side < plane[3]) return {};
  }
  const uint8_t* entry = palette_.data() + 4 * filtered(t, channels_ - 1);
  std::array<int, 3> colour{entry[0], entry[1], entry[2]};
  const int alpha = entry[3];
  if (channels_ == 4) colour = lit(colour, {filtered(t, 0), filtered(t, 1), filtered(t, 2)});
  return {product(colour[0], alpha), product(colour[1], alpha), product(colour[2], alpha), alpha};
}

Levels ScalarWalk::back_to_front(int x, int y) const {
  const Pixel pixel = pixel_of(x, y);
  Levels sum{};
  for (int k = depths_.count - 1; k >= 0; --k) {
    Levels next = sample(place(pixel, fx_.depth[0] + (static_cast<float>(k) + 0.5F) * fx_.depth[1]));
    blend(sum, 255 - next[3], next);
    sum = next;
  }
  return sum;
}

Levels ScalarWalk::along_ray(int x, int y) const {
  const Pixel pixel = pixel_of(x, y);
  float step_z = fx_.depth[1];
  if (fx_.depth[2] > 0) {
    std::array<float, 3> d{};
    for (size_t i = 0; i < 3; ++i) d[i] = pixel.direction[i] * fx_.metric[i];
    const float q = (d[0] * d[0] + d[1] * d[1]) + d[2] * d[2], half_q = 0.5F * q;
    float r = std::bit_cast<float>(0x5f375a86 - (std::bit_cast<int32_t>(q) >> 1));
    for (int i = 0; i < 4; ++i) r = r * (1.5F - (half_q * r) * r);
    step_z = fx_.depth[1] * r;
  }
  Levels sum{};
  const int count = fx_.depth[2] > 0 ? 4 * depths_.count : depths_.count;
  for (int k = 0; k < count; ++k) {
    const Levels s = sample(place(pixel, fx_.depth[0] + (static_cast<float>(k) + 0.5F) * step_z));
    blend(s, 255 - sum[3], sum);
  }
  return sum;
}

}  // namespace volumark
