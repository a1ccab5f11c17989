// How far a picture jumps between two views that are next to each other: the change of the error, which is what the eye
// sees of a scheme that turns itself over (a stack of slices that switches) on a camera path that does not.
#pragma once

#include <map>

#include "harness/cell.h"

namespace volumark {

// Two views whose directions part by more (radians, 2 degrees) are no neighbours on a path.
inline constexpr double kNeighbourAngle = 0.0349;

// Sets ViewResult::jump of each view of `result` that comes after a neighbour, in the order of the views: the RMSE,
// over the RGB channels, of (picture - reference) here against (picture - reference) there. The cost of a picture
// alone; views without a picture or a reference, and pictures that are not finite, have none.
void measure_jumps(const SceneContext& context, const std::map<int, Image>& images, Result& result);

}  // namespace volumark
