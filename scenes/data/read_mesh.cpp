#include "scenes/data/read_mesh.h"

#include <fmt/format.h>

#include <limits>

#include "scenes/data/byte_source.h"
#include "scenes/data/obj.h"
#include "scenes/data/ply.h"
#include "scenes/errors.h"
#include "scenes/make_shell.h"

namespace volumark {

Mesh read_mesh(std::span<const std::byte> file, const std::string& name) {
  std::string plain = name;
  const bool gzip = plain.ends_with(".gz");
  if (gzip) plain.resize(plain.size() - 3);
  const bool obj = plain.ends_with(".obj");
  if (!obj && !plain.ends_with(".ply")) {
    throw DataError(name + ": unknown format of a mesh; expected .obj, .obj.gz, .ply or .ply.gz");
  }
  std::vector<std::byte> unpacked;
  if (gzip) {
    unpacked = ByteSource(file, true, name).read_up_to(std::numeric_limits<size_t>::max());
    file = unpacked;
  }
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  Mesh mesh = obj ? read_obj(text, name) : read_ply(text, name);
  check_mesh(mesh, name);
  return mesh;
}

}  // namespace volumark
