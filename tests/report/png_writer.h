// An 8-bit RGB PNG, for pictures of the synthetic run: the tests must not need OpenImageIO.
#pragma once

#include <filesystem>

#include "scenes/image.h"

namespace volumark::report_test {

// Opaque linear RGB, written as sRGB.
void write_png(const std::filesystem::path& file, const Image& image);

}  // namespace volumark::report_test
