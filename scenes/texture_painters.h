// The painters behind scenes/procedural_textures.h, one a kind, and the shapes that several of them use. Internal to
// scenes/. Each states the height of the texture in lengths of u and v: where the thickness of a shell is that part of
// a repeat's width, round things are round.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/texture_canvas.h"

namespace volumark {

void paint_egg_torus(TextureCanvas& canvas, uint32_t seed);
void paint_outdoor(TextureCanvas& canvas, uint32_t seed);
void paint_chain(TextureCanvas& canvas, uint32_t seed);
void paint_car_park(TextureCanvas& canvas, uint32_t seed);
void paint_volcano(TextureCanvas& canvas, uint32_t seed);
void paint_fur(TextureCanvas& canvas, uint32_t seed);

// Distances, negative inside, in the units of p.
inline double ball(const glm::dvec3& p, const glm::dvec3& centre, double radius) {
  return glm::length(p - centre) - radius;
}
// A box with rounded edges; `half` includes the rounding.
inline double rounded_box(const glm::dvec3& p, const glm::dvec3& centre, const glm::dvec3& half, double rounding) {
  const glm::dvec3 q = glm::abs(p - centre) - (half - rounding);
  return glm::length(glm::max(q, glm::dvec3(0))) + std::min(std::max({q.x, q.y, q.z}), 0.0) - rounding;
}
// A rod from a to b whose radius changes evenly between its ends.
inline double rod(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, double radius_a, double radius_b) {
  const glm::dvec3 along = b - a;
  const double t = std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0, 1.0);
  return glm::length(p - a - t * along) - glm::mix(radius_a, radius_b, t);
}

}  // namespace volumark
