// Portable float maps (PF: three channels), little or big endian; rows run from the bottom to the top in the file.
#pragma once

#include <string>
#include <string_view>

#include "scenes/image.h"

namespace volumark {

std::string encode_pfm(const Image& image);  // alpha is dropped
// Throws ImageError (image_io.h), with `name` in the message, for anything that is not a whole PF file.
Image decode_pfm(std::string_view text, const std::string& name);

}  // namespace volumark
