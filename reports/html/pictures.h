// The previews of a run, to be embedded: each file once, base64, until the report would grow too large. A picture that
// cannot be had leaves a note that says why.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "reports/html/model.h"

namespace volumark::html {

// One view of one cell that has a picture, or should have.
struct PictureEntry {
  size_t cell = 0, view = 0;                                      // into Results::results and its views
  int rendered = -1, reference = -1, difference = -1, flip = -1;  // into PictureBook::base64; -1: not there
  std::string note;                                               // why something is not there
};

struct PictureBook {
  std::vector<std::string> base64;    // PNG files
  std::vector<PictureEntry> entries;  // by cell, then view
  // Index into Results::hard_cases -> picture and difference (into base64, -1: not there): the worst row of each
  // case that has pictures, and a few more that fail elsewhere.
  std::map<size_t, std::pair<int, int>> hard_cases;
  size_t left_out = 0;  // pictures that the size limit kept out
  size_t missing = 0;   // pictures that could not be read
};

inline constexpr size_t kPictureBudget = size_t{48} << 20;  // bytes of PNG files in one report

// Reads only files below `folder`. Where the budget does not hold all, the finest cell of each row comes first.
PictureBook read_pictures(const Model& model, const std::filesystem::path& folder, size_t budget = kPictureBudget);

std::string to_base64(std::string_view bytes);

}  // namespace volumark::html
