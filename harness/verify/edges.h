// Edges of pictures under a moving camera. Isosurfaces, slice planes and the slices of shells end abruptly: the picture
// jumps at silhouettes, and a method's own picture also where its samples begin to miss a thin part. A pixel that such
// an edge passes changes sides however small the motion; a crack, a hole or a flicker does not: it comes and goes.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "scenes/scene.h"

namespace volumark {

using PixelValue = std::array<float, 4>;

// Places on the line of a motion, in small motions, in order: 0 is the picture as it was. Those of less than four are
// within what rounding may move a sample (kPlaceNoise in sensitivity.cpp), so that which side they show is open.
inline constexpr double kEdgePlaces[] = {-16, -8, -4, -1, 0, 1, 4, 8, 16};
inline constexpr double kEdgeOpen = 4;

// Whether the values of one pixel at kEdgePlaces are those of an edge that passes it: the first and the last one
// differ, all others are one of the two to within a tenth of their difference, and outside of the open part those of
// the first side all come before those of the other.
bool is_passing_edge(std::span<const PixelValue> values);

// Whether the picture of this scene jumps at edges at all.
inline bool has_edges(const Scene& scene) { return scene.display != Display::Direct; }

// Edges pass in proportion too: of `large` pixels that jump under a motion a hundred times as large a hundredth may,
// and 20 times that; 4 by chance. A picture that jumps as a whole is no edge.
size_t edges_allowed(size_t large);

}  // namespace volumark
