#include "reports/html/marker.h"

#include <array>

namespace volumark::html {
namespace {

constexpr std::array<const char*, 6> kShapes = {
    "M0,-4.6A4.6,4.6 0 1 1 -.01,-4.6Z",                      // circle
    "M-4.2,-4.2H4.2V4.2H-4.2Z",                              // square
    "M0,-5.6L5.2,3.8H-5.2Z",                                 // triangle
    "M0,-6L6,0L0,6L-6,0Z",                                   // diamond
    "M0,5.6L5.2,-3.8H-5.2Z",                                 // triangle, point down
    "M-1.7,-5H1.7V-1.7H5V1.7H1.7V5H-1.7V1.7H-5V-1.7H-1.7Z",  // plus
};
// Inside the shape, of the third and fourth method.
constexpr std::array<const char*, 4> kFillings = {"", "", "M-1.2,0A1.2,1.2 0 1 1 1.2,0A1.2,1.2 0 1 1 -1.2,0Z",
                                                  "M-3,0H3M0,-3V3"};

}  // namespace

std::string series_classes(const Row& row) {
  return "c" + std::to_string(row.backend_index % kShapes.size()) + " d" +
         std::to_string(row.method_index % kFillings.size());
}

std::string marker(const Row& row) {
  const std::string inside = kFillings[row.method_index % kFillings.size()];
  std::string out = std::string("<path class=\"shape\" d=\"") + kShapes[row.backend_index % kShapes.size()] + "\"/>";
  if (!inside.empty()) out += "<path class=\"inside\" d=\"" + inside + "\"/>";
  return out;
}

}  // namespace volumark::html
