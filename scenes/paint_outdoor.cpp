#include "scenes/noise.h"
#include "scenes/texture_painters.h"

namespace volumark {
namespace {

class Garden {
 public:
  Garden(TextureCanvas& canvas, uint32_t seed) : canvas_(canvas), noise_(seed), state_(seed) {}

  // Thin enough to vanish where it is looked at from above.
  void fog() {
    canvas_.stamp({0, 0, 0}, {1, 1, 0.2}, [&](const glm::dvec3& p) {
      const double billow = std::max(0.0, 1 + 1.2 * noise_.fbm(p * 4.0, 2, glm::ivec3(4)));
      return glm::dvec4(glm::dvec3(0.75, 0.8, 0.88), 0.0045 * billow * glm::smoothstep(0.2, 0.05, p.z));
    });
  }

  // From a fire on the ground; it leans and spreads.
  void smoke(const glm::dvec2& at) {
    canvas_.stamp({at.x - 0.2, at.y - 0.2, 0.04}, {at.x + 0.35, at.y + 0.2, kHeight}, [&](const glm::dvec3& p) {
      const double rise = (p.z - 0.04) / kHeight;
      const glm::dvec2 middle =
          at + glm::dvec2(0.22 * rise * rise + 0.025 * std::sin(20 * rise), 0.02 * std::cos(17 * rise));
      const double wide = 0.018 + 0.07 * rise;
      const double d = glm::length(glm::dvec2(p) - middle) / wide;
      if (d > 2) return glm::dvec4(0);
      const double puffs = std::max(0.0, 1 + 1.6 * noise_.fbm(p * 16.0, 3, glm::ivec3(16)));
      return glm::dvec4(glm::mix(glm::dvec3(0.35), glm::dvec3(0.7), rise),
                        0.11 * puffs * (1 - rise) * (std::exp(-d * d) - std::exp(-4.0)));
    });
    const glm::dvec3 fire(at, 0.05);
    canvas_.body(
        fire - 0.04, fire + 0.04, 1, [&](const glm::dvec3& p) { return ball(p, fire, 0.028); },
        [&](const glm::dvec3& p) {
          return glm::mix(glm::dvec3(1, 0.2, 0), glm::dvec3(1, 0.85, 0.2), std::clamp((p.z - 0.04) * 25, 0.0, 1.0));
        });
  }

  void floor() {
    canvas_.body(
        {0, 0, 0}, {1, 1, 0.08}, 1, [&](const glm::dvec3& p) { return p.z - ground(p); },
        [&](const glm::dvec3& p) {
          const double t = 0.5 + 0.6 * noise_.fbm(p * 16.0, 3, glm::ivec3(16));
          const double earth = glm::smoothstep(0.15, 0.4, noise_.fbm(p * 3.0 + 7.0, 2, glm::ivec3(3)));
          const glm::dvec3 grass = glm::mix(glm::dvec3(0.1, 0.26, 0.05), glm::dvec3(0.36, 0.5, 0.12), t);
          return glm::mix(grass, glm::dvec3(0.38, 0.26, 0.14), earth);
        });
  }

  void conifer(const glm::dvec2& at, double height) {
    trunk(at, 0.05 + 0.3 * height, 0.014);
    const double lean = next_unit(state_);
    for (int tier = 0; tier < 4; ++tier) {
      const double t = tier / 4.0, from = 0.08 + height * (0.12 + 0.68 * t), to = from + 0.34 * height;
      const double radius = 0.3 * height * (1 - 0.75 * t);
      canvas_.body(
          {at.x - radius, at.y - radius, from}, {at.x + radius, at.y + radius, to}, 1,
          [&](const glm::dvec3& p) {
            const double r = radius * (to - p.z) / (to - from);
            const double smooth = std::max(from - p.z, 0.8 * (std::hypot(p.x - at.x, p.y - at.y) - r));
            if (smooth > 0.05) return smooth;  // no needle reaches so far
            return smooth + 0.016 * noise_.fbm(p * 32.0, 2, glm::ivec3(32));
          },
          [&](const glm::dvec3& p) {
            const double t2 =
                std::clamp((p.z - from) / (to - from) + 0.4 * noise_.at(p * 32.0, glm::ivec3(32)), 0.0, 1.0);
            return glm::mix(glm::dvec3(0.02, 0.13, 0.06), glm::dvec3(0.12 + 0.08 * lean, 0.38, 0.14), t2);
          });
    }
  }

  void broadleaf(const glm::dvec2& at, double height) {
    const double radius = 0.32 * height;
    trunk(at, 0.05 + 0.6 * height, 0.017);
    const glm::dvec3 crown(at, 0.05 + height - radius);
    const double autumn = next_unit(state_);
    canvas_.body(
        crown - 1.25 * radius, crown + 1.25 * radius, 1,
        [&](const glm::dvec3& p) {
          const double smooth = ball(p, crown, radius);
          if (smooth > 0.15) return smooth;
          return 0.7 * (smooth + 0.06 * noise_.fbm(p * 16.0, 3, glm::ivec3(16)));
        },
        [&](const glm::dvec3& p) {
          const double t =
              std::clamp(0.5 + 0.5 * (p.z - crown.z) / radius + 0.5 * noise_.at(p * 32.0, glm::ivec3(32)), 0.0, 1.0);
          const glm::dvec3 green = glm::mix(glm::dvec3(0.06, 0.2, 0.02), glm::dvec3(0.45, 0.6, 0.12), t);
          const glm::dvec3 red = glm::mix(glm::dvec3(0.3, 0.08, 0.01), glm::dvec3(0.95, 0.55, 0.1), t);
          return glm::mix(green, red, autumn > 0.6 ? 1.0 : 0.0);
        });
  }

  void flowers(int count) {
    constexpr glm::dvec3 kColours[] = {
        {1, 0.9, 0.15}, {0.95, 0.15, 0.2}, {0.95, 0.95, 1}, {0.6, 0.25, 0.9}, {1, 0.45, 0.7}};
    for (int i = 0; i < count; ++i) {
      const glm::dvec2 at(next_unit(state_), next_unit(state_));
      const double top = 0.075 + 0.03 * next_unit(state_);
      const glm::dvec3 bloom(at, top), colour = kColours[next_random(state_) % std::size(kColours)];
      const glm::dvec3 root(at, 0.03);
      canvas_.body(
          root - 0.006, bloom + 0.006, 1, [&](const glm::dvec3& p) { return rod(p, root, bloom, 0.005, 0.005); },
          [](const glm::dvec3&) { return glm::dvec3(0.15, 0.45, 0.1); });
      canvas_.body(
          bloom - 0.014, bloom + 0.014, 1, [&](const glm::dvec3& p) { return ball(p, bloom, 0.011); },
          [&](const glm::dvec3&) { return colour; });
    }
  }

  static constexpr double kHeight = 0.5;

 private:
  double ground(const glm::dvec3& p) const {
    return 0.04 + 0.02 * noise_.fbm({p.x * 4, p.y * 4, 0.5}, 3, glm::ivec3(4));
  }

  void trunk(const glm::dvec2& at, double top, double radius) {
    canvas_.body(
        {at - radius, 0}, {at + radius, top}, 1,
        [&](const glm::dvec3& p) {
          return rod(p, {at, 0}, {at, top}, radius, 0.6 * radius);
        },
        [&](const glm::dvec3& p) {
          return glm::dvec3(0.3, 0.18, 0.1) * (1 + 0.4 * noise_.at(p * 64.0, glm::ivec3(64)));
        });
  }

  TextureCanvas& canvas_;
  PerlinNoise noise_;
  uint64_t state_;
};

}  // namespace

// lensch2002, Figure 7: opaque trees, flowers and floor; semi-transparent ground fog and smoke.
void paint_outdoor(TextureCanvas& canvas, uint32_t seed) {
  canvas.set_height(Garden::kHeight);
  Garden garden(canvas, seed);
  garden.fog();
  garden.smoke({0.6, 0.55});
  garden.floor();
  garden.flowers(160);
  // Jittered places on a lattice, a clearing around the fire left free.
  uint64_t state = seed + 1;
  for (int i = 0; i < 16; ++i) {
    const glm::dvec2 at =
        (glm::dvec2(i % 4, i / 4) + 0.25 + 0.5 * glm::dvec2(next_unit(state), next_unit(state))) / 4.0;
    const double height = 0.2 + 0.16 * next_unit(state), kind = next_unit(state);
    if (glm::length(at - glm::dvec2(0.62, 0.55)) < 0.2 || kind < 0.12) continue;
    kind < 0.6 ? garden.conifer(at, height) : garden.broadleaf(at, height);
  }
}

}  // namespace volumark
