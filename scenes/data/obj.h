// Wavefront OBJ: positions, texture coordinates, normals and faces. Own code: the readers that Debian has
// (tinyobjloader, assimp) read "nan" and missing numbers as 0, leave out faces whose indices do not exist, and name no
// line.
#pragma once

#include <string>
#include <string_view>

#include "scenes/mesh.h"

namespace volumark {

// Reads v (further numbers, as weights or colours, are passed over), vt (u v), vn, and f with corners a, a/b, a//c and
// a/b/c, indices from 1 or, negative, from the last one back; polygons become fans around their first corner; a
// backslash joins lines. Lines of other kinds (groups, materials, curves) are passed over. A position that occurs with
// several normals becomes as many positions. Where any corner lacks a normal, or (u, v), the mesh has none.
// Throws DataError with file and line: a number that is missing or is none (NaN and infinity too), an index out of
// range, a face with fewer than three corners.
Mesh read_obj(std::string_view text, const std::string& name);

}  // namespace volumark
