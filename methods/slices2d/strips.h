// Polygons of a plane through the volume, cut into strips at the stored slices of a stack (rezksalama2000, section 9,
// Figure 11). A strip lies between two neighbouring stored slices; each of its corners has the weight of the second
// one. Corners are affine in the plane, and so are weights: interpolated over a strip with perspective they are exact.
// Neighbouring strips have the corners on their common edge from one point, bit by bit: no pixel is lost or drawn
// twice. Pure host code in the stack's frame.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "methods/slices2d/slice_polygons.h"
#include "methods/slices2d/stacks.h"

namespace volumark {

// A corner of a polygon before it is cut. Both members are affine in space.
struct PlanePoint {
  glm::dvec3 clip;    // NDC times w, and w
  double stored = 0;  // place among the stored slices: 2.5 lies half way between the third and the fourth
};

// A corner of a strip, as strips.vert reads it.
struct StripVertex {
  float x, y, w;  // PlanePoint::clip
  float depth;    // of the plane, where that is one number
  float first;    // of the two stored slices
  float weight;   // of the second one: 0 on the first, 1 on the second
};

class StripBuilder {
 public:
  enum class Between { TwoSlices, HalfWays };  // HalfWays: a strip is what is nearest to `first`, the weights are 0

  void clear();
  // Cuts a convex polygon and appends its strips. Beyond the first and the last stored slice the outermost strips go
  // on. A strip is drawn with every page that may be needed within `reach` stored slices of it, and with one alone
  // where `reach` is 0.
  void add(std::span<const PlanePoint> polygon, Between between, double depth, const StackLayout& layout, double reach);

  const std::vector<StripVertex>& vertices() const { return vertices_; }
  const std::vector<uint32_t>& indices() const { return indices_; }  // triangles, in drawing order
  const std::vector<SliceRun>& runs() const { return runs_; }
  int polygons() const { return polygons_; }
  int strips() const { return strips_; }

 private:
  struct Strip {
    int first;
    uint32_t base, corners;
  };
  void split(double level);
  void add_strip(int first, std::span<const PlanePoint> corners, bool weighted, double depth);
  void add_page(const StackLayout& layout, int page, int reach);

  std::vector<StripVertex> vertices_;
  std::vector<uint32_t> indices_;
  std::vector<SliceRun> runs_;
  int polygons_ = 0, strips_ = 0;
  std::vector<PlanePoint> rest_, below_, above_;  // while a polygon is cut
  std::vector<Strip> cut_;                        // of the last polygon
};

}  // namespace volumark
