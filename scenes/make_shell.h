// From a mesh as files give it to a shell, with all that scenes/shell.h asks of one.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "scenes/shell.h"

namespace volumark {

// Unit normals for every position: the mesh's own, normalised; where it has none, or one of length 0, the sum of the
// normals of the triangles that meet there, each weighted by its area. Where that vanishes too (a position in no
// triangle, or in triangles without area only) it is (0, 0, 1).
void complete_normals(Mesh& mesh);

// (u, v) for a mesh that has none: each triangle is projected along the axis that its normal is nearest to, and the
// longest side of the mesh's bounds counts as 1. Neighbours that face different axes do not fit: for textures without a
// pattern, such as fur.
void project_texture(Mesh& mesh);

// Refuses (DataError; `what` names the mesh): no triangle, a triangle with a corner that is not there, positions or
// normals that are not finite or beyond 1e12, another number of normals or of texture coordinates than belongs.
// Allowed: open and non-manifold meshes, several components, triangles without area, positions in no triangle.
void check_mesh(const Mesh& mesh, const std::string& what);

// Completes normals; repeats the texture `repeat` times over (u, v) in [0, 1]. `thickness`: world units, one a
// position, or a single one for all. Throws DataError: as check_mesh; a mesh without (u, v); thickness of a wrong
// number, negative, not finite, beyond 1e12 or 0 everywhere; no texture, or one without texels or with texels that are
// negative or not finite.
Shell make_shell(Mesh mesh, std::vector<double> thickness, const glm::dvec2& repeat,
                 std::shared_ptr<const ShellTexture> colours, const std::string& what);

}  // namespace volumark
