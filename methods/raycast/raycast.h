// What a user would pick today: one ray a pixel, sampled front to back in a loop of the fragment program, with empty
// space skipped by bricks. On the cpu backend the twin marches rays on SIMD lanes.
#pragma once

#include "methods/method.h"

namespace volumark {

const Method& raycast();

}  // namespace volumark
