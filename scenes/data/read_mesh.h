// Meshes from files: Wavefront OBJ and PLY, plain or gzip-compressed.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "scenes/mesh.h"

namespace volumark {

// By the name's ending: .obj, .ply, each also with .gz behind. Throws DataError that names the file and the line (or,
// in binary parts, the element); check_mesh (scenes/make_shell.h) has passed.
Mesh read_mesh(std::span<const std::byte> file, const std::string& name);

}  // namespace volumark
