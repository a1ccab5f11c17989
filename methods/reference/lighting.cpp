#include "methods/reference/lighting.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace volumark {
namespace {

constexpr double kSmoothPower = 6;  // from this shininess on, max(0, n . h)^shininess needs no split at 0

glm::dvec3 unit_or_zero(const glm::dvec3& v) {
  const double length = std::sqrt(glm::dot(v, v));
  return length > 0 ? v / length : glm::dvec3(0);
}

// The zeros in (0, 1) of a polynomial, trailing zero coefficients allowed.
void append_roots(std::span<const double> polynomial, std::vector<double>& splits) {
  while (polynomial.size() > 1 && polynomial.back() == 0) polynomial = polynomial.first(polynomial.size() - 1);
  if (one_sign_on_unit(polynomial)) return;
  const Roots roots = roots_between(polynomial, 0, 1);
  for (int i = 0; i < roots.count; ++i) splits.push_back(roots.at[static_cast<size_t>(i)]);
}

double whole_power(double base, int exponent) {
  double result = 1;
  for (; exponent > 0; exponent >>= 1, base *= base)
    if (exponent & 1) result *= base;
  return result;
}

}  // namespace

RayLights::RayLights(const Lighting& lighting, const Volume& volume, const Ray& ray, double floor)
    : RayLights(lighting, volume.axes, ray, floor) {}

RayLights::RayLights(const Lighting& lighting, const glm::dmat3& axes, const Ray& ray, double floor)
    : lighting_(lighting), floor_(floor) {
  const glm::dmat3 to_axes = glm::transpose(axes);
  direction_ = to_axes * ray.direction;
  const double shininess = lighting.shininess;
  const bool whole = shininess >= 0 && shininess <= 1024 && shininess == std::floor(shininess);
  whole_shininess_ = whole ? static_cast<int>(shininess) : -1;
  for (const Light& light : lighting.lights) {
    LightOnRay out{light.kind == Light::Kind::Point, {}, {}, light.colour};
    out.vector = to_axes * (out.point ? light.vector - ray.origin : light.vector);
    out.half = out.point ? glm::dvec3(0) : unit_or_zero(out.vector - direction_);
    lights_.push_back(out);
  }
}

glm::dvec3 RayLights::unit_normal(const glm::dvec3& gradient) const {
  return gradient / -std::max(glm::length(gradient), floor_);
}

RayLights::Contribution RayLights::contribution(const LightOnRay& light, const glm::dvec3& normal, double t) const {
  Contribution out;
  const glm::dvec3 to_light = light.point ? unit_or_zero(light.vector - t * direction_) : light.vector;
  out.n_l = glm::dot(normal, to_light);
  if (lighting_.two_sided) out.n_l = std::abs(out.n_l);
  if (out.n_l > 0) out.diffuse = lighting_.diffuse * out.n_l;
  if (lighting_.specular == 0) return out;
  out.n_h = glm::dot(normal, light.point ? unit_or_zero(to_light - direction_) : light.half);
  if (lighting_.two_sided) out.n_h = std::abs(out.n_h);
  if (out.n_h <= 0 || !(out.n_l > 0 || lighting_.two_sided)) return out;
  const double power =
      whole_shininess_ >= 0 ? whole_power(out.n_h, whole_shininess_) : std::pow(out.n_h, lighting_.shininess);
  out.specular = lighting_.specular * power;
  return out;
}

glm::dvec3 RayLights::shade(const glm::dvec3& gradient, double t, const glm::dvec3& colour) const {
  glm::dvec3 diffuse(lighting_.ambient), specular(0);
  const glm::dvec3 normal = unit_normal(gradient);
  for (const LightOnRay& light : lights_) {
    const Contribution from = contribution(light, normal, t);
    diffuse += light.colour * from.diffuse;
    specular += light.colour * from.specular;
  }
  return colour * diffuse + specular;
}

glm::dvec3 RayLights::shade(const glm::dvec3& gradient, double t, const glm::dvec3& colour,
                            const glm::dvec3& ambient_colour) const {
  return shade(gradient, t, colour) + (ambient_colour - colour) * lighting_.ambient;
}

double RayLights::shading_error(const glm::dvec3& gradient, double t, double error) const {
  // Normalising a vector moved by `error` moves it by 2 error / length at most, and below the floor by error / floor.
  const double turn = std::min(2 * error / std::max(glm::length(gradient), floor_), 2.0);
  const glm::dvec3 normal = unit_normal(gradient);
  double sum = 0;
  for (const LightOnRay& light : lights_) {
    const double brightest = std::max({light.colour.x, light.colour.y, light.colour.z});
    sum += brightest * lighting_.diffuse * turn;
    if (lighting_.specular == 0) continue;
    const Contribution from = contribution(light, normal, t);
    const double n_h = std::clamp(from.n_h + turn, 0.0, 1.0), before = std::pow(n_h, lighting_.shininess);
    const double slope =
        lighting_.shininess >= 1 ? lighting_.shininess * std::pow(n_h, lighting_.shininess - 1) * turn : before;
    const bool either_side = !lighting_.two_sided && std::abs(from.n_l) <= turn;
    sum += brightest * lighting_.specular * std::min(either_side ? before : slope, 1.0);
  }
  return sum;
}

void RayLights::append_splits(const GradientChord& gradient, double t0, double length,
                              std::vector<double>& splits) const {
  auto split_at_zeros = [&](const glm::dvec3& start, const glm::dvec3& change) {  // of g . (start + u change)
    std::array<double, 5> product{};
    for (size_t a = 0; a < 3; ++a) {
      const int axis = static_cast<int>(a);
      for (size_t k = 0; k < 4; ++k) {
        product[k] += gradient[a][k] * start[axis];
        product[k + 1] += gradient[a][k] * change[axis];
      }
    }
    append_roots(product, splits);
  };
  std::array<double, 7> excess{-floor_ * floor_};  // |g|^2 - floor^2
  for (const Cubic& component : gradient) {
    for (size_t i = 0; i < 4; ++i) {
      for (size_t k = 0; k < 4; ++k) excess[i + k] += component[i] * component[k];
    }
  }
  append_roots(excess, splits);
  const bool kinked_highlights = lighting_.specular > 0 && lighting_.shininess < kSmoothPower;
  for (const LightOnRay& light : lights_) {
    if (light.point) {
      split_at_zeros(light.vector - t0 * direction_, -length * direction_);
      if (kinked_highlights) append_highlight_edges(gradient, light, t0, length, splits);
    } else {
      split_at_zeros(light.vector, glm::dvec3(0));
      if (kinked_highlights) split_at_zeros(light.half, glm::dvec3(0));
    }
  }
}

// A point light's half vector is no polynomial of u: its side is sampled, and each change located by bisection.
void RayLights::append_highlight_edges(const GradientChord& gradient, const LightOnRay& light, double t0, double length,
                                       std::vector<double>& splits) const {
  constexpr int samples = 16;
  auto side = [&](double u) {
    const glm::dvec3 to_light = unit_or_zero(light.vector - (t0 + u * length) * direction_);
    const glm::dvec3 g(evaluate(gradient[0], u), evaluate(gradient[1], u), evaluate(gradient[2], u));
    return glm::dot(g, to_light - direction_) > 0;
  };
  for (int i = 0; i < samples; ++i) {
    double a = static_cast<double>(i) / samples, b = static_cast<double>(i + 1) / samples;
    const bool before = side(a);
    if (before == side(b)) continue;
    for (int k = 0; k < 48; ++k) {
      const double middle = 0.5 * (a + b);
      (side(middle) == before ? a : b) = middle;
    }
    splits.push_back(0.5 * (a + b));
  }
}

LightingBound lighting_bound(const Lighting& lighting) {
  LightingBound bound{lighting.ambient, 0};
  for (const Light& light : lighting.lights) {
    const double brightest = std::max({light.colour.x, light.colour.y, light.colour.z});
    bound.gain += brightest * lighting.diffuse;
    bound.offset += brightest * lighting.specular;
  }
  return bound;
}

}  // namespace volumark
