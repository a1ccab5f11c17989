// Quadrature on [-1, 1]: Gauss-Legendre with an a-priori error bound for p(v) exp(-D(v)), and the nested
// Gauss-Kronrod-Patterson rules of 3, 7 and 15 points for what has no such bound.
#pragma once

#include <array>
#include <span>

namespace volumark {

inline constexpr int kMaxNodes = 24;

struct GaussRule {
  int count = 0;
  std::array<double, kMaxNodes> node, weight;
};
const GaussRule& gauss_rule(int count);  // 1 <= count <= kMaxNodes

using Quartic = std::array<double, 5>;
using Quadratic = std::array<double, 3>;

// The fewest nodes for which the Gauss rule's error on the integral of p(v) exp(-D(v)) is proved to stay within
// `target`
// (> 0); 0 where more than kMaxNodes would be needed. An n-point rule errs by at most 64/15 M rho^(2 - 2n) / (1 -
// rho^-2) where |f| <= M on the Bernstein ellipse of parameter rho (Trefethen, Approximation Theory and Practice,
// thm 19.3).
int nodes_needed(const Quadratic& p, const Quartic& depth, double target);

// Points of the 15-point Patterson rule, which holds the 7- and the 3-point ones: those of the latter come first.
struct PattersonPoint {
  double node, weight3, weight7, weight15;
};
extern const std::array<PattersonPoint, 15> kPatterson;

}  // namespace volumark
