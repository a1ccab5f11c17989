// Which part of the picture a pixel belongs to, decided by reference and scene alone, so that all methods are judged on
// the same pixels: a mean over a whole picture is diluted by its background. Every pixel has exactly one region.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "methods/reference/reference.h"
#include "reports/results.h"

namespace volumark {

// In this order of precedence:
// Background: the reference's alpha is 0, within its bound, in the 3 x 3 neighbourhood.
// Silhouette: the reference's alpha spans more than 0.1 there (as in parity()).
// Grazing: |n . v| < 0.2, n the normalised gradient of the data (central differences, interpolated) where the ray's
// contribution T (1 - exp(-tau h)) is largest, v the ray's direction; a march in half of the smallest voxel spacing. Of
// an isosurface: at the point that the ray shows. A slice plane has none.
// Interior: the rest, also where the gradient vanishes, and all of it in scenes that show a shell.
enum class Region : uint8_t { Background, Silhouette, Grazing, Interior };
inline constexpr Region kRegions[] = {Region::Silhouette, Region::Grazing, Region::Interior, Region::Background};
const char* to_string(Region region);

inline constexpr double kSilhouetteSpan = 0.1, kGrazingCosine = 0.2;

struct RegionMap {
  int width = 0, height = 0;
  std::vector<Region> pixels;  // width * height, row 0 on top
  // The reference equals the background, within its bound, in every pixel: all metrics are equal there and praise
  // nothing.
  bool shows_nothing = false;
};

// Of the view that `reference` shows. The scene's volume or shell is loaded. `threads`: 0 = all; the map does not
// depend on it.
RegionMap region_map(const Scene& scene, const View& view, const Reference& reference, int threads = 0);

// Errors of `test` against the reference, over the scene's background, in each region that has a pixel. Throws
// MetricError for pictures and maps of unequal size.
std::map<std::string, RegionError> region_errors(const Image& test, const Image& reference, const RegionMap& map,
                                                 const glm::dvec3& background);

}  // namespace volumark
