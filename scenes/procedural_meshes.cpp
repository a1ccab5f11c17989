#include "scenes/procedural_meshes.h"

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

#include "scenes/noise.h"

namespace volumark {
namespace {

// Position at (u, v) in [0, 1]^2; also a little beyond, for the normals.
using Surface = std::function<glm::dvec3(double u, double v)>;

// Central differences: the error in the direction is about 1e-8, of no account beside the triangles. dv x du points up
// (or out) on all surfaces here.
glm::dvec3 normal_at(const Surface& surface, double u, double v) {
  constexpr double h = 1e-5;
  const glm::dvec3 du = surface(u + h, v) - surface(u - h, v), dv = surface(u, v + h) - surface(u, v - h);
  return glm::normalize(glm::cross(dv, du));
}

// `closed`: the last column and row are the first again.
Mesh grid(const Surface& surface, const glm::ivec2& cells, bool closed) {
  const int least = closed ? 3 : 1;
  if (cells.x < least || cells.y < least || cells.x > 4096 || cells.y > 4096) {
    throw std::invalid_argument("procedural mesh: number of cells out of range");
  }
  Mesh mesh;
  const glm::ivec2 points = closed ? cells : cells + 1;
  const auto coordinate = [&](int i, int j) {
    return glm::dvec2(static_cast<double>(i) / cells.x, static_cast<double>(j) / cells.y);
  };
  for (int j = 0; j < points.y; ++j) {
    for (int i = 0; i < points.x; ++i) {
      const glm::dvec2 uv = coordinate(i, j);
      mesh.positions.push_back(surface(uv.x, uv.y));
      mesh.normals.push_back(normal_at(surface, uv.x, uv.y));
    }
  }
  const auto add = [&](std::array<glm::ivec2, 3> corners) {
    std::array<uint32_t, 3> triangle;
    std::array<glm::dvec2, 3> uv;
    for (size_t c = 0; c < 3; ++c) {
      const glm::ivec2 at = corners[c];
      triangle[c] = static_cast<uint32_t>((at.y % points.y) * points.x + at.x % points.x);
      uv[c] = coordinate(at.x, at.y);
    }
    mesh.triangles.push_back(triangle);
    mesh.texture.push_back(uv);
  };
  for (int j = 0; j < cells.y; ++j) {
    for (int i = 0; i < cells.x; ++i) {
      const glm::ivec2 a(i, j), b(i + 1, j), c(i + 1, j + 1), d(i, j + 1);
      add({a, c, b});
      add({a, d, c});
    }
  }
  return mesh;
}

struct MakeMesh {
  Mesh operator()(const TorusMesh& torus) const {
    const auto surface = [&torus](double u, double v) {
      constexpr double turn = 2 * std::numbers::pi;
      const double s = torus.distortion;
      const double around = turn * u, across = turn * v;
      const double radius = torus.radius * (1 + 0.35 * s * std::cos(2 * around + 0.7));
      const double tube = torus.tube * (1 + 0.6 * s * std::sin(3 * around));
      const double lift = torus.radius * 0.8 * s * std::sin(2 * around);
      const double out = radius + tube * std::cos(across);
      return glm::dvec3(out * std::sin(around), lift - tube * std::sin(across), out * std::cos(around));
    };
    return grid(surface, torus.segments, true);
  }
  Mesh operator()(const TerrainMesh& terrain) const {
    const PerlinNoise noise(terrain.seed);
    const auto surface = [&](double u, double v) {
      const double y = terrain.height * noise.fbm({u * terrain.frequency, v * terrain.frequency, 0.5}, 3);
      return glm::dvec3((u - 0.5) * terrain.extent, y, (v - 0.5) * terrain.extent);
    };
    return grid(surface, terrain.cells, false);
  }
  Mesh operator()(const StripMesh& strip) const {
    const auto surface = [&strip](double u, double v) {
      const double x = (u - 0.5) * strip.extent.x, z = (v - 0.5) * strip.extent.y;
      if (strip.bend == 0) return glm::dvec3(x, 0, z);
      const double radius = strip.extent.x / strip.bend, angle = x / radius;
      return glm::dvec3(radius * std::sin(angle), radius * (std::cos(angle) - 1), z);
    };
    return grid(surface, strip.cells, false);
  }
};

}  // namespace

Mesh make_mesh(const MeshSpec& spec) { return std::visit(MakeMesh{}, spec); }

}  // namespace volumark
