// What the synthetic run says beside its cells: attribution, pairs, effects, hard cases, motion of the camera. One of
// everything, and the odd ones: failures, cases that do not apply, numbers that are not finite, empty lists.
#pragma once

#include <filesystem>

#include "reports/results.h"

namespace volumark::report_test {

// To a run that has its cells; pictures go below `folder`.
void add_sections(Results& results, const std::filesystem::path& folder);

}  // namespace volumark::report_test
