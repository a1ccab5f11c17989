#include "scenes/noise.h"
#include "scenes/texture_painters.h"

namespace volumark {

// lensch2002, Figure 9: two links of a chain that runs along u, one flat, one on edge. Both ends of a link turn around
// a radius `bend`; the middles of the wire are 2 `wire` apart where links touch.
void paint_chain(TextureCanvas& canvas, uint32_t seed) {
  canvas.set_height(0.5);
  const PerlinNoise noise(seed);
  const double wire = 0.058, bend = 0.145, straight = 0.25 + wire - bend;
  // The curve of a link in its plane: a rectangle's long sides, closed by half circles.
  const auto link = [=](double along, double across, double beside) {
    const double past = std::max(std::abs(along) - straight, 0.0);
    return std::hypot(std::hypot(past, across) - bend, beside) - wire;
  };
  const auto metal = [&noise](const glm::dvec3& tint) {
    return [&noise, tint](const glm::dvec3& p) {
      return tint * (0.85 + 0.15 * noise.fbm(p * glm::dvec3(32, 8, 8), 2, glm::ivec3(32, 8, 8)));
    };
  };
  const glm::dvec3 flat(0.25, 0.5, 0.25), upright(0.75, 0.5, 0.25);
  const double reach = straight + bend + wire, wide = bend + wire;
  canvas.body(
      flat - glm::dvec3(reach, wide, wire), flat + glm::dvec3(reach, wide, wire), 1,
      [&](const glm::dvec3& p) { return link(p.x - flat.x, p.y - flat.y, p.z - flat.z); }, metal({0.95, 0.7, 0.25}));
  canvas.body(
      upright - glm::dvec3(reach, wire, wide), upright + glm::dvec3(reach, wire, wide), 1,
      [&](const glm::dvec3& p) { return link(p.x - upright.x, p.z - upright.z, p.y - upright.y); },
      metal({0.7, 0.75, 0.85}));
}

}  // namespace volumark
