// Noise for procedural data: seeded, the same numbers on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace volumark {

// The next of a sequence of well mixed 64-bit numbers (splitmix64); `state` is any seed.
uint64_t next_random(uint64_t& state);
// The same as a number in [0, 1).
double next_unit(uint64_t& state);

// Perlin, Improving Noise, SIGGRAPH 2002: gradients to the twelve edges of a cube, quintic fade; range about [-1, 1].
class PerlinNoise {
 public:
  explicit PerlinNoise(uint32_t seed);
  double operator()(const glm::dvec3& q) const { return at(q, glm::ivec3(256)); }
  // Repeats after `period` along each axis, each 1..256.
  double at(const glm::dvec3& q, const glm::ivec3& period) const;
  // Sum over `octaves` of 2^-o noise(2^o q), with periods 2^o period (256 at most), so that it repeats after `period`.
  double fbm(const glm::dvec3& q, int octaves, const glm::ivec3& period = glm::ivec3(256)) const;

 private:
  std::array<size_t, 513> table_{};
};

}  // namespace volumark
