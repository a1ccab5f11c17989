// Tables of plain text, for a terminal.
#pragma once

#include <string>
#include <vector>

namespace volumark {

using TextRow = std::vector<std::string>;

// The first row is the heading, and has as many cells as every other one. Columns are as wide as their widest cell; the
// first `left` of them are set to the left, the others to the right. Ends with a newline.
std::string text_table(const std::vector<TextRow>& rows, size_t left);

}  // namespace volumark
