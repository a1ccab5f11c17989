#include "methods/reference/polynomial.h"

#include <algorithm>
#include <cmath>

namespace volumark {
namespace {

double horner(std::span<const double> c, double u) {
  double sum = 0;
  for (size_t k = c.size(); k-- > 0;) sum = sum * u + c[k];
  return sum;
}

// Newton's method inside a bracket [a, b] with a sign change; bisects where Newton would leave it or stalls.
template <typename F>
double safeguarded_newton(F&& value_and_slope, double a, double b, double value_a) {
  double u = 0.5 * (a + b);
  double last = b - a;
  for (int i = 0; i < 80; ++i) {
    const auto [value, slope] = value_and_slope(u);
    if (value == 0) return u;
    ((value < 0) == (value_a < 0) ? a : b) = u;
    double next = u - value / slope;
    if (!(next > a && next < b) || std::abs(next - u) > 0.5 * last) next = 0.5 * (a + b);
    last = std::abs(next - u);
    if (last <= 1e-16 * std::abs(u) || next == u || b - a <= 1e-16 * std::abs(u)) return next;
    u = next;
  }
  return u;
}

void add_inside(Roots& roots, double u, double lo, double hi) {
  if (u > lo && u < hi) roots.at[static_cast<size_t>(roots.count++)] = u;
}

Roots quadratic_roots(double c0, double c1, double c2, double lo, double hi) {
  Roots roots;
  const double discriminant = c1 * c1 - 4 * c2 * c0;
  if (discriminant < 0 || (discriminant == 0 && c2 != 0)) return roots;  // a double root does not change the sign
  const double q = -0.5 * (c1 + std::copysign(std::sqrt(discriminant), c1));
  if (c2 != 0) add_inside(roots, q / c2, lo, hi);
  if (q != 0) add_inside(roots, c0 / q, lo, hi);
  if (roots.count == 2 && roots.at[0] > roots.at[1]) std::swap(roots.at[0], roots.at[1]);
  return roots;
}

}  // namespace

Roots roots_between(std::span<const double> c, double lo, double hi) {
  if (c.size() < 2) return {};
  if (c.size() == 2) return quadratic_roots(c[0], c[1], 0, lo, hi);
  if (c.size() == 3) return quadratic_roots(c[0], c[1], c[2], lo, hi);
  std::array<double, kMaxDegree> slope;
  for (size_t k = 1; k < c.size(); ++k) slope[k - 1] = static_cast<double>(k) * c[k];
  const std::span<const double> derivative(slope.data(), c.size() - 1);
  const Roots turns = roots_between(derivative, lo, hi);
  Roots roots;
  double a = lo, value_a = horner(c, a);
  for (int i = 0; i <= turns.count; ++i) {
    const double b = i < turns.count ? turns.at[static_cast<size_t>(i)] : hi;
    const double value_b = horner(c, b);
    if ((value_a < 0 && value_b > 0) || (value_a > 0 && value_b < 0)) {
      auto both = [&](double u) { return std::pair(horner(c, u), horner(derivative, u)); };
      add_inside(roots, safeguarded_newton(both, a, b, value_a), lo, hi);
    }
    if (value_b != 0) value_a = value_b;  // a zero met exactly at a turn keeps the sign from before it
    a = b;
  }
  return roots;
}

bool one_sign_on_unit(std::span<const double> c) {
  // b_k = sum over i <= k of binomial(k, i) / binomial(degree, i) c_i, by repeated addition of neighbours.
  static constexpr double inverse_binomial[kMaxDegree + 1][kMaxDegree + 1] = {
      {1},
      {1, 1},
      {1, 1.0 / 2, 1},
      {1, 1.0 / 3, 1.0 / 3, 1},
      {1, 1.0 / 4, 1.0 / 6, 1.0 / 4, 1},
      {1, 1.0 / 5, 1.0 / 10, 1.0 / 10, 1.0 / 5, 1},
      {1, 1.0 / 6, 1.0 / 15, 1.0 / 20, 1.0 / 15, 1.0 / 6, 1}};
  const size_t n = c.size();
  std::array<double, kMaxDegree + 1> b;
  for (size_t k = 0; k < n; ++k) b[k] = c[k] * inverse_binomial[n - 1][k];
  for (size_t round = 1; round < n; ++round)
    for (size_t k = n - 1; k >= round; --k) b[k] += b[k - 1];
  const auto [least, most] = std::minmax_element(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(n));
  return *least > 0 || *most < 0;
}

double solve_monotone(const Cubic& c, double value, double a, double b) {
  const double value_a = evaluate(c, a) - value, value_b = evaluate(c, b) - value;
  if (value_a == 0) return a;
  if ((value_a < 0) == (value_b < 0)) return std::abs(value_a) < std::abs(value_b) ? a : b;  // rounding only
  auto both = [&](double u) { return std::pair(evaluate(c, u) - value, derivative(c, u)); };
  return safeguarded_newton(both, a, b, value_a);
}

}  // namespace volumark
