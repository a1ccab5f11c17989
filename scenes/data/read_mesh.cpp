#include "scenes/data/read_mesh.h"

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
    constexpr size_t kMost = size_t{1} << 30;  // a bomb of a few kilobytes can unpack to more than there is memory
    unpacked = ByteSource(file, true, name).read_up_to(kMost + 1);
    if (unpacked.size() > kMost) throw DataError(name + ": unpacks to more than 1 GiB");
    file = unpacked;
  }
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  Mesh mesh = obj ? read_obj(text, name) : read_ply(text, name);
  check_mesh(mesh, name);
  return mesh;
}

}  // namespace volumark
