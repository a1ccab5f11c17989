// Where the slices of an object-aligned stack lie, in which order they are drawn and which of them share a polygon.
// Pure host code in the stack's frame: box coordinates turned so that z runs across the slices (stacks.h).
#pragma once

#include <vector>

#include "methods/slices2d/stacks.h"
#include "methods/texture3d_slices/slice_geometry.h"

namespace volumark {

// Slices at z = first + k distance, each in the middle of its slab of one distance; the slabs fill the box (those at
// its faces reach half a slab out of it). At 100 % the slices are the stored ones; between two stored slices fall
// percent / 100 of them. A volume of one slice has percent / 100 slices inside its one layer.
struct Slices {
  int count = 0;
  int stored = 0;
  double first = 0, distance = 1;  // box coordinates

  double position(double k) const { return first + k * distance; }
  // Slice k among the stored ones: 2.5 lies half way between the third and the fourth.
  double stored_at(double k) const { return position(k) * (stored - 1); }
};
Slices slices_of(int stored, int64_t percent);

// Slices that one polygon carries: `first`, first + direction, ... The polygon lies where the first one is, the one
// that is farthest from the eye.
struct SliceGroup {
  int first = 0, direction = 1, count = 1, page = 0;
};

// All slices once, in groups of up to `textures`, each from one page. Back to front for every ray of the view: from
// both ends of the stack towards the eye, where the eye's plane lies within it. No ray meets slices of both sides but
// the one that holds the eye, which comes last. `textures` >= 1.
std::vector<SliceGroup> slice_groups(const Slices& slices, const StackLayout& layout, const ViewRays& rays,
                                     const glm::dvec3& extent, int textures);

// One corner of a polygon, as the vertex program reads it.
struct PolygonVertex {
  float x, y;             // NDC
  float first, textures;  // SliceGroup: first; count * direction
};

// The polygons of consecutive groups from one page.
struct SliceRun {
  int page = 0;
  uint32_t first_index = 0, index_count = 0;
};

struct SliceGroupMesh {
  std::vector<PolygonVertex> vertices;
  std::vector<uint32_t> indices;  // triangles, in drawing order
  std::vector<SliceRun> runs;
  int polygons = 0;
};

// A polygon covers every ray that meets the slabs of its group inside the box and in front of the near plane; with
// `extended` false only those that meet the slab of its first slice (textures that are not corrected have no more to
// show). `rays` and `extent` in the stack's frame; `margin` as in hull_of_slab. `mesh` is overwritten.
void build_groups(const Slices& slices, const std::vector<SliceGroup>& groups, const ViewRays& rays,
                  const glm::dvec3& extent, bool extended, const glm::dvec2& margin, SliceGroupMesh& mesh);

}  // namespace volumark
