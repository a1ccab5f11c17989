#include "scenes/procedural_meshes.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <stdexcept>

#include "helpers.h"

namespace volumark {
namespace {

using Edge = std::pair<uint32_t, uint32_t>;

// How often each directed edge occurs.
std::map<Edge, int> directed_edges(const Mesh& mesh) {
  std::map<Edge, int> edges;
  for (const auto& t : mesh.triangles) {
    for (size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  }
  return edges;
}

void expect_normals_fit(const Mesh& mesh) {
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  for (const glm::dvec3& normal : mesh.normals) EXPECT_NEAR(glm::length(normal), 1, 1e-12);
  for (const auto& t : mesh.triangles) {
    const glm::dvec3 area =
        glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]);
    for (const uint32_t corner : t) EXPECT_GT(glm::dot(area, mesh.normals[corner]), 0);
  }
}

TEST(ProceduralMeshes, TheTorusOfTable1) {
  const Mesh mesh = make_mesh(TorusMesh{});
  EXPECT_EQ(mesh.triangles.size(), 576u);
  EXPECT_EQ(mesh.positions.size(), 288u);
  ASSERT_EQ(mesh.texture.size(), 576u);
  expect_normals_fit(mesh);
  // Closed and oriented: every edge once in each direction. 864 edges: Euler's number of a torus is 0.
  const auto edges = directed_edges(mesh);
  EXPECT_EQ(edges.size(), 2 * 864u);
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
  double volume = 0;
  for (const auto& t : mesh.triangles) {
    volume += glm::dot(mesh.positions[t[0]], glm::cross(mesh.positions[t[1]], mesh.positions[t[2]])) / 6;
  }
  EXPECT_GT(volume, 0);  // outside is outside
}

// Neighbours agree in (u, v) up to whole numbers, and every triangle has its own span.
TEST(ProceduralMeshes, SeamsOfTheTorus) {
  const Mesh mesh = make_mesh(TorusMesh{});
  std::map<uint32_t, glm::dvec2> known;
  int seams = 0;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (size_t i = 0; i < 3; ++i) {
      const glm::dvec2 uv = mesh.texture[t][i];
      const glm::dvec2 difference = uv - known.emplace(mesh.triangles[t][i], uv).first->second;
      EXPECT_EQ(std::round(difference.x), difference.x);
      EXPECT_EQ(std::round(difference.y), difference.y);
      seams += difference == glm::dvec2(0) ? 0 : 1;
      const glm::dvec2 side = glm::abs(uv - mesh.texture[t][(i + 1) % 3]);
      EXPECT_LE(side.x, 1.0 / 24 + 1e-12);
      EXPECT_LE(side.y, 1.0 / 12 + 1e-12);
    }
  }
  EXPECT_GT(seams, 0);
}

TEST(ProceduralMeshes, ATorusWithoutDistortionIsRound) {
  const TorusMesh torus{{24, 12}, 1, 0.4, 0};
  const Mesh mesh = make_mesh(torus);
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::dvec3 p = mesh.positions[i];
    const glm::dvec3 middle = glm::normalize(glm::dvec3(p.x, 0, p.z));
    EXPECT_NEAR(glm::length(p - middle), 0.4, 1e-12);
    EXPECT_NEAR(glm::length(mesh.normals[i] - (p - middle) / 0.4), 0, 1e-8);
  }
}

TEST(ProceduralMeshes, TheTerrainOfTable1) {
  const Mesh mesh = make_mesh(TerrainMesh{});
  EXPECT_EQ(mesh.triangles.size(), 3200u);
  EXPECT_EQ(mesh.positions.size(), 41u * 41u);
  expect_normals_fit(mesh);
  double lo = 1, hi = -1;
  for (const glm::dvec3& p : mesh.positions) {
    EXPECT_LE(std::abs(p.x), 1);
    EXPECT_LE(std::abs(p.z), 1);
    lo = std::min(lo, p.y);
    hi = std::max(hi, p.y);
  }
  EXPECT_GT(hi - lo, 0.1);
  EXPECT_LT(hi - lo, 0.5);
  for (const glm::dvec3& normal : mesh.normals) EXPECT_GT(normal.y, 0.3);
  EXPECT_NE(make_mesh(TerrainMesh{.seed = 2}).positions[100], mesh.positions[100]);
}

TEST(ProceduralMeshes, StripsKeepTheirLengthWhenBent) {
  const Mesh flat = make_mesh(StripMesh{{64, 2}, {3, 1}, 0}), bent = make_mesh(StripMesh{{64, 2}, {3, 1}, 2});
  expect_normals_fit(flat);
  expect_normals_fit(bent);
  const auto length = [](const Mesh& mesh) {
    double sum = 0;
    for (size_t i = 0; i < 64; ++i) sum += glm::length(mesh.positions[i + 1] - mesh.positions[i]);
    return sum;
  };
  EXPECT_NEAR(length(flat), 3, 1e-12);
  EXPECT_NEAR(length(bent), 3, 3 * 1e-4);  // chords of arcs of 1/32: 1 - (1/32)^2 / 24
  EXPECT_LT(bent.positions[0].y, bent.positions[32].y);
}

TEST(ProceduralMeshes, RefuseCountsOutOfRange) {
  EXPECT_THROW(make_mesh(TorusMesh{{2, 12}}), std::invalid_argument);
  EXPECT_THROW(make_mesh(StripMesh{{0, 1}}), std::invalid_argument);
  EXPECT_THROW(make_mesh(TerrainMesh{{1, 5000}}), std::invalid_argument);
}

}  // namespace
}  // namespace volumark
