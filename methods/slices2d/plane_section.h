// The part of a plane that is inside a box and seen: where slice_mpr draws. Pure host code.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "methods/volume/volume_uniforms.h"

namespace volumark {

// Corners in order around the plane, local coordinates, each in front of the near plane and in the view's frame;
// fewer than three where nothing shows: the plane misses the box, or is seen from its edge (from nearer than 1e-9 of
// the box's diagonal, or of one in orthographic views). Faces of the box belong to it: a plane on one shows it.
std::vector<glm::dvec3> visible_section(const glm::dvec3& extent, const ViewRays& rays, const LocalPlane& plane);

// NDC of p times w, and w: depth from the eye in perspective, otherwise 1.
glm::dvec3 clip_place(const ViewRays& rays, const glm::dvec3& p);

}  // namespace volumark
