#include "scenes/noise.h"
#include "scenes/texture_painters.h"

namespace volumark {

// Hairs that lean and curl over a skin; thin and semi-transparent towards their tips.
void paint_fur(TextureCanvas& canvas, uint32_t seed) {
  canvas.set_height(0.6);
  const PerlinNoise noise(seed);
  canvas.stamp({0, 0, 0}, {1, 1, 0.05}, [&](const glm::dvec3& p) {
    const double spot = 0.5 + 0.5 * noise.fbm(p * 4.0, 2, glm::ivec3(4));
    return glm::dvec4(glm::mix(glm::dvec3(0.25, 0.12, 0.06), glm::dvec3(0.45, 0.25, 0.15), spot), p.z < 0.03 ? 1 : 0.3);
  });
  constexpr int kHairs = 420, kPieces = 10;
  uint64_t state = seed;
  for (int hair = 0; hair < kHairs; ++hair) {
    glm::dvec3 at(next_unit(state), next_unit(state), 0.02);
    const double length = 0.4 + 0.2 * next_unit(state), shade = next_unit(state);
    // Neighbours lean alike.
    const double lean = 0.5 + 0.25 * next_unit(state);
    const double towards = 0.6 * noise.at(at * 2.0, glm::ivec3(2)) + 0.5 * (next_unit(state) - 0.5);
    const glm::dvec3 aside(lean * std::cos(towards), lean * std::sin(towards), 0);
    const glm::dvec3 colour = glm::mix(glm::dvec3(0.5, 0.24, 0.08), glm::dvec3(1, 0.78, 0.45), shade);
    for (int piece = 0; piece < kPieces; ++piece) {
      const double from = static_cast<double>(piece) / kPieces, to = from + 1.0 / kPieces;
      // It starts upright and bows over.
      const glm::dvec3 next = at + glm::normalize(glm::dvec3(0, 0, 1) + 1.6 * from * aside) * (length / kPieces);
      const double thick = 0.013 * (1 - 0.75 * from), thin = 0.013 * (1 - 0.75 * to);
      canvas.body(
          glm::min(at, next) - thick, glm::max(at, next) + thick, 1 - 0.75 * from,
          [&](const glm::dvec3& p) { return rod(p, at, next, thick, thin); },
          [&](const glm::dvec3&) { return colour * (0.45 + 0.55 * to); });
      at = next;
    }
  }
}

}  // namespace volumark
