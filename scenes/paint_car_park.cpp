#include "scenes/noise.h"
#include "scenes/texture_painters.h"

namespace volumark {
namespace {

constexpr double kGround = 0.03;

glm::dvec3 always(const glm::dvec3& colour) { return colour; }

// Along v, nose towards +v. Its place is the middle of its footprint.
void paint_car(TextureCanvas& canvas, const glm::dvec2& at, double nose, const glm::dvec3& colour) {
  const double length = 0.26, width = 0.115, wheel = 0.026;
  const glm::dvec3 body(at, kGround + 0.05), half(width / 2, length / 2, 0.028);
  const glm::dvec3 cabin(at.x, at.y - nose * 0.018, kGround + 0.092), cabin_half(0.045, 0.075, 0.03);
  for (const double side : {-1.0, 1.0}) {
    for (const double axle : {-1.0, 1.0}) {
      const glm::dvec3 hub(at.x + side * (width / 2 - 0.006), at.y + axle * 0.085, kGround + wheel);
      canvas.body(
          hub - wheel, hub + wheel, 1,
          [&](const glm::dvec3& p) {
            return std::max(std::hypot(p.y - hub.y, p.z - hub.z) - wheel, std::abs(p.x - hub.x) - 0.012);
          },
          [&](const glm::dvec3& p) {
            const bool rim = std::hypot(p.y - hub.y, p.z - hub.z) < 0.012;
            return rim ? always({0.75, 0.75, 0.78}) : always({0.04, 0.04, 0.05});
          });
    }
  }
  canvas.body(
      body - half, body + half, 1, [&](const glm::dvec3& p) { return rounded_box(p, body, half, 0.018); },
      [&](const glm::dvec3& p) {
        const double along = nose * (p.y - at.y), beside = std::abs(p.x - at.x);
        if (along > 0.118 && beside > 0.022 && p.z > body.z - 0.006) return always({1, 0.97, 0.8});  // lamps
        if (along < -0.118 && beside > 0.022 && p.z > body.z - 0.006) return always({0.9, 0.05, 0.03});
        return colour;
      });
  // Windows all around, a roof above, narrower than the doors.
  canvas.body(
      cabin - cabin_half, cabin + cabin_half, 1,
      [&](const glm::dvec3& p) {
        glm::dvec3 q = p;
        const double lean = 1 + 5 * std::max(p.z - cabin.z + 0.03, 0.0);
        q.y = cabin.y + (p.y - cabin.y) * lean;
        q.x = cabin.x + (p.x - cabin.x) * (0.85 + 0.15 * lean);
        return 0.8 * rounded_box(q, cabin, cabin_half, 0.012);
      },
      [&](const glm::dvec3& p) {
        const bool roof = p.z > cabin.z + 0.019;
        const bool pillar = std::abs(p.y - cabin.y) < 0.005;
        return roof || pillar ? colour : always({0.1, 0.14, 0.2});
      });
}

void paint_tree(TextureCanvas& canvas, const PerlinNoise& noise, const glm::dvec2& at) {
  canvas.body(
      {at - 0.02, kGround}, {at + 0.02, 0.25}, 1,
      [&](const glm::dvec3& p) {
        return rod(p, {at, 0}, {at, 0.22}, 0.016, 0.011);
      },
      [](const glm::dvec3&) { return glm::dvec3(0.32, 0.2, 0.11); });
  const glm::dvec3 crown(at, 0.29);
  canvas.body(
      crown - 0.13, crown + 0.13, 1,
      [&](const glm::dvec3& p) { return 0.7 * (ball(p, crown, 0.1) + 0.05 * noise.fbm(p * 16.0, 3, glm::ivec3(16))); },
      [&](const glm::dvec3& p) {
        const double t = std::clamp(0.5 + 4 * (p.z - crown.z) + 0.4 * noise.at(p * 32.0, glm::ivec3(32)), 0.0, 1.0);
        return glm::mix(glm::dvec3(0.07, 0.22, 0.05), glm::dvec3(0.4, 0.6, 0.15), t);
      });
}

}  // namespace

// lensch2002, Figure 12: cars, a ground plane and some trees; all opaque.
void paint_car_park(TextureCanvas& canvas, uint32_t seed) {
  canvas.set_height(0.42);
  const PerlinNoise noise(seed);
  // Six bays of 1/6 on either side of the lane, a green strip at v = 0 and 1.
  canvas.body(
      {0, 0, 0}, {1, 1, kGround}, 1, [](const glm::dvec3& p) { return p.z - kGround; },
      [&](const glm::dvec3& p) {
        const double grain = noise.fbm(p * 64.0, 2, glm::ivec3(64)), edge = std::min(p.y, 1 - p.y);
        if (edge < 0.07) return glm::mix(glm::dvec3(0.1, 0.28, 0.06), glm::dvec3(0.32, 0.48, 0.14), 0.5 + 0.5 * grain);
        if (edge < 0.085) return glm::dvec3(0.6, 0.58, 0.55) * (1 + 0.1 * grain);
        const double bay = std::abs(p.x * 6 - std::round(p.x * 6)) / 6;
        const bool line = (bay < 0.006 && edge < 0.385) || (std::abs(p.y - 0.5) < 0.006 && std::fmod(p.x * 12, 2) < 1);
        return line ? always({0.9, 0.9, 0.85}) : glm::dvec3(0.2, 0.2, 0.22) * (1 + 0.2 * grain);
      });
  constexpr glm::dvec3 kPaints[] = {{0.8, 0.06, 0.05}, {0.06, 0.2, 0.7},  {0.9, 0.9, 0.9},   {0.95, 0.7, 0.05},
                                    {0.1, 0.45, 0.2},  {0.5, 0.52, 0.56}, {0.07, 0.07, 0.09}};
  uint64_t state = seed;
  for (int bay = 0; bay < 12; ++bay) {
    const double row = bay < 6 ? 0.235 : 0.765, nose = next_unit(state) < 0.7 ? (bay < 6 ? -1 : 1) : (bay < 6 ? 1 : -1);
    const glm::dvec3 colour = kPaints[next_random(state) % std::size(kPaints)];
    const double askew = 0.02 * (next_unit(state) - 0.5);
    if (next_unit(state) < 0.25) continue;  // a free bay
    paint_car(canvas, {(bay % 6 + 0.5) / 6 + askew, row}, nose, colour);
  }
  for (const double u : {0.08, 0.42, 0.75}) paint_tree(canvas, noise, {u, 0.0});
}

}  // namespace volumark
