#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/noise.h"
#include "scenes/texture_painters.h"

namespace volumark {

// lensch2002, Figure 8: an opaque ring lies on the surface and carries a semi-transparent egg.
void paint_egg_torus(TextureCanvas& canvas, uint32_t seed) {
  const PerlinNoise noise(seed);
  const glm::dvec3 ring_centre(0.5, 0.5, 0.2), egg_centre(0.5, 0.5, 0.56);
  const double ring_radius = 0.27, tube = 0.13;
  const auto ring = [&](const glm::dvec3& p) {
    const glm::dvec3 q = p - ring_centre;
    return std::hypot(std::hypot(q.x, q.y) - ring_radius, q.z) - tube;
  };
  const auto clay = [&](const glm::dvec3& p) {
    const double vein = 0.5 + 0.5 * std::sin(40 * p.z + 6 * noise.fbm(p * 8.0, 3, glm::ivec3(8)));
    return glm::mix(glm::dvec3(0.9, 0.5, 0.12), glm::dvec3(0.65, 0.2, 0.05), vein);
  };
  // Narrower towards the top.
  const auto egg = [&](const glm::dvec3& p) {
    const glm::dvec3 q = p - egg_centre;
    const double wide = 0.24 * (1 - 0.5 * q.z);
    return 0.24 * (glm::length(glm::dvec3(q.x / wide, q.y / wide, q.z / 0.34)) - 1);
  };
  const auto shell = [&](const glm::dvec3& p) {
    return glm::mix(glm::dvec3(0.35, 0.75, 1), glm::dvec3(0.85, 0.95, 1), 0.5 + 0.5 * noise.fbm(p * 6.0, 2));
  };
  const glm::dvec3 yolk_centre = egg_centre - glm::dvec3(0, 0, 0.05);
  const auto yolk = [&](const glm::dvec3& p) { return glm::length(p - yolk_centre) - 0.1; };
  canvas.body({0.2, 0.2, 0.2}, {0.8, 0.8, 0.92}, 0.035, egg, shell);
  canvas.body(yolk_centre - 0.12, yolk_centre + 0.12, 0.12, yolk,
              [](const glm::dvec3&) { return glm::dvec3(1, 0.75, 0.1); });
  canvas.body({0.09, 0.09, 0.06}, {0.91, 0.91, 0.34}, 1, ring, clay);
}

}  // namespace volumark
