// Which polygons to draw: the volume's box, cut by near plane and clip planes, in slabs perpendicular to the view. All
// in double precision on the host; every polygon lies on the middle plane of its slab and is given in NDC.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "methods/volume/volume_uniforms.h"

namespace volumark {

// A convex body as its edges, with the depth z (from the reference plane of ViewRays) of each end.
struct BodyEdge {
  glm::dvec3 a, b;  // local coordinates
  double za, zb;    // za <= zb
};
struct Body {
  std::vector<BodyEdge> edges;  // empty: nothing is left
  double z_first = 0, z_last = 0;
};
// The box of `extent` (local coordinates: centred), cut by the near plane and by `planes`.
Body visible_body(const glm::dvec3& extent, const ViewRays& rays, const std::vector<LocalPlane>& planes);

// Slabs [z_first + k step, z_first + (k + 1) step]; the last one reaches the end of the body or past it.
struct Slabs {
  double first = 0, step = 1;
  int count = 0;
  double middle(int k) const { return first + (k + 0.5) * step; }
};
Slabs slabs_of(const Body& body, double step);

// Where the rays that meet the body between depths z0 and z1 leave the picture plane: their convex hull in NDC,
// counter-clockwise, cut to the viewport [-1, 1]^2; fewer than three points where nothing shows. With z0 = z1 it is the
// section of the body. `margin` (NDC) widens the hull: rasterizers move its corners to a grid of sub-pixels, and a
// pixel lost at an edge that the view grazes is a whole side of the body lost.
std::vector<glm::dvec2> hull_of_slab(const Body& body, const ViewRays& rays, double z0, double z1,
                                     const glm::dvec2& margin = glm::dvec2(0));

// One vertex of a slice, as the vertex program reads it.
struct SliceVertex {
  float x, y;  // NDC
  float z;     // depth of the slab's middle plane: fragments meet it with their own rays (put_window_rays)
};

struct SliceMesh {
  std::vector<SliceVertex> vertices;
  std::vector<uint32_t> indices;  // triangles, in drawing order
  int slices = 0;                 // planes between the first and the last of the body
  int polygons = 0;               // those that show
};
// `whole_slabs`: polygons cover every ray that passes the slab; otherwise the section with the middle plane alone.
// `margin` widens them, for programs that find the ends of each ray themselves. `mesh` is overwritten; its memory is
// reused.
void build_slices(const Body& body, const ViewRays& rays, const Slabs& slabs, bool whole_slabs, bool front_to_back,
                  SliceMesh& mesh, const glm::dvec2& margin = glm::dvec2(0));

// Makes ray_origin() and ray_direction() of the programs functions of window coordinates instead of NDC. Places are not
// interpolated across the polygons: a triangle of a fan may be a thousandth of a pixel wide, and the gradients of what
// is interpolated there are rounding noise.
void put_window_rays(VolumeUniforms& uniforms, int width, int height);

}  // namespace volumark
