#include "scenes/noise.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>
#include <utility>

namespace volumark {
namespace {

double gradient(size_t hash, const glm::dvec3& d) {
  const size_t h = hash & 15;
  const double u = h < 8 ? d.x : d.y;
  const double v = h < 4 ? d.y : h == 12 || h == 14 ? d.x : d.z;
  return ((h & 1) != 0 ? -u : u) + ((h & 2) != 0 ? -v : v);
}

}  // namespace

uint64_t next_random(uint64_t& state) {
  state += 0x9e3779b97f4a7c15;
  uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

double next_unit(uint64_t& state) { return std::ldexp(static_cast<double>(next_random(state) >> 11), -53); }

PerlinNoise::PerlinNoise(uint32_t seed) {
  std::iota(table_.begin(), table_.begin() + 256, 0);
  // Fisher-Yates with our own numbers: unlike std::shuffle and the standard distributions, the same on every library.
  uint64_t state = seed;
  for (size_t i = 255; i > 0; --i) std::swap(table_[i], table_[static_cast<size_t>(next_random(state) % (i + 1))]);
  std::copy_n(table_.begin(), 256, table_.begin() + 256);
}

double PerlinNoise::at(const glm::dvec3& q, const glm::ivec3& period) const {
  const glm::dvec3 base = glm::floor(q);
  const glm::dvec3 f = q - base;
  const glm::dvec3 fade = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  const auto lattice = [&](int axis, int64_t step) {
    const int64_t n = period[axis], i = (static_cast<int64_t>(base[axis]) + step) % n;
    return static_cast<size_t>(i < 0 ? i + n : i);
  };
  const std::array<size_t, 2> xs{lattice(0, 0), lattice(0, 1)}, ys{lattice(1, 0), lattice(1, 1)},
      zs{lattice(2, 0), lattice(2, 1)};
  std::array<double, 8> corner;
  for (size_t c = 0; c < 8; ++c) {
    const size_t dx = c & 1, dy = (c >> 1) & 1, dz = c >> 2;
    const size_t hash = table_[table_[table_[xs[dx]] + ys[dy]] + zs[dz]];
    corner[c] = gradient(hash, f - glm::dvec3(dx, dy, dz));
  }
  const auto along_x = [&](size_t c) { return std::lerp(corner[c], corner[c + 1], fade.x); };
  return std::lerp(std::lerp(along_x(0), along_x(2), fade.y), std::lerp(along_x(4), along_x(6), fade.y), fade.z);
}

double PerlinNoise::fbm(const glm::dvec3& q, int octaves, const glm::ivec3& period) const {
  double sum = 0, scale = 1;
  glm::ivec3 n = period;
  for (int octave = 0; octave < octaves; ++octave, scale *= 2) {
    sum += at(q * scale, n) / scale;
    n = glm::min(2 * n, glm::ivec3(256));
  }
  return sum;
}

}  // namespace volumark
