#include "scenes/data/read_mesh.h"

#include "scenes/errors.h"
#include "scenes/make_shell.h"

namespace volumark {

Mesh read_mesh(std::span<const std::byte>, const std::string& name) {
  throw DataError(name + ": unknown format of a mesh; expected .obj, .obj.gz, .ply or .ply.gz");
}

}  // namespace volumark
