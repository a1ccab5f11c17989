#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "harness/metrics/colour.h"
#include "harness/metrics/metrics.h"

namespace volumark {
namespace {

// Matplotlib's magma as a polynomial of degree 6 (fit by M. Zucker, CC0), sRGB-encoded, within 0.02 of the table.
glm::dvec3 magma(double t) {
  static const glm::dvec3 c[7] = {{-0.002136485053939582, -0.000749655052795221, -0.005386127855323933},
                                  {0.2516605407371642, 0.6775232436837668, 2.494026599312351},
                                  {8.353717279216625, -3.577719514958484, 0.3144679030132573},
                                  {-27.66873308576866, 14.26473078096533, -13.64921318813922},
                                  {52.17613981234068, -27.94360607168351, 12.94416944238394},
                                  {-50.76852536473588, 29.04658282127291, 4.23415299384598},
                                  {18.65570506591883, -11.48977351997711, -5.601961508734096}};
  glm::dvec3 sum = c[6];
  for (int i = 5; i >= 0; --i) sum = sum * t + c[i];
  return sum;
}

void put(Image& image, size_t i, const glm::dvec3& srgb) {
  for (int c = 0; c < 3; ++c) image.rgba[4 * i + static_cast<size_t>(c)] = static_cast<float>(srgb_decode(srgb[c]));
  image.rgba[4 * i + 3] = 1;
}

}  // namespace

Image signed_difference_picture(const Image& test, const Image& reference, double full_scale,
                                const glm::dvec3& background) {
  if (test.width != reference.width || test.height != reference.height)
    throw MetricError("difference picture of images of unequal size");
  const Image a = composite(test, background), b = composite(reference, background);
  Image out(a.width, a.height);
  for (size_t i = 0; i < out.rgba.size() / 4; ++i) {
    glm::dvec3 srgb;
    for (int c = 0; c < 3; ++c) {
      const size_t k = 4 * i + static_cast<size_t>(c);
      srgb[c] = 0.5 + 0.5 * (static_cast<double>(a.rgba[k]) - static_cast<double>(b.rgba[k])) / full_scale;
    }
    const bool finite = std::isfinite(srgb.x) && std::isfinite(srgb.y) && std::isfinite(srgb.z);
    put(out, i, finite ? srgb : glm::dvec3(1, 0, 1));
  }
  return out;
}

Image flip_picture(std::span<const float> map, int width, int height) {
  Image out(width, height);
  if (map.size() != out.rgba.size() / 4) throw MetricError("FLIP map of another size than its picture");
  for (size_t i = 0; i < map.size(); ++i) put(out, i, magma(std::clamp(static_cast<double>(map[i]), 0.0, 1.0)));
  return out;
}

}  // namespace volumark
