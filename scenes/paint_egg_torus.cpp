#include "scenes/noise.h"
#include "scenes/texture_painters.h"

namespace volumark {

// lensch2002, Figure 8: an opaque ring lies on the surface and carries a semi-transparent egg.
void paint_egg_torus(TextureCanvas& canvas, uint32_t seed) {
  canvas.set_height(0.7);
  const PerlinNoise noise(seed);
  const double ring_radius = 0.27, tube = 0.11;
  const glm::dvec3 ring_centre(0.5, 0.5, tube + 0.01), egg_centre(0.5, 0.5, 0.41), yolk_centre(0.5, 0.5, 0.37);
  const auto ring = [&](const glm::dvec3& p) {
    const glm::dvec3 q = p - ring_centre;
    return std::hypot(std::hypot(q.x, q.y) - ring_radius, q.z) - tube;
  };
  const auto clay = [&](const glm::dvec3& p) {
    const double vein = 0.5 + 0.5 * std::sin(50 * p.z + 5 * noise.fbm(p * 8.0, 3, glm::ivec3(8)));
    return glm::mix(glm::dvec3(0.9, 0.5, 0.12), glm::dvec3(0.6, 0.16, 0.04), vein);
  };
  // Narrower towards the top.
  const auto egg = [&](const glm::dvec3& p) {
    const glm::dvec3 q = p - egg_centre;
    const double wide = 0.21 * (1 - 0.7 * q.z);
    return 0.21 * (glm::length(glm::dvec3(q.x / wide, q.y / wide, q.z / 0.27)) - 1);
  };
  const auto white = [&](const glm::dvec3& p) {
    return glm::mix(glm::dvec3(0.35, 0.75, 1), glm::dvec3(0.9, 0.97, 1), 0.5 + 0.5 * noise.fbm(p * 6.0, 2));
  };
  const auto yolk = [&](const glm::dvec3& p) { return ball(p, yolk_centre, 0.09); };
  canvas.body({0.2, 0.2, 0.1}, {0.8, 0.8, 0.7}, 0.035, egg, white);
  canvas.body(yolk_centre - 0.1, yolk_centre + 0.1, 0.2, yolk,
              [](const glm::dvec3&) { return glm::dvec3(1, 0.7, 0.05); });
  canvas.body({0.1, 0.1, 0}, {0.9, 0.9, 0.24}, 1, ring, clay);
}

}  // namespace volumark
