// Which prisms of a shell no map can be trusted in: whoever draws the shell leaves them out, all the same ones.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scenes/shell.h"

namespace volumark {

// The sign of the Jacobian of X(b, w) = sum_i b_i (lower_i + w (upper_i - lower_i)), if it keeps it over the prism: +1
// or -1; 0 where it changes its sign or cannot be told from 0 by double arithmetic.
//
// The Jacobian is sum_i b_i N(w) . d_i with d_i = upper_i - lower_i and N the normal (not unit) of the triangle at
// height w. It keeps its sign if the three quadratics N(w) . d_i keep theirs over [0, 1], and all the same. Corners
// without thickness (d_i = 0) add nothing; there the Jacobian is 0 at the corner itself, which is allowed, unless no
// corner has any thickness.
int jacobian_sign(const std::array<glm::dvec3, 3>& lower, const std::array<glm::dvec3, 3>& upper);

enum class PrismFault : uint8_t {
  None,
  Degenerate,        // without volume, or not to be told from it
  SelfIntersecting,  // the Jacobian changes its sign
};

// Of each prism. It is judged on its corners relative to the middle of the shell's bounds, rounded to float: as methods
// draw it.
std::vector<PrismFault> prism_faults(const Shell& shell);

}  // namespace volumark
