// PLY, the Stanford triangle format 1.0: ASCII and binary of either byte order. Own code: Debian has no reader of it
// but assimp, which repairs what it reads.
#pragma once

#include <string>
#include <string_view>

#include "scenes/mesh.h"

namespace volumark {

// Reads of the element "vertex" x, y, z, and where they are there nx, ny, nz and (u, v) as u v, s t or texture_u
// texture_v; of the element "face" the list vertex_indices (or vertex_index), polygons as fans around their first
// corner, and where it is there the list texcoord (u, v of each corner). All other elements and properties, lists too,
// are passed over; all types (char .. double, int8 .. float64) are read.
// Throws DataError with file and, in the header and in ASCII, line; in binary parts element and number: a header that
// is not one, a type or format that is unknown, a number that is missing, out of its type's range or no number, an
// index out of range, a face with fewer than three corners, a file that is too short.
Mesh read_ply(std::string_view file, const std::string& name);

}  // namespace volumark
