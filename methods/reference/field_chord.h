// The interpolated field along a straight line through one cell.
#pragma once

#include <glm/vec3.hpp>

#include "methods/reference/lattice.h"
#include "methods/reference/polynomial.h"

namespace volumark {

// The trilinear field with these corners along start + u * change (cell coordinates), a cubic in u.
Cubic along_chord(const Lattice::Corners& corner, const glm::dvec3& start, const glm::dvec3& change);

}  // namespace volumark
