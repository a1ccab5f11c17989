#include "scenes/data/raw.h"

#include "scenes/data/byte_source.h"
#include "scenes/data/orientation.h"
#include "scenes/data/tar.h"

namespace volumark {

Volume read_raw(std::span<const std::byte> file, const RawLayout& layout, NonFinite non_finite,
                const std::string& what) {
  Volume volume;
  volume.size = layout.size;
  volume.type = layout.type;
  ByteSource source(file, layout.gzip, what);
  if (!layout.member.empty()) enter_tar_member(source, layout.member, what);
  source.skip(layout.header_bytes);
  volume.voxels = source.read_voxels(layout.size, layout.type, layout.big_endian);
  centre_at_origin(volume);
  if (layout.signed_bytes) from_signed_bytes(volume);
  finish_volume(volume, non_finite, what);
  return volume;
}

}  // namespace volumark
