// Images as files. The suffix decides: .pfm (raw float RGB, always there), .exr (linear float RGBA) and .png (8-bit
// sRGB over a background), the last two through the OpenImageIO module, which is loaded when first needed: it costs 0.2
// s and 260 shared libraries, and a slim build goes without it.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <stdexcept>
#include <string>

#include "scenes/image.h"

namespace volumark {

class ImageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Whether .exr and .png can be read and written here; `why` says what is missing.
bool has_image_module(std::string* why = nullptr);

// Throws ImageError: unknown suffix (with the known ones), missing module, unwritable file. Written to a temporary
// file, then renamed. PFM keeps RGB over the background only, and so does PNG; EXR keeps premultiplied RGBA. `note`:
// what the file says of itself (PNG: Description, EXR: comments; PFM has no place for it).
void write_image(const std::filesystem::path& file, const Image& image, const glm::dvec3& background,
                 const std::string& note = "");

// PNG comes back linear and opaque; PFM opaque.
Image read_image(const std::filesystem::path& file);

// sha256 of the pixels' bytes and the size.
std::string pixel_hash(const Image& image);

}  // namespace volumark
