#include "methods/shell_slices/prisms.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <unordered_map>

#include "methods/shell_slices/section.h"

namespace volumark {
namespace {

// c0 + c1 w + c2 w^2 on [0, 1], with a bound on the rounding in it.
struct Quadratic {
  double c0, c1, c2, error;
};

// N(w) . d with N(w) = (e1 + w f1) x (e2 + w f2).
Quadratic volume_density(const glm::dvec3& e1, const glm::dvec3& f1, const glm::dvec3& e2, const glm::dvec3& f2,
                         const glm::dvec3& d) {
  const double largest1 = glm::length(e1) + glm::length(f1), largest2 = glm::length(e2) + glm::length(f2);
  // Differences, two products and sums of a few terms each: below 32 roundings of the largest term.
  const double error = 32 * std::numeric_limits<double>::epsilon() * largest1 * largest2 * glm::length(d);
  return {glm::dot(glm::cross(e1, e2), d), glm::dot(glm::cross(e1, f2) + glm::cross(f1, e2), d),
          glm::dot(glm::cross(f1, f2), d), error};
}

// The least of sign * q over [0, 1], less the error of q.
double least_of(const Quadratic& q, double sign) {
  const double c0 = sign * q.c0, c1 = sign * q.c1, c2 = sign * q.c2;
  double least = std::min(c0, c0 + c1 + c2);
  if (c2 > 0 && c1 < 0 && -c1 < 2 * c2) least = std::min(least, c0 - c1 * c1 / (4 * c2));
  return least - q.error;
}

double reach_of(const ShellPrisms& shell, const Prism& prism, const glm::dvec3& middle, glm::dvec3& farthest) {
  double reach = -1;
  for (int i = 0; i < 6; ++i) {
    const glm::dvec3 corner(shell.corner(prism, i));
    const double distance = glm::distance(middle, corner);
    if (distance > reach) farthest = corner;
    reach = std::max(reach, distance);
  }
  return reach;
}

// The smallest sphere around the six corners, but for a few per cent (Badoiu and Clarkson 2003: steps towards the
// farthest corner, each shorter than the one before).
void bound(const ShellPrisms& shell, Prism& prism) {
  glm::dvec3 middle(0), farthest(0);
  for (int i = 0; i < 6; ++i) middle += glm::dvec3(shell.corner(prism, i)) / 6.;
  prism.middle = middle;
  prism.radius = reach_of(shell, prism, middle, farthest);
  for (int step = 2; step < 64; ++step) {
    middle += (farthest - middle) / static_cast<double>(step);
    const double reach = reach_of(shell, prism, middle, farthest);
    if (reach >= prism.radius) continue;
    prism.middle = middle;
    prism.radius = reach;
  }
}

bool has_volume(const std::array<glm::dvec3, 3>& lower, const std::array<glm::dvec3, 3>& upper) {
  const glm::dvec3 e1 = lower[1] - lower[0], e2 = lower[2] - lower[0];
  const glm::dvec3 g1 = upper[1] - upper[0], g2 = upper[2] - upper[0];
  for (size_t i = 0; i < 3; ++i) {
    const Quadratic q = volume_density(e1, g1 - e1, e2, g2 - e2, upper[i] - lower[i]);
    const double largest = std::max({std::abs(q.c0), std::abs(q.c0 + q.c1 / 2), std::abs(q.c0 + q.c1 + q.c2)});
    if (largest > q.error) return true;
  }
  return false;
}

struct EdgeKey {
  std::array<uint32_t, 8> words;  // kind and ends, texture coordinates of the ends
  bool operator==(const EdgeKey&) const = default;
};
struct EdgeKeyHash {
  size_t operator()(const EdgeKey& key) const {
    uint64_t hash = 1469598103934665603U;  // FNV-1a
    for (const uint32_t word : key.words) hash = (hash ^ word) * 1099511628211U;
    return static_cast<size_t>(hash ^ (hash >> 29));
  }
};

EdgeKey key_of(uint32_t a, uint32_t b, const FakeVertex& edge) {
  EdgeKey key{};
  key.words[0] = a;
  key.words[1] = b;
  // Adding 0 makes one zero of both.
  const glm::vec3 zero(0), ta = edge.texture_a + zero, tb = edge.texture_b + zero;
  std::memcpy(&key.words[2], &ta, sizeof(ta));
  std::memcpy(&key.words[5], &tb, sizeof(tb));
  return key;
}

}  // namespace

int jacobian_sign(const std::array<glm::dvec3, 3>& lower, const std::array<glm::dvec3, 3>& upper) {
  const glm::dvec3 e1 = lower[1] - lower[0], e2 = lower[2] - lower[0];
  const glm::dvec3 f1 = (upper[1] - upper[0]) - e1, f2 = (upper[2] - upper[0]) - e2;
  bool positive = true, negative = true, thick = false;
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 d = upper[i] - lower[i];
    if (d == glm::dvec3(0)) continue;
    thick = true;
    const Quadratic q = volume_density(e1, f1, e2, f2, d);
    positive = positive && least_of(q, 1) > 0;
    negative = negative && least_of(q, -1) > 0;
  }
  return !thick ? 0 : positive ? 1 : negative ? -1 : 0;
}

ShellPrisms shell_prisms(const Shell& shell, bool lit) {
  ShellPrisms out;
  const ShellBounds bounds = bounds_of(shell);
  out.middle = 0.5 * (bounds.lo + bounds.hi);
  out.radius = std::max(0.5 * glm::distance(bounds.lo, bounds.hi), std::numeric_limits<double>::min());
  const Mesh& mesh = *shell.mesh;
  const std::vector<std::array<glm::dmat3, 6>> gradients =
      lit ? cotangents(shell) : std::vector<std::array<glm::dmat3, 6>>();
  for (uint32_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::dvec3 lower = mesh.positions[i] - out.middle;
    out.lower.emplace_back(lower);
    out.upper.emplace_back(lower + shell.offset(i));
  }
  for (uint32_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
    Prism prism{mesh.triangles[triangle], triangle, {}, {}, 0};
    std::array<glm::dvec3, 3> lower, upper;
    for (size_t i = 0; i < 3; ++i) {
      lower[i] = out.lower[prism.position[i]];
      upper[i] = out.upper[prism.position[i]];
    }
    if (jacobian_sign(lower, upper) == 0) {
      ++(has_volume(lower, upper) ? out.self_intersecting : out.degenerate);
      continue;
    }
    for (size_t i = 0; i < 6; ++i) prism.texture[i] = glm::vec3(shell.texture[triangle][i]);
    bound(out, prism);
    out.prisms.push_back(prism);
    if (!lit) continue;
    std::array<glm::mat3, 6>& own = out.cotangents.emplace_back();
    for (size_t i = 0; i < 6; ++i) own[i] = glm::mat3(out.radius * gradients[triangle][i]);
  }
  return out;
}

EdgeTable edge_table(const ShellPrisms& shell, bool share) {
  EdgeTable table;
  std::unordered_map<EdgeKey, uint32_t, EdgeKeyHash> known;
  const auto positions = static_cast<uint32_t>(shell.lower.size());
  for (const Prism& prism : shell.prisms) {
    std::array<uint32_t, 9>& own = table.of_prism.emplace_back();
    for (size_t edge = 0; edge < kPrismEdges; ++edge) {
      int from = kEdgeEnds[edge][0], to = kEdgeEnds[edge][1];
      const auto index = [&](int corner) {
        return prism.position[static_cast<size_t>(corner % 3)] + (corner < 3 ? 0 : positions);
      };
      if (index(to) < index(from)) std::swap(from, to);
      const FakeVertex vertex{shell.corner(prism, from), shell.corner(prism, to),
                              prism.texture[static_cast<size_t>(from)], prism.texture[static_cast<size_t>(to)]};
      const auto next = static_cast<uint32_t>(table.edges.size());
      const uint32_t entry =
          share ? known.try_emplace(key_of(index(from), index(to), vertex), next).first->second : next;
      if (entry == next) {
        table.edges.push_back(vertex);
        if (!shell.cotangents.empty()) {
          const std::array<glm::mat3, 6>& at = shell.cotangents[table.of_prism.size() - 1];
          table.cotangents.push_back({at[static_cast<size_t>(from)], at[static_cast<size_t>(to)]});
        }
      }
      own[edge] = entry;
    }
  }
  return table;
}

}  // namespace volumark
