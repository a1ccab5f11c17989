// A shell's texture while it is painted: shapes are stamped one over another, each into the texels of its own box, so
// that the time grows with what is painted and not with shapes times texels. Positions are (u, v, w * height): u and v
// in [0, 1] wrap around, so that copies fit side by side; what is beyond w = 0 or 1 is cut off.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "scenes/shell.h"

namespace volumark {

class TextureCanvas {
 public:
  explicit TextureCanvas(const glm::ivec3& size)
      : size_(size), texels_(static_cast<size_t>(size.x) * static_cast<size_t>(size.y) * static_cast<size_t>(size.z)) {}

  // A w of 1, in lengths of u and v. Before anything is painted.
  void set_height(double height) { height_ = height; }

  // paint(p) -> (colour, cover), both 0..1, for texel centres p in [lo, hi] (not wrapped: beyond 0..1 where the box
  // is). What was there stays with 1 - cover.
  template <typename Paint>
  void stamp(const glm::dvec3& lo, const glm::dvec3& hi, const Paint& paint) {
    const glm::dvec3 n = glm::dvec3(size_) / glm::dvec3(1, 1, height_);
    const auto from = [&](int axis) { return static_cast<int>(std::ceil(lo[axis] * n[axis] - 0.5)); };
    const auto to = [&](int axis) { return static_cast<int>(std::floor(hi[axis] * n[axis] - 0.5)); };
    const int k_to = std::min(to(2), size_.z - 1), j_to = to(1), i_to = to(0);
    for (int k = std::max(from(2), 0); k <= k_to; ++k) {
      for (int j = from(1); j <= j_to; ++j) {
        for (int i = from(0); i <= i_to; ++i) {
          const glm::dvec4 painted = paint((glm::dvec3(i, j, k) + 0.5) / n);
          if (!(painted.a > 0)) continue;
          const double cover = std::min(painted.a, 1.0);
          glm::dvec4& texel = texels_[index(i, j, k)];
          texel = texel * (1 - cover) + glm::dvec4(glm::dvec3(painted), 1) * cover;
        }
      }
    }
  }

  // A body of `density` (0..1): distance(p) < 0 inside, about the distance to its surface; the edge is one texel wide.
  template <typename Distance, typename Colour>
  void body(const glm::dvec3& lo, const glm::dvec3& hi, double density, const Distance& distance,
            const Colour& colour) {
    const double texel = 1.0 / std::max({size_.x, size_.y, size_.z});
    stamp(lo - texel, hi + texel, [&](const glm::dvec3& p) {
      const double cover = std::clamp(0.5 - distance(p) / texel, 0.0, 1.0);
      if (cover == 0) return glm::dvec4(0);
      return glm::dvec4(colour(p), density * cover);
    });
  }

  // Extinction `extinction` [1 / world unit] where the cover is 1.
  ShellTexture finish(double extinction) const;

  const glm::ivec3& size() const { return size_; }

 private:
  size_t index(int i, int j, int k) const {
    const auto wrap = [](int at, int n) { return static_cast<size_t>((at % n + n) % n); };
    return (static_cast<size_t>(k) * static_cast<size_t>(size_.y) + wrap(j, size_.y)) * static_cast<size_t>(size_.x) +
           wrap(i, size_.x);
  }
  glm::ivec3 size_;
  double height_ = 1;
  std::vector<glm::dvec4> texels_;  // colour * cover, cover
};

}  // namespace volumark
