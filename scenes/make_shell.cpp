#include "scenes/make_shell.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/errors.h"

namespace volumark {
namespace {

constexpr double kFar = 1e12;  // world units; as in scene files

bool usable(const glm::dvec3& p) {
  return std::abs(p.x) <= kFar && std::abs(p.y) <= kFar && std::abs(p.z) <= kFar;  // false for NaN
}

// Twice the triangle's area, along its normal.
glm::dvec3 area_vector(const Mesh& mesh, const std::array<uint32_t, 3>& t) {
  return glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]);
}

void check_texture(const ShellTexture* colours, const std::string& what) {
  if (colours == nullptr) throw DataError(what + ": a shell needs a texture");
  const glm::ivec3 size = colours->size;
  if (size.x < 1 || size.y < 1 || size.z < 1 ||
      colours->texels.size() !=
          static_cast<size_t>(size.x) * static_cast<size_t>(size.y) * static_cast<size_t>(size.z)) {
    throw DataError(fmt::format("{}: a texture of {} x {} x {} with {} texels", what, size.x, size.y, size.z,
                                colours->texels.size()));
  }
  for (size_t i = 0; i < colours->texels.size(); ++i) {
    const glm::vec4& t = colours->texels[i];
    for (int c = 0; c < 4; ++c) {
      if (std::isfinite(t[c]) && t[c] >= 0) continue;
      throw DataError(fmt::format("{}: texel {} holds {}; expected finite numbers from 0 on", what, i, t[c]));
    }
  }
}

void check_thickness(std::vector<double>& thickness, size_t positions, const std::string& what) {
  if (thickness.size() == 1) thickness.assign(positions, thickness.front());
  if (thickness.size() != positions) {
    throw DataError(fmt::format("{}: {} thicknesses for {} positions", what, thickness.size(), positions));
  }
  for (size_t i = 0; i < positions; ++i) {
    if (thickness[i] >= 0 && thickness[i] <= kFar) continue;
    throw DataError(
        fmt::format("{}: position {} has the thickness {}; expected 0 to {:g}", what, i, thickness[i], kFar));
  }
  if (std::all_of(thickness.begin(), thickness.end(), [](double t) { return t == 0; })) {
    throw DataError(what + ": the thickness is 0 everywhere: nothing would be drawn");
  }
}

}  // namespace

void check_mesh(const Mesh& mesh, const std::string& what) {
  if (mesh.triangles.empty()) throw DataError(what + ": the mesh has no triangle");
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size()) {
    throw DataError(fmt::format("{}: {} normals for {} positions", what, mesh.normals.size(), mesh.positions.size()));
  }
  if (!mesh.texture.empty() && mesh.texture.size() != mesh.triangles.size()) {
    throw DataError(
        fmt::format("{}: (u, v) of {} triangles for {} triangles", what, mesh.texture.size(), mesh.triangles.size()));
  }
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::dvec3& p = mesh.positions[i];
    if (usable(p)) continue;
    throw DataError(fmt::format("{}: position {} is ({}, {}, {}); expected finite numbers up to {:g}", what, i, p.x,
                                p.y, p.z, kFar));
  }
  for (size_t i = 0; i < mesh.normals.size(); ++i) {
    const glm::dvec3& n = mesh.normals[i];
    if (usable(n)) continue;
    throw DataError(fmt::format("{}: normal {} is ({}, {}, {})", what, i, n.x, n.y, n.z));
  }
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const uint32_t corner : mesh.triangles[t]) {
      if (corner < mesh.positions.size()) continue;
      throw DataError(fmt::format("{}: triangle {} uses position {} of {}", what, t, corner, mesh.positions.size()));
    }
  }
  for (size_t t = 0; t < mesh.texture.size(); ++t) {
    for (const glm::dvec2& uv : mesh.texture[t]) {
      if (usable({uv, 0})) continue;
      throw DataError(fmt::format("{}: triangle {} has the texture coordinates ({}, {})", what, t, uv.x, uv.y));
    }
  }
}

void complete_normals(Mesh& mesh) {
  mesh.normals.resize(mesh.positions.size(), glm::dvec3(0));
  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
  // Triangles may be 1e-12 or 1e12 wide: areas in units of the mesh neither underflow nor overflow.
  double largest = 0;
  for (const auto& t : mesh.triangles) largest = std::max(largest, glm::length(area_vector(mesh, t)));
  for (const auto& t : mesh.triangles) {
    const glm::dvec3 area = area_vector(mesh, t) / (largest > 0 ? largest : 1);
    for (const uint32_t corner : t) sums[corner] += area;
  }
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    glm::dvec3& normal = mesh.normals[i];
    if (!(glm::length(normal) > 0)) normal = sums[i];
    const double length = glm::length(normal);
    normal = length > 0 ? normal / length : glm::dvec3(0, 0, 1);
  }
}

void project_texture(Mesh& mesh) {
  glm::dvec3 lo(kFar), hi(-kFar);
  for (const glm::dvec3& p : mesh.positions) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  const glm::dvec3 extent = hi - lo;
  const double longest = std::max({extent.x, extent.y, extent.z, 1e-300});
  mesh.texture.clear();
  for (const auto& t : mesh.triangles) {
    const glm::dvec3 normal = glm::abs(area_vector(mesh, t));
    const int along = normal.x >= normal.y && normal.x >= normal.z ? 0 : normal.y >= normal.z ? 1 : 2;
    std::array<glm::dvec2, 3> uv;
    for (size_t i = 0; i < 3; ++i) {
      const glm::dvec3 p = (mesh.positions[t[i]] - lo) / longest;
      uv[i] = {p[(along + 1) % 3], p[(along + 2) % 3]};
    }
    mesh.texture.push_back(uv);
  }
}

Shell make_shell(Mesh mesh, std::vector<double> thickness, const glm::dvec2& repeat,
                 std::shared_ptr<const ShellTexture> colours, const std::string& what) {
  check_mesh(mesh, what);
  check_thickness(thickness, mesh.positions.size(), what);
  check_texture(colours.get(), what);
  if (mesh.texture.empty()) {
    throw DataError(what + ": the mesh has no texture coordinates; \"projection\": \"box\" makes some");
  }
  complete_normals(mesh);
  Shell shell;
  for (const std::array<glm::dvec2, 3>& uv : mesh.texture) {
    std::array<glm::dvec3, 6> corners;
    for (size_t i = 0; i < 6; ++i) corners[i] = {uv[i % 3] * repeat, i < 3 ? 0 : 1};
    shell.texture.push_back(corners);
  }
  shell.mesh = std::make_shared<const Mesh>(std::move(mesh));
  shell.thickness = std::move(thickness);
  shell.colours = std::move(colours);
  return shell;
}

}  // namespace volumark
