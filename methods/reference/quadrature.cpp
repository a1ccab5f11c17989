#include "methods/reference/quadrature.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace volumark {
namespace {

GaussRule make_rule(int n) {
  GaussRule rule;
  rule.count = n;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 0;
    for (int iteration = 0; iteration < 10; ++iteration) {
      double p = x, before = 1;
      for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = n * (x * p - before) / (x * x - 1);
      x -= p / slope;
    }
    if (2 * i + 1 == n) x = 0;
    rule.node[static_cast<size_t>(i)] = x;
    rule.weight[static_cast<size_t>(i)] = 2 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

// One Bernstein ellipse: |T_k| <= reach[k] = (rho^k + rho^-k) / 2 on it.
struct Ellipse {
  double log_rho, log_constant;
  std::array<double, 5> reach;
};

constexpr int kEllipses = 10;
std::array<Ellipse, kEllipses> make_ellipses() {
  std::array<Ellipse, kEllipses> out;
  const double log_rho[kEllipses] = {0.25, 0.5, 0.8, 1.2, 1.6, 2.0, 2.6, 3.2, 4.0, 5.0};
  for (size_t e = 0; e < kEllipses; ++e) {
    out[e].log_rho = log_rho[e];
    out[e].log_constant = std::log(64.0 / 15) - std::log1p(-std::exp(-2 * log_rho[e]));
    for (int k = 0; k < 5; ++k) out[e].reach[static_cast<size_t>(k)] = std::cosh(k * log_rho[e]);
  }
  return out;
}

}  // namespace

const GaussRule& gauss_rule(int count) {
  static const std::array<GaussRule, kMaxNodes> rules = [] {
    std::array<GaussRule, kMaxNodes> out;
    for (int n = 1; n <= kMaxNodes; ++n) out[static_cast<size_t>(n - 1)] = make_rule(n);
    return out;
  }();
  return rules[static_cast<size_t>(count - 1)];
}

int nodes_needed(const Quadratic& p, const Quartic& depth, double target) {
  static const std::array<Ellipse, kEllipses> ellipses = make_ellipses();
  // Chebyshev coefficients.
  const double p2 = std::abs(p[2]) / 2, p1 = std::abs(p[1]), p0 = std::abs(p[0] + p[2] / 2);
  const double d4 = std::abs(depth[4]) / 8, d3 = std::abs(depth[3]) / 4;
  const double d2 = std::abs(depth[2] + depth[4]) / 2, d1 = std::abs(depth[1] + 0.75 * depth[3]);
  const double d0 = depth[0] + depth[2] / 2 + 0.375 * depth[4];
  const double log_target = std::log(target);
  double fewest = kMaxNodes + 1;
  for (size_t e = kEllipses; e-- > 0;) {
    const auto& [log_rho, log_constant, reach] = ellipses[e];
    const double exponent = d1 * reach[1] + d2 * reach[2] + d3 * reach[3] + d4 * reach[4] - d0;
    if (exponent + log_constant - log_target > 2 * log_rho * fewest + 40) continue;  // far too wide: skip the logarithm
    const double size = p0 + p1 * reach[1] + p2 * reach[2];
    if (size == 0) return 1;
    const double nodes = std::max(1 + (log_constant + std::log(size) + exponent - log_target) / (2 * log_rho), 1.0);
    if (nodes > fewest) {
      if (fewest <= kMaxNodes) break;  // narrower ellipses only get worse from here
    } else {
      fewest = nodes;
    }
  }
  return fewest <= kMaxNodes ? static_cast<int>(std::ceil(fewest)) : 0;
}

namespace {
constexpr double kX[8] = {0.0,
                          0.22338668642896688163,
                          0.43424374934680255800,
                          0.62110294673722640294,
                          0.77459666924148337704,
                          0.88845923287225699889,
                          0.96049126870802028342,
                          0.99383196321275502221};
constexpr double kW15[8] = {0.22551049979820668739, 0.21915685840158749640, 0.20062852937698902103,
                            0.17151190913639138079, 0.13441525524378422036, 0.09292719531512453769,
                            0.05160328299707973970, 0.01700171962994026034};
constexpr double kW7[4] = {0.45091653865847414235, 0.40139741477596222291, 0.26848808986833344073,
                           0.10465622602646726519};
}  // namespace

const std::array<PattersonPoint, 15> kPatterson{{
    {kX[0], 8.0 / 9, kW7[0], kW15[0]},
    {-kX[4], 5.0 / 9, kW7[2], kW15[4]},
    {kX[4], 5.0 / 9, kW7[2], kW15[4]},
    {-kX[2], 0, kW7[1], kW15[2]},
    {kX[2], 0, kW7[1], kW15[2]},
    {-kX[6], 0, kW7[3], kW15[6]},
    {kX[6], 0, kW7[3], kW15[6]},
    {-kX[1], 0, 0, kW15[1]},
    {kX[1], 0, 0, kW15[1]},
    {-kX[3], 0, 0, kW15[3]},
    {kX[3], 0, 0, kW15[3]},
    {-kX[5], 0, 0, kW15[5]},
    {kX[5], 0, 0, kW15[5]},
    {-kX[7], 0, 0, kW15[7]},
    {kX[7], 0, 0, kW15[7]},
}};

}  // namespace volumark
