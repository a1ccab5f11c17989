// Files within a tar archive (POSIX ustar, and what GNU tar writes beside it: names up to 100 bytes, or 255 with a
// prefix). Only what a scene needs: to read one of them, by name.
#pragma once

#include <string>

#include "scenes/data/byte_source.h"

namespace volumark {

// Reads `source` up to the content of the regular file `member`, which is then all that `source` has left. Throws
// DataError where there is no such file, or no archive; the message names the files that there are.
void enter_tar_member(ByteSource& source, const std::string& member, const std::string& what);

}  // namespace volumark
