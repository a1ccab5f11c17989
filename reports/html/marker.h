// How a series is told from the others without colour: its backend by the marker's shape, its method by the line's
// dash and the marker's filling.
#pragma once

#include <string>

#include "reports/html/model.h"

namespace volumark::html {

std::string series_classes(const Row& row);  // CSS classes: "c0 d1"
std::string marker(const Row& row);          // SVG, about 10 pixels, centred at the origin

}  // namespace volumark::html
