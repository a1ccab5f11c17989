// NRRD files (http://teem.sourceforge.net/nrrd/format.html): three dimensions; types uint8, uint16, int16, float;
// encodings raw and gzip; attached, or detached with one data file. Spacings, space directions and space origin are
// honoured; anatomical spaces (LPS, LAS, RAS) are turned into RAS. Anything else is a DataError that names the field.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "scenes/volume.h"
#include "scenes/volume_finish.h"

namespace volumark {

// Reads the data file of a detached header, named as in the header.
using ReadBeside = std::function<std::vector<std::byte>(const std::string& name)>;

Volume read_nrrd(std::span<const std::byte> file, const ReadBeside& beside, NonFinite non_finite,
                 const std::string& what);

}  // namespace volumark
