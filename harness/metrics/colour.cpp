#include "harness/metrics/colour.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace volumark {
namespace {

// The rational sRGB matrix that FLIP's authors use. GLM is column-major: the columns are R, G and B.
const glm::dmat3 kRgbToXyz(10135552.0 / 24577794, 2613072.0 / 12288897, 1425312.0 / 73733382,  // R
                           8788810.0 / 24577794, 8788810.0 / 12288897, 8788810.0 / 73733382,   // G
                           4435075.0 / 24577794, 887015.0 / 12288897, 70074185.0 / 73733382);  // B
const glm::dvec3 kWhite = kRgbToXyz * glm::dvec3(1);
const glm::dmat3 kXyzToRgb = glm::inverse(kRgbToXyz);

double lab_curve(double t) {
  constexpr double delta = 6.0 / 29;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
}

constexpr double kDegree = std::numbers::pi / 180;

// Hue angle in [0, 360), 0 for grey.
double hue(double a, double b) {
  if (a == 0 && b == 0) return 0;
  const double h = std::atan2(b, a) / kDegree;
  return h < 0 ? h + 360 : h;
}

double pow7_ratio(double chroma) {  // sqrt(c^7 / (c^7 + 25^7))
  const double c7 = std::pow(chroma, 7);
  return std::sqrt(c7 / (c7 + 6103515625.0));
}

}  // namespace

double srgb_encode(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded) {
  const double x = std::clamp(encoded, 0.0, 1.0);
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

glm::dvec3 xyz_of(const glm::dvec3& linear_rgb) { return kRgbToXyz * linear_rgb / kWhite; }
glm::dvec3 linear_rgb_of(const glm::dvec3& xyz) { return kXyzToRgb * (xyz * kWhite); }

glm::dvec3 lab_of(const glm::dvec3& xyz) {
  const double x = lab_curve(xyz.x), y = lab_curve(xyz.y), z = lab_curve(xyz.z);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double ciede2000(const glm::dvec3& lab1, const glm::dvec3& lab2) {
  const double c_mean = (std::hypot(lab1.y, lab1.z) + std::hypot(lab2.y, lab2.z)) / 2;
  const double g = 0.5 * (1 - pow7_ratio(c_mean));
  const double a1 = (1 + g) * lab1.y, a2 = (1 + g) * lab2.y;
  const double c1 = std::hypot(a1, lab1.z), c2 = std::hypot(a2, lab2.z);
  const double h1 = hue(a1, lab1.z), h2 = hue(a2, lab2.z);
  const bool grey = c1 * c2 == 0;

  double dh = grey ? 0 : h2 - h1;
  if (dh > 180) dh -= 360;
  if (dh < -180) dh += 360;
  const double d_lightness = lab2.x - lab1.x, d_chroma = c2 - c1;
  const double d_hue = 2 * std::sqrt(c1 * c2) * std::sin(dh / 2 * kDegree);

  const double l = (lab1.x + lab2.x) / 2, c = (c1 + c2) / 2;
  double h = h1 + h2;
  if (!grey) {
    if (std::abs(h1 - h2) > 180) h += h < 360 ? 360 : -360;
    h /= 2;
  }
  const double t = 1 - 0.17 * std::cos((h - 30) * kDegree) + 0.24 * std::cos(2 * h * kDegree) +
                   0.32 * std::cos((3 * h + 6) * kDegree) - 0.20 * std::cos((4 * h - 63) * kDegree);
  const double bow = (h - 275) / 25;
  const double rotation = -2 * pow7_ratio(c) * std::sin(60 * std::exp(-bow * bow) * kDegree);
  const double l50 = (l - 50) * (l - 50);
  const double l_term = d_lightness / (1 + 0.015 * l50 / std::sqrt(20 + l50));
  const double c_term = d_chroma / (1 + 0.045 * c);
  const double h_term = d_hue / (1 + 0.015 * c * t);
  return std::sqrt(l_term * l_term + c_term * c_term + h_term * h_term + rotation * c_term * h_term);
}

}  // namespace volumark
