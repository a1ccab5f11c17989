#include "scenes/shell.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "helpers.h"
#include "scenes/errors.h"
#include "scenes/make_shell.h"
#include "scenes/noise.h"
#include "scenes/procedural_meshes.h"
#include "scenes/scene.h"

namespace volumark {
namespace {

using testing::HasSubstr;

ShellTexture random_texture(const glm::ivec3& size) {
  ShellTexture texture;
  texture.size = size;
  uint64_t state = 5;
  for (int i = 0; i < size.x * size.y * size.z; ++i) {
    glm::vec4 texel;
    for (int c = 0; c < 4; ++c) texel[c] = static_cast<float>(next_unit(state));
    texture.texels.push_back(texel);
  }
  return texture;
}

std::shared_ptr<const ShellTexture> any_texture() {
  return std::make_shared<const ShellTexture>(random_texture({2, 2, 2}));
}

// One triangle in the plane y = 0, seen from above.
Mesh triangle() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 2}, {1, 0, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.texture = {{glm::dvec2(0, 0), glm::dvec2(0, 1), glm::dvec2(1, 0)}};
  return mesh;
}

std::string refusal(const Mesh& mesh, const std::vector<double>& thickness = {0.1},
                    std::shared_ptr<const ShellTexture> colours = any_texture()) {
  return test::message_of<DataError>([&] { make_shell(mesh, thickness, {1, 1}, colours, "m.obj"); });
}

TEST(ShellTexture, IsItsTexelsAtTheirCentres) {
  const ShellTexture t = random_texture({3, 4, 5});
  for (int k = 0; k < 5; ++k) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 3; ++i) {
        const glm::dvec3 centre = (glm::dvec3(i, j, k) + 0.5) / glm::dvec3(3, 4, 5);
        EXPECT_NEAR(glm::length(t.at(centre) - glm::dvec4(t.texel(i, j, k))), 0, 1e-14);
      }
    }
  }
}

TEST(ShellTexture, RepeatsAlongUAndVAndEndsAlongW) {
  const ShellTexture t = random_texture({3, 4, 5});
  const glm::dvec3 p(0.93, 0.02, 0.4);
  EXPECT_NEAR(glm::length(t.at(p) - t.at(p + glm::dvec3(7, -3, 0))), 0, 1e-13);
  EXPECT_NEAR(glm::length(t.at(p) - t.at(p + glm::dvec3(1e6, 0, 0))), 0, 1e-8);
  // Between the last texel and the first.
  const glm::dvec4 seam = 0.5 * (glm::dvec4(t.texel(2, 0, 0)) + glm::dvec4(t.texel(0, 0, 0)));
  EXPECT_NEAR(glm::length(t.at({1, 0.125, 0.1}) - seam), 0, 1e-14);
  EXPECT_NEAR(glm::length(t.at({0, 0.125, 0.1}) - seam), 0, 1e-14);
  EXPECT_NEAR(glm::length(t.at({p.x, p.y, 0}) - t.at({p.x, p.y, 0.1})), 0, 1e-14);
  EXPECT_NEAR(glm::length(t.at({p.x, p.y, 7}) - t.at({p.x, p.y, 0.9})), 0, 1e-14);
}

TEST(ShellTexture, OneTexelIsTheSameEverywhere) {
  const ShellTexture t = random_texture({1, 1, 1});
  EXPECT_NEAR(glm::length(t.at({0.3, 0.9, 0.1}) - glm::dvec4(t.texels[0])), 0, 1e-15);
  EXPECT_EQ(t.gradient({0.3, 0.9, 0.1}), glm::dvec3(0));
}

TEST(ShellTexture, GradientIsTheCentralDifferenceOfTexels) {
  const ShellTexture t = random_texture({4, 5, 6});
  const glm::dvec3 n(t.size);
  for (const glm::ivec3& at : {glm::ivec3(0, 0, 3), glm::ivec3(3, 4, 2), glm::ivec3(1, 2, 0), glm::ivec3(2, 0, 5)}) {
    const glm::dvec3 centre = (glm::dvec3(at) + 0.5) / n;
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 step(0);
      step[axis] = 1 / n[axis];
      const double difference = (t.at(centre + step).a - t.at(centre - step).a) * n[axis] / 2;
      EXPECT_NEAR(t.gradient(centre)[axis], difference, 1e-12) << axis;
    }
  }
  // Half way between two texels: the mean of theirs.
  const glm::dvec3 between = glm::dvec3(1, 0.5, 0.5) / n;
  EXPECT_NEAR(glm::length(t.gradient(between) - 0.5 * (t.texel_gradient(0, 0, 0) + t.texel_gradient(1, 0, 0))), 0,
              1e-12);
}

TEST(Shell, OffsetsAndCorners) {
  const Shell shell = make_shell(triangle(), {0.1, 0.2, 0.3}, {4, 2}, any_texture(), "m.obj");
  EXPECT_EQ(shell.offset(2), glm::dvec3(0, 0.3, 0));
  EXPECT_EQ(shell.corner(0, 1), glm::dvec3(0, 0, 2));
  EXPECT_EQ(shell.corner(0, 4), glm::dvec3(0, 0.2, 2));
  EXPECT_EQ(shell.texture[0][4], glm::dvec3(0, 2, 1));
  EXPECT_EQ(shell.texture[0][2], glm::dvec3(4, 0, 0));
  EXPECT_EQ(bounds_of(shell).hi, glm::dvec3(1, 0.3, 2));
}

// Along a small step from a corner the texture coordinates change as the cotangents say.
TEST(Shell, CotangentsInvertTheMapOfAPrism) {
  Mesh mesh = triangle();
  mesh.normals = {{0.3, 1, 0.1}, {-0.2, 1, 0.4}, {0.1, 1, -0.3}};
  const Shell shell = make_shell(mesh, {0.5, 0.2, 0.8}, {3, 5}, any_texture(), "m.obj");
  const auto position = [&](double b1, double b2, double w) {
    glm::dvec3 x(0), t(0);
    const double b[3] = {1 - b1 - b2, b1, b2};
    for (int i = 0; i < 3; ++i) {
      x += b[i] * ((1 - w) * shell.corner(0, i) + w * shell.corner(0, i + 3));
      t += b[i] *
           ((1 - w) * shell.texture[0][static_cast<size_t>(i)] + w * shell.texture[0][static_cast<size_t>(i + 3)]);
    }
    return std::pair(x, t);
  };
  const auto all = cotangents(shell);
  for (int corner = 0; corner < 6; ++corner) {
    const double b1 = corner % 3 == 1 ? 1 : 0, b2 = corner % 3 == 2 ? 1 : 0, w = corner / 3;
    for (const glm::dvec3& step : {glm::dvec3(1e-6, 0, 0), glm::dvec3(0, 1e-6, 0), glm::dvec3(0, 0, 1e-6)}) {
      const auto ahead = position(b1 + step.x, b2 + step.y, w + step.z);
      const auto behind = position(b1 - step.x, b2 - step.y, w - step.z);
      const glm::dvec3 moved = ahead.first - behind.first, change = ahead.second - behind.second;
      EXPECT_NEAR(glm::length(glm::transpose(all[0][static_cast<size_t>(corner)]) * moved - change), 0, 1e-9) << corner;
    }
  }
}

TEST(Shell, CotangentsOfAFlatStrip) {
  const Shell shell =
      make_shell(make_mesh(StripMesh{{4, 3}, {2, 6}, 0}), {0.25}, {8, 3}, any_texture(), "generated mesh");
  for (const auto& prism : cotangents(shell)) {
    for (const glm::dmat3& c : prism) {
      EXPECT_NEAR(glm::length(c[0] - glm::dvec3(4, 0, 0)), 0, 1e-9);
      EXPECT_NEAR(glm::length(c[1] - glm::dvec3(0, 0, 0.5)), 0, 1e-9);
      EXPECT_NEAR(glm::length(c[2] - glm::dvec3(0, 4, 0)), 0, 1e-9);
    }
  }
}

// Around a position all prisms say the same, also across the seams of a torus: no edge shows in the light.
TEST(Shell, CotangentsAreSharedAcrossSeams) {
  const Shell shell = make_shell(make_mesh(TorusMesh{}), {0.2}, {12, 5}, any_texture(), "generated mesh");
  const auto all = cotangents(shell);
  std::map<std::pair<uint32_t, size_t>, glm::dmat3> first;
  double largest = 0;
  for (size_t prism = 0; prism < shell.prisms(); ++prism) {
    for (size_t i = 0; i < 6; ++i) {
      const auto key = std::pair(shell.mesh->triangles[prism][i % 3], i / 3);
      const auto [it, inserted] = first.emplace(key, all[prism][i]);
      for (int column = 0; column < 3; ++column) {
        largest = std::max(largest, glm::length(it->second[column] - all[prism][i][column]));
      }
      // Upwards is out of the mesh.
      EXPECT_GT(glm::dot(all[prism][i][2], shell.mesh->normals[key.first]), 0);
    }
  }
  EXPECT_EQ(largest, 0);
  EXPECT_EQ(first.size(), 2 * 288u);
}

TEST(Shell, CotangentsOfSingularCornersVanish) {
  const Shell shell = make_shell(triangle(), {0, 0.2, 0.3}, {1, 1}, any_texture(), "m.obj");
  const auto all = cotangents(shell);
  EXPECT_EQ(all[0][0], glm::dmat3(0));
  EXPECT_NE(all[0][1], glm::dmat3(0));
}

// The mesh's triangle has no area, that of its offset corners has one (found by the fuzzer: 0 / 0).
TEST(Shell, CotangentsWhereOnlyTheUpperTriangleHasAnArea) {
  Mesh mesh = triangle();
  mesh.positions[2] = mesh.positions[1];
  mesh.normals = {{0, 1, 0}, {-0.5, 1, 0}, {0.5, 1, 0}};
  for (const glm::dmat3& c : cotangents(make_shell(mesh, {1}, {1, 1}, any_texture(), "m.obj"))[0]) {
    EXPECT_TRUE(std::isfinite(c[0].x + c[1].y + c[2].z));
  }
}

TEST(Shell, GradientFloorScalesWithTheShell) {
  const auto texture = any_texture();
  const Shell thin = make_shell(triangle(), {0.1, 0.05, 0.1}, {1, 1}, texture, "m.obj");
  const double greatest = static_cast<double>(texture->greatest_extinction());
  EXPECT_NEAR(gradient_floor(Lighting{}, thin), greatest * 2 / 64 / 0.1, 1e-12);
}

TEST(MakeShell, MissingNormalsAreAreaWeighted) {
  // Two triangles at right angles share an edge; one is four times as large.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 4, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
  complete_normals(mesh);
  EXPECT_NEAR(glm::length(mesh.normals[2] - glm::dvec3(0, 1, 0)), 0, 1e-15);
  EXPECT_NEAR(glm::length(mesh.normals[0] - glm::normalize(glm::dvec3(4, 1, 0))), 0, 1e-15);
  // Those that are there stay; those of length 0 are replaced.
  mesh.normals[2] = {0, 0, 5};
  mesh.normals[0] = {0, 0, 0};
  complete_normals(mesh);
  EXPECT_EQ(mesh.normals[2], glm::dvec3(0, 0, 1));
  EXPECT_NEAR(glm::length(mesh.normals[0] - glm::normalize(glm::dvec3(4, 1, 0))), 0, 1e-15);
}

TEST(MakeShell, NormalsOfTinyAndHugeMeshes) {
  for (const double scale : {1e-50, 1e-12, 1e11}) {
    Mesh mesh = triangle();
    for (glm::dvec3& p : mesh.positions) p *= scale;
    complete_normals(mesh);
    EXPECT_NEAR(glm::length(mesh.normals[1] - glm::dvec3(0, 1, 0)), 0, 1e-15) << scale;
  }
}

TEST(MakeShell, DegenerateOpenAndNonManifoldMeshesAreAllowed) {
  Mesh mesh = triangle();
  mesh.positions.push_back({0, 5, 0});  // of three triangles at one edge
  mesh.positions.push_back({9, 9, 9});  // in no triangle
  mesh.triangles.push_back({0, 1, 3});
  mesh.triangles.push_back({1, 0, 3});
  mesh.triangles.push_back({0, 0, 1});  // without area
  mesh.texture.resize(4, mesh.texture[0]);
  const Shell shell = make_shell(mesh, {0.1}, {1, 1}, any_texture(), "m.obj");
  EXPECT_EQ(shell.prisms(), 4u);
  EXPECT_EQ(shell.mesh->normals[4], glm::dvec3(0, 0, 1));
  EXPECT_EQ(shell.mesh->normals[3], glm::dvec3(0, 0, 1));  // two that cancel
  for (const auto& prism : cotangents(shell)) {
    for (const glm::dmat3& c : prism) EXPECT_FALSE(std::isnan(glm::determinant(c)));
  }
}

TEST(MakeShell, RefusesBadMeshes) {
  EXPECT_THAT(refusal(Mesh{}), HasSubstr("m.obj: the mesh has no triangle"));
  Mesh mesh = triangle();
  mesh.positions[1].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(mesh), HasSubstr("position 1 is (0, nan, 2)"));
  mesh.positions[1].y = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal(mesh), HasSubstr("position 1 is (0, inf, 2)"));
  mesh = triangle();
  mesh.triangles[0][2] = 3;
  EXPECT_THAT(refusal(mesh), HasSubstr("triangle 0 uses position 3 of 3"));
  mesh = triangle();
  mesh.normals = {{0, 1, 0}};
  EXPECT_THAT(refusal(mesh), HasSubstr("1 normals for 3 positions"));
  mesh.normals.assign(3, glm::dvec3(std::nan("")));
  EXPECT_THAT(refusal(mesh), HasSubstr("normal 0"));
  mesh = triangle();
  mesh.texture.clear();
  EXPECT_THAT(refusal(mesh), HasSubstr("no texture coordinates"));
  mesh = triangle();
  mesh.texture[0][1].x = std::nan("");
  EXPECT_THAT(refusal(mesh), HasSubstr("triangle 0 has the texture coordinates"));
}

TEST(MakeShell, RefusesBadThicknesses) {
  EXPECT_THAT(refusal(triangle(), {0.0}), HasSubstr("0 everywhere"));
  EXPECT_THAT(refusal(triangle(), {0.1, -0.1, 0.1}), HasSubstr("position 1 has the thickness -0.1"));
  EXPECT_THAT(refusal(triangle(), {0.1, 0.1, 1e300}), HasSubstr("position 2"));
  EXPECT_THAT(refusal(triangle(), {std::nan("")}), HasSubstr("nan"));
  EXPECT_THAT(refusal(triangle(), {0.1, 0.1}), HasSubstr("2 thicknesses for 3 positions"));
}

TEST(MakeShell, RefusesBadTextures) {
  EXPECT_THAT(refusal(triangle(), {0.1}, nullptr), HasSubstr("needs a texture"));
  EXPECT_THAT(refusal(triangle(), {0.1}, std::make_shared<const ShellTexture>()), HasSubstr("0 x 0 x 0"));
  ShellTexture texture = random_texture({2, 2, 2});
  texture.texels[3].a = -1;
  EXPECT_THAT(refusal(triangle(), {0.1}, std::make_shared<const ShellTexture>(texture)), HasSubstr("texel 3 holds -1"));
  texture.texels[3].a = std::numeric_limits<float>::infinity();
  EXPECT_THAT(refusal(triangle(), {0.1}, std::make_shared<const ShellTexture>(texture)), HasSubstr("inf"));
}

TEST(MakeShell, BoxProjectionKeepsLengths) {
  Mesh mesh = triangle();
  mesh.texture.clear();
  project_texture(mesh);
  ASSERT_EQ(mesh.texture.size(), 1u);
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3;
    EXPECT_NEAR(glm::length(mesh.texture[0][i] - mesh.texture[0][j]),
                glm::length(mesh.positions[i] - mesh.positions[j]) / 2, 1e-15);
  }
}

}  // namespace
}  // namespace volumark
