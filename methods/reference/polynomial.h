// Polynomials of low degree in one variable; coefficient k belongs to u^k.
#pragma once

#include <array>
#include <span>

namespace volumark {

inline constexpr int kMaxDegree = 6;
using Cubic = std::array<double, 4>;

template <size_t N>
double evaluate(const std::array<double, N>& c, double u) {
  double sum = c[N - 1];
  for (size_t k = N - 1; k-- > 0;) sum = sum * u + c[k];
  return sum;
}
inline double derivative(const Cubic& c, double u) { return (3 * c[3] * u + 2 * c[2]) * u + c[1]; }
inline double second_derivative(const Cubic& c, double u) { return 6 * c[3] * u + 2 * c[2]; }

// Where the polynomial changes sign inside (lo, hi), ascending. At most the degree; degree <= kMaxDegree.
struct Roots {
  std::array<double, kMaxDegree> at;
  int count = 0;
};
Roots roots_between(std::span<const double> c, double lo, double hi);

// Whether the Bernstein coefficients on [0, 1] all have one sign: then the polynomial has no zero there.
bool one_sign_on_unit(std::span<const double> c);

// The u in [a, b] where the cubic, monotone there, takes `value`, which lies between its values at a and b.
double solve_monotone(const Cubic& c, double value, double a, double b);

}  // namespace volumark
