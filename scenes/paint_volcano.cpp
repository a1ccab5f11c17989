#include <array>

#include "scenes/noise.h"
#include "scenes/texture_painters.h"

namespace volumark {
namespace {

// Height of the ground at a distance r from the mountain's axis: plain, flank, rim, crater.
double profile(double r) {
  constexpr double kFoot = 0.4, kRim = 0.11, kPlain = 0.05, kTop = 0.36, kCrater = 0.27;
  if (r > kFoot) return kPlain;
  if (r > kRim) return kPlain + (kTop - kPlain) * std::pow((kFoot - r) / (kFoot - kRim), 1.6);
  return kCrater + (kTop - kCrater) * std::pow(r / kRim, 2);
}

struct Ring {
  double height, radius, tube, density;
};

}  // namespace

// lensch2002, Figure 11: an opaque volcano on an opaque floor blows semi-transparent rings of smoke.
void paint_volcano(TextureCanvas& canvas, uint32_t seed) {
  canvas.set_height(0.9);
  const PerlinNoise noise(seed);
  const glm::ivec3 period(8);
  const auto from_axis = [](const glm::dvec3& p) { return std::hypot(p.x - 0.5, p.y - 0.5); };
  constexpr std::array<Ring, 3> kRings{
      {{0.49, 0.1, 0.03, 0.09}, {0.62, 0.15, 0.034, 0.06}, {0.77, 0.21, 0.038, 0.035}}};
  for (const Ring& ring : kRings) {
    const double reach = ring.radius + 2 * ring.tube, drift = 0.08 * (ring.height - 0.4);
    canvas.stamp({0.5 - reach, 0.5 - reach, ring.height - 2 * ring.tube},
                 {0.5 + reach, 0.5 + reach, ring.height + 2 * ring.tube}, [&](const glm::dvec3& p) {
                   const double r = std::hypot(p.x - 0.5 - drift, p.y - 0.5);
                   const double d = std::hypot(r - ring.radius, p.z - ring.height) / ring.tube;
                   if (d > 2) return glm::dvec4(0);
                   const double swirl = 1 + 0.9 * noise.fbm(p * 16.0, 3, glm::ivec3(16));
                   return glm::dvec4(glm::dvec3(0.85, 0.87, 0.92),
                                     ring.density * swirl * (std::exp(-d * d) - std::exp(-4.0)));
                 });
  }
  const auto ground = [&](const glm::dvec3& p) {
    const double r = from_axis(p), smooth = profile(r);
    if (std::abs(p.z - smooth) > 0.06) return smooth;  // no roughness reaches so far
    const double rough = noise.fbm({p.x * 8, p.y * 8, 0.3}, 4, period);
    return smooth + (r < 0.42 ? 0.022 : 0.012) * rough;
  };
  canvas.body(
      {0, 0, 0}, {1, 1, 0.42}, 1,
      // The flank is steep: a vertical distance overstates the distance to it.
      [&](const glm::dvec3& p) { return 0.6 * (p.z - ground(p)); },
      [&](const glm::dvec3& p) {
        const double r = from_axis(p), spots = 0.5 + 0.5 * noise.fbm(p * 16.0, 3, glm::ivec3(16));
        const double angle = std::atan2(p.y - 0.5, p.x - 0.5);
        // Lava fills the crater and runs down in three streams.
        const double stream = std::cos(3 * angle + 4 * r + 0.8 * noise.at({p.x * 8, p.y * 8, 1.5}, period));
        if (r < 0.085 || (r < 0.3 && stream > 0.9 + 0.25 * r)) {
          return glm::mix(glm::dvec3(1, 0.25, 0.02), glm::dvec3(1, 0.8, 0.15), spots);
        }
        const glm::dvec3 rock = glm::mix(glm::dvec3(0.22, 0.17, 0.15), glm::dvec3(0.5, 0.38, 0.3), spots);
        const glm::dvec3 grass = glm::mix(glm::dvec3(0.14, 0.3, 0.08), glm::dvec3(0.4, 0.5, 0.16), spots);
        return glm::mix(rock, grass, glm::smoothstep(0.3, 0.42, r));
      });
}

}  // namespace volumark
