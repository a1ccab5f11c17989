// A lit ball with bands that fade with the square of the step, as slices would leave them.
#pragma once

#include "scenes/image.h"

namespace volumark::report_test {

inline constexpr int kSize = 96;

// `step` 0: the exact picture. `seed` changes rounding noise only, `view` the ball's place.
Image ball(int scene, int view, double step, double strength, int seed);

}  // namespace volumark::report_test
