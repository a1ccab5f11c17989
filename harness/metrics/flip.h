// LDR-FLIP: a difference evaluator for alternating images. Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem,
// Fairchild 2020 (Proc. ACM CGIT 3(2)).
#pragma once

#include <array>

#include "harness/metrics/convolve.h"

namespace volumark {

// Linear RGB planes in [0, 1]; width * height values in [0, 1].
Plane flip(const std::array<Plane, 3>& test, const std::array<Plane, 3>& reference, int width, int height);

}  // namespace volumark
