// How long references will take, before they are made: so that a scene that is too large is refused with a word, and
// not found out after a night.
#pragma once

#include <optional>
#include <string>

#include "harness/experiment.h"
#include "scenes/scene.h"

namespace volumark {

// Seconds that one view takes on two threads, as a rule of thumb: pixels x cells that a ray along a diagonal meets (the
// sum of the volume's three sizes) x 20 ns; the shipped scenes take 5 to 25 ns. 0 without data.
double expected_reference_seconds(const Scene& scene, int width, int height);

// Why the references of so many views are not made: they would take more than the experiment allows
// (Experiment::reference_budget). Says what to do instead.
std::optional<std::string> too_costly(const Scene& scene, const Experiment& experiment, int width, int height,
                                      size_t views);

}  // namespace volumark
