#include "harness/metrics/flip.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "harness/metrics/colour.h"

namespace volumark {
namespace {

constexpr double kPixelsPerDegree = 67.0206;  // 0.7 m from a 0.7 m wide screen of 3840 pixels
constexpr double kPi2 = std::numbers::pi * std::numbers::pi;

// One term a sqrt(pi / b) exp(-pi^2 d^2 / b) of a contrast sensitivity filter, as separable kernel; d in degrees.
struct SensitivityTerm {
  std::vector<double> kernel;  // along one axis, sum 1
  double weight = 0;           // of the term's whole 2D kernel
};

SensitivityTerm sensitivity_term(double a, double b, int radius) {
  SensitivityTerm term{gaussian_kernel(std::sqrt(b / (2 * kPi2)) * kPixelsPerDegree, radius), 0};
  const double centre = term.kernel[static_cast<size_t>(radius)];  // 1 / sum of the unscaled kernel
  term.weight = a * std::sqrt(std::numbers::pi / b) / (centre * centre);
  return term;
}

struct Planes {
  Plane y, cx, cz;
};

Planes ycxcz_of(const std::array<Plane, 3>& rgb) {
  const size_t n = rgb[0].size();
  Planes out{Plane(n), Plane(n), Plane(n)};
  for (size_t i = 0; i < n; ++i) {
    const glm::dvec3 xyz = xyz_of({rgb[0][i], rgb[1][i], rgb[2][i]});
    out.y[i] = 116 * xyz.y - 16;
    out.cx[i] = 500 * (xyz.x - xyz.y);
    out.cz[i] = 200 * (xyz.y - xyz.z);
  }
  return out;
}

glm::dvec3 hunt_lab(const glm::dvec3& linear_rgb) {
  const glm::dvec3 lab = lab_of(xyz_of(linear_rgb));
  return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
}

double hyab(const glm::dvec3& a, const glm::dvec3& b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

// What the eye sees of the image at this distance: filtered by contrast sensitivity, in Hunt-adjusted L*a*b*.
std::vector<glm::dvec3> perceived(const Planes& image, int width, int height) {
  constexpr double widest = 0.04;  // the largest b below
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * kPi2)) * kPixelsPerDegree));
  auto filter = [&](const Plane& plane, const SensitivityTerm& term) {
    return convolve(plane, width, height, term.kernel, term.kernel);
  };
  const Plane y = filter(image.y, sensitivity_term(1, 0.0047, radius));
  const Plane cx = filter(image.cx, sensitivity_term(1, 0.0053, radius));
  const SensitivityTerm term1 = sensitivity_term(34.1, 0.04, radius), term2 = sensitivity_term(13.5, 0.025, radius);
  const Plane cz1 = filter(image.cz, term1), cz2 = filter(image.cz, term2);
  const double w1 = term1.weight / (term1.weight + term2.weight);

  std::vector<glm::dvec3> lab(y.size());
  for (size_t i = 0; i < lab.size(); ++i) {
    const double yn = (y[i] + 16) / 116, cz = w1 * cz1[i] + (1 - w1) * cz2[i];
    const glm::dvec3 rgb = linear_rgb_of({cx[i] / 500 + yn, yn, yn - cz / 200});
    lab[i] = hunt_lab(glm::clamp(rgb, 0.0, 1.0));
  }
  return lab;
}

// Scales the negative and the positive taps to sums of -1 and 1.
void normalise_signed(std::vector<double>& kernel) {
  double negative = 0, positive = 0;
  for (double k : kernel) (k < 0 ? negative : positive) += std::abs(k);
  for (double& k : kernel) k /= k < 0 ? negative : positive;
}

struct Features {
  Plane edge, point;  // magnitudes
};

Features features_of(const Plane& y, int width, int height) {
  const double sigma = 0.5 * 0.082 * kPixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const std::vector<double> blur = gaussian_kernel(sigma, radius);
  std::vector<double> first, second;
  for (int x = -radius; x <= radius; ++x) {
    const double g = std::exp(-x * x / (2 * sigma * sigma));
    first.push_back(-x * g);
    second.push_back((x * x / (sigma * sigma) - 1) * g);
  }
  normalise_signed(first);
  normalise_signed(second);

  Plane luma(y.size());
  for (size_t i = 0; i < y.size(); ++i) luma[i] = (y[i] + 16) / 116;
  const Plane blurred = convolve_rows(luma, width, height, blur);
  auto magnitude = [&](const std::vector<double>& kernel) {
    Plane gx = convolve(luma, width, height, kernel, blur);
    const Plane gy = convolve_columns(blurred, width, height, kernel);
    for (size_t i = 0; i < gx.size(); ++i) gx[i] = std::sqrt(gx[i] * gx[i] + gy[i] * gy[i]);
    return gx;
  };
  return {magnitude(first), magnitude(second)};
}

// Compresses large colour differences: [0, 0.4 cmax] fills [0, 0.95].
double redistribute(double difference, double cmax) {
  const double knee = 0.4 * cmax;
  return difference < knee ? 0.95 / knee * difference : 0.95 + (difference - knee) / (cmax - knee) * 0.05;
}

}  // namespace

Plane flip(const std::array<Plane, 3>& test, const std::array<Plane, 3>& reference, int width, int height) {
  constexpr double colour_power = 0.7;
  const double cmax = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), colour_power);
  const Planes test_planes = ycxcz_of(test), reference_planes = ycxcz_of(reference);
  const auto test_lab = perceived(test_planes, width, height);
  const auto reference_lab = perceived(reference_planes, width, height);
  const Features test_features = features_of(test_planes.y, width, height);
  const Features reference_features = features_of(reference_planes.y, width, height);

  Plane map(test[0].size());
  for (size_t i = 0; i < map.size(); ++i) {
    const double distance = hyab(test_lab[i], reference_lab[i]);
    if (distance == 0) continue;  // 0 to any positive power; a power of 0 needs the largest feature difference
    const double colour = redistribute(std::pow(distance, colour_power), cmax);
    const double edge = std::abs(test_features.edge[i] - reference_features.edge[i]);
    const double point = std::abs(test_features.point[i] - reference_features.point[i]);
    const double feature = std::sqrt(std::max(edge, point) / std::numbers::sqrt2);
    map[i] = std::clamp(std::pow(colour, 1 - feature), 0.0, 1.0);
  }
  return map;
}

}  // namespace volumark
