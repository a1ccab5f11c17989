#include "methods/shell_slices/prisms.h"

#include <algorithm>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <unordered_map>

#include "methods/shell_slices/section.h"
#include "scenes/prism_faults.h"

namespace volumark {
namespace {

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
  const std::vector<PrismFault> faults = prism_faults(shell);
  for (uint32_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
    if (faults[triangle] != PrismFault::None) {
      ++(faults[triangle] == PrismFault::Degenerate ? out.degenerate : out.self_intersecting);
      continue;
    }
    Prism prism{mesh.triangles[triangle], triangle, {}, {}, 0};
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
