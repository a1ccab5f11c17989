// From the affine map of a file to the lattice of a Volume.
#pragma once

#include <glm/mat3x3.hpp>
#include <string>

#include "scenes/volume.h"

namespace volumark {

// Gram-Schmidt, columns in order; keeps the handedness. The columns must be nearly orthonormal.
glm::dmat3 orthonormal(const glm::dmat3& columns);

// Columns of `steps`: from one sample to the next along i, j, k. Sets spacing and axes; DataError where a step is zero
// or not finite, or where they are not at right angles (a sheared lattice cannot be represented).
void set_steps(Volume& volume, const glm::dmat3& steps, const std::string& what);

// Moves the box so that its centre is the world's origin.
void centre_at_origin(Volume& volume);

}  // namespace volumark
