#include "tests/report/synthetic_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace volumark::report_test {
namespace {

// Uniform in [-1, 1), the same on every machine.
double noise(int x, int y, int seed) {
  uint32_t h = static_cast<uint32_t>(x) * 0x9e3779b9u ^ static_cast<uint32_t>(y) * 0x85ebca6bu ^
               static_cast<uint32_t>(seed) * 0xc2b2ae35u;
  h ^= h >> 15;
  h *= 0x2c1b3c6du;
  h ^= h >> 12;
  h *= 0x297a2d39u;
  h ^= h >> 15;
  return static_cast<double>(h) / 2147483648.0 - 1;
}

}  // namespace

Image ball(int scene, int view, double step, double strength, int seed) {
  Image out(kSize, kSize);
  const double turn = 0.4 * view, cx = 0.5 + 0.08 * std::sin(turn), cy = 0.5 + 0.05 * std::cos(turn);
  const double colour[3] = {scene == 0 ? 0.9 : 0.35, 0.55, scene == 0 ? 0.3 : 0.85};
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const double u = ((x + 0.5) / kSize - cx) / 0.4, v = ((y + 0.5) / kSize - cy) / 0.4;
      const double r2 = u * u + v * v, chord = r2 < 1 ? std::sqrt(1 - r2) : 0;
      const double opacity = -std::expm1(-3 * chord), light = 0.35 + 0.65 * std::max(0.0, (chord - 0.5 * u - v) / 1.5);
      const double band = step > 0 ? strength * step * step * std::sin(14 * chord + 9 * u) : 0;
      for (int c = 0; c < 3; ++c) {
        const double exact = opacity * light * colour[c] + (1 - opacity) * 0.02;
        const double wrong = opacity * band + (step > 0 ? 2e-6 * noise(x, y, seed) : 0);
        out.pixel(x, y)[c] = static_cast<float>(std::clamp(exact + wrong, 0.0, 1.0));
      }
      out.pixel(x, y)[3] = 1;
    }
  return out;
}

}  // namespace volumark::report_test
