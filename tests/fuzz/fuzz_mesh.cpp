// Any bytes as a mesh, OBJ or PLY by the first of them: a Mesh of which a shell can be made, or a DataError; nothing
// else may happen.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <span>

#include "scenes/data/read_mesh.h"
#include "scenes/errors.h"
#include "scenes/make_shell.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace volumark;
  if (size == 0) return 0;
  constexpr const char* kNames[] = {"fuzz.obj", "fuzz.ply", "fuzz.obj.gz", "fuzz.ply.gz"};
  try {
    Mesh mesh = read_mesh(std::as_bytes(std::span(data + 1, size - 1)), kNames[data[0] % 4]);
    if (mesh.texture.empty()) project_texture(mesh);
    auto texture = std::make_shared<ShellTexture>();
    texture->size = {1, 1, 1};
    texture->texels = {{1, 1, 1, 1}};
    const Shell shell = make_shell(std::move(mesh), {1}, {1, 1}, texture, "fuzz");
    // What was accepted has finite corners, unit normals, and a light that is a number.
    for (const glm::dvec3& normal : shell.mesh->normals) {
      if (!(std::abs(glm::length(normal) - 1) < 1e-6)) std::abort();
    }
    if (!std::isfinite(glm::length(bounds_of(shell).hi - bounds_of(shell).lo))) std::abort();
    for (const auto& prism : cotangents(shell)) {
      for (const glm::dmat3& c : prism) {
        if (!std::isfinite(c[0].x + c[1].y + c[2].z)) std::abort();
      }
    }
  } catch (const DataError&) {
  }
  return 0;
}
