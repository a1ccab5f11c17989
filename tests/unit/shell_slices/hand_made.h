// Small shells for tests, put together by hand.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "scenes/shell.h"

namespace volumark {

// One triangle of side `side` with normals leaning outwards by `lean` and this thickness at its corners.
inline Shell one_prism(double side, const std::array<double, 3>& thickness, double lean = 0) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {side, 0, 0}, {0, side, 0}};
  mesh.normals = {glm::normalize(glm::dvec3(-lean, -lean, 1)), glm::normalize(glm::dvec3(lean, 0, 1)),
                  glm::normalize(glm::dvec3(0, lean, 1))};
  mesh.triangles = {{0, 1, 2}};
  Shell shell;
  shell.mesh = std::make_shared<Mesh>(mesh);
  shell.thickness = {thickness.begin(), thickness.end()};
  shell.texture = {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}}};
  auto colours = std::make_shared<ShellTexture>();
  colours->size = {1, 1, 1};
  colours->texels = {glm::vec4(1)};
  shell.colours = colours;
  return shell;
}

// A closed torus of 2 * around * across triangles with its normals and one repeat of the texture around it.
inline Shell torus_shell(int around, int across, double radius, double tube, double thickness,
                         const glm::vec4& texel = glm::vec4(1)) {
  Mesh mesh;
  Shell shell;
  const double tau = 6.283185307179586;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double a = tau * i / around, b = tau * j / across;
      const glm::dvec3 out(std::cos(a), std::sin(a), 0);
      mesh.normals.push_back(std::cos(b) * out + glm::dvec3(0, 0, std::sin(b)));
      mesh.positions.push_back(radius * out + tube * mesh.normals.back());
    }
  }
  const auto index = [&](int i, int j) { return static_cast<uint32_t>((i % around) * across + j % across); };
  const auto add = [&](const std::array<std::array<int, 2>, 3>& corners) {
    std::array<uint32_t, 3> triangle{};
    std::array<glm::dvec3, 6> texture{};
    for (size_t k = 0; k < 3; ++k) {
      triangle[k] = index(corners[k][0], corners[k][1]);
      const double u = corners[k][0] / static_cast<double>(around), v = corners[k][1] / static_cast<double>(across);
      texture[k] = {u, v, 0};
      texture[k + 3] = {u, v, 1};
    }
    mesh.triangles.push_back(triangle);
    shell.texture.push_back(texture);
  };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      add({{{i, j}, {i + 1, j}, {i + 1, j + 1}}});
      add({{{i, j}, {i + 1, j + 1}, {i, j + 1}}});
    }
  }
  shell.thickness.assign(mesh.positions.size(), thickness);
  shell.mesh = std::make_shared<Mesh>(mesh);
  auto colours = std::make_shared<ShellTexture>();
  colours->size = {1, 1, 1};
  colours->texels = {texel};
  shell.colours = colours;
  return shell;
}

}  // namespace volumark
