// How a picture follows the camera: small motions must change it in proportion to large ones. A pixel that does not is
// a crack, a pop or a flipped branch.
#pragma once

#include <vector>

#include "harness/verify/case_run.h"

namespace volumark {

// Motions, in sizes (diagonals) of the scene; the larger one says how much the picture may change.
inline constexpr double kSmallMotion = 1e-6, kLargeMotion = 1e-4;
inline constexpr int kDirections = 16;

// Of two sets of pictures: `base`, and for each direction the picture after the small and after the large motion. A
// pixel's change is that of its largest channel; per motion, in sizes of the scene, it is the larger of the two after
// what rounding alone may change was taken off. A spike is a pixel whose change under the small motion, per motion and
// without that noise, exceeds 20 times the largest one under the large motion within a pixel of it. Fills all but the
// key; `worst`: the largest such change over its limit (> 1: a spike). The row's limit is that of the worst pixel, or
// of the liveliest one where no pixel leaves the noise.
struct SensitivityFrames {
  Image base;
  std::vector<Image> small_motion, large_motion;
};
// `edges`, by pixel: those that an edge passes (edges.h), which are left out; empty: none.
SensitivityRow judge_sensitivity(const SensitivityFrames& frames, int64_t view, double& worst,
                                 const std::vector<bool>& edges = {});

// Every shipped scene by the case's method on its backend: a row of the case and a row of sensitivity each.
void run_sensitivity(CaseRun& run, std::vector<SensitivityRow>& rows, std::vector<SceneResultInfo>& scenes);

}  // namespace volumark
