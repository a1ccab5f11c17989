// Structural similarity (Wang et al. 2004): 11 x 11 Gaussian window, sigma 1.5, C1 = 1e-4, C2 = 9e-4 for values in
// [0, 1].
#pragma once

#include "harness/metrics/convolve.h"

namespace volumark {

// SSIM at each window centre; centres nearer than 5 pixels to the border are not valid and hold 1.
Plane ssim_map(const Plane& a, const Plane& b, int width, int height);
inline constexpr int kSsimRadius = 5;

}  // namespace volumark
