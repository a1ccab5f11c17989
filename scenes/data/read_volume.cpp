#include "scenes/data/read_volume.h"

#include <fmt/format.h>

#include <fstream>
#include <system_error>

#include "scenes/data/nifti.h"
#include "scenes/data/nrrd.h"
#include "scenes/data/orientation.h"
#include "scenes/errors.h"

namespace volumark {
namespace {

namespace fs = std::filesystem;

bool ends_with(const std::string& text, std::string_view end) { return text.ends_with(end); }

Volume read_by_format(const FileSpec& spec, std::span<const std::byte> bytes, const fs::path& path) {
  const std::string what = path.string();
  if (spec.raw) return read_raw(bytes, *spec.raw, spec.non_finite, what);
  // By the name in the scene: what was found may be named otherwise (it is recognised by its checksum).
  const std::string& name = spec.file;
  if (ends_with(name, ".nrrd") || ends_with(name, ".nhdr")) {
    const auto beside = [&](const std::string& file) { return read_file_bytes(path.parent_path() / file); };
    return read_nrrd(bytes, beside, spec.non_finite, what);
  }
  if (ends_with(name, ".nii") || ends_with(name, ".nii.gz")) return read_nifti(bytes, spec.non_finite, what);
  throw DataError(
      fmt::format("{}: unknown format; expected .nrrd, .nhdr, .nii, .nii.gz, or \"raw\" in the scene's "
                  "volume with the size and type of the samples",
                  what));
}

}  // namespace

std::vector<std::byte> read_file_bytes(const fs::path& path) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  if (error) throw DataError(fmt::format("{}: cannot be read: {}", path.string(), error.message()));
  std::ifstream in(path, std::ios::binary);
  std::vector<std::byte> bytes(size);
  if (!in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
    throw DataError(fmt::format("{}: cannot be read: {} of {} bytes came", path.string(), in.gcount(), size));
  }
  return bytes;
}

Volume read_volume(const FileSpec& spec, std::span<const std::byte> bytes, const fs::path& path) {
  Volume volume = read_by_format(spec, bytes, path);
  if (spec.spacing) volume.spacing = *spec.spacing;
  if (spec.axes) volume.axes = *spec.axes;
  if (spec.origin) {
    volume.origin = *spec.origin;
  } else if (spec.raw) {
    centre_at_origin(volume);
  }
  return volume;
}

}  // namespace volumark
