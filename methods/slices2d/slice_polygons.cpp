#include "methods/slices2d/slice_polygons.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "backends/defects.h"

namespace volumark {
namespace {

// The eye's place in the stack (box coordinate), beyond one of its ends in orthographic views: slices above it are
// drawn downwards, slices below it upwards.
double eye_in_stack(const ViewRays& rays, const glm::dvec3& extent) {
  if (rays.perspective && !defect(Defect::EyeForgotten)) return rays.eye.z / extent.z + 0.5;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  return rays.forward.z > 0 ? -kFar : kFar;
}

// The edges of the box between two planes across the stack, as far as they lie in front of the near plane.
Body slab_body(const glm::dvec3& extent, const ViewRays& rays, double low, double high) {
  Body body;
  const auto corner = [&](int i) {
    return glm::dvec3((i & 1) != 0 ? 0.5 : -0.5, (i & 2) != 0 ? 0.5 : -0.5, ((i & 4) != 0 ? high : low) - 0.5) * extent;
  };
  glm::dvec3 corners[8];
  double depths[8];
  bool all_seen = true;
  for (int i = 0; i < 8; ++i) {
    corners[i] = corner(i);
    depths[i] = glm::dot(corners[i] - rays.origin, rays.forward);
    all_seen = all_seen && depths[i] >= rays.z_near;
  }
  const auto add = [&](int i, int j) {
    if (depths[i] > depths[j]) std::swap(i, j);
    BodyEdge edge{corners[i], corners[j], depths[i], depths[j]};
    if (edge.zb < rays.z_near) return;
    if (edge.za < rays.z_near) {
      edge.a = glm::mix(edge.a, edge.b, (rays.z_near - edge.za) / (edge.zb - edge.za));
      edge.za = rays.z_near;
    }
    body.edges.push_back(edge);
  };
  // The edges across the stack hold all eight corners; the others matter where the near plane cuts them.
  for (int i = 0; i < 4; ++i) add(i, i + 4);
  if (all_seen) return body;
  for (const int base : {0, 4}) {
    add(base, base + 1);
    add(base, base + 2);
    add(base + 1, base + 3);
    add(base + 2, base + 3);
  }
  return body;
}

// The first page that holds the stored slices up to half of one past the slice; the next page begins early enough for
// those before it.
int page_of(const Slices& slices, const StackLayout& layout, int slice) {
  const double last = std::ceil(slices.stored_at(slice) + 0.5 - 1e-9);
  int page = 0;
  while (page + 1 < static_cast<int>(layout.pages.size()) && layout.pages[static_cast<size_t>(page)].last < last)
    ++page;
  return page;
}

}  // namespace

Slices slices_of(int stored, int64_t percent) {
  Slices slices;
  slices.stored = stored;
  const double share = static_cast<double>(percent) / 100;
  const int intervals = static_cast<int>(std::lround((stored - 1) * share));
  if (stored > 1 && intervals > 0) {
    slices.count = intervals + 1;
    slices.distance = 1. / intervals;
    return slices;
  }
  slices.count = stored > 1 ? 1 : std::max(1, static_cast<int>(std::lround(share)));
  slices.distance = 1. / slices.count;
  slices.first = 0.5 * slices.distance;
  return slices;
}

std::vector<SliceGroup> slice_groups(const Slices& slices, const StackLayout& layout, const ViewRays& rays,
                                     const glm::dvec3& extent, int textures) {
  const double eye = eye_in_stack(rays, extent);
  std::vector<SliceGroup> groups;
  const auto add = [&](int slice, int direction) {
    const int page = page_of(slices, layout, slice);
    if (!groups.empty()) {
      SliceGroup& open = groups.back();
      if (open.direction == direction && open.page == page && open.count < textures &&
          open.first + open.direction * open.count == slice) {
        ++open.count;
        return;
      }
    }
    groups.push_back({slice, direction, 1, page});
  };
  int below = 0;  // slices whose slab begins below the eye: drawn upwards, the one that holds the eye last
  while (below < slices.count && slices.position(below - 0.5) < eye) ++below;
  for (int k = slices.count - 1; k >= below; --k) add(k, -1);
  for (int k = 0; k < below; ++k) add(k, 1);
  return groups;
}

void build_groups(const Slices& slices, const std::vector<SliceGroup>& groups, const ViewRays& rays,
                  const glm::dvec3& extent, bool extended, const glm::dvec2& margin, SliceGroupMesh& mesh) {
  mesh.vertices.clear();
  mesh.indices.clear();
  mesh.runs.clear();
  mesh.polygons = 0;
  constexpr double kAll = std::numeric_limits<double>::infinity();
  for (const SliceGroup& group : groups) {
    const int last = extended ? group.first + group.direction * (group.count - 1) : group.first;
    const double far = slices.position(group.first - 0.5 * group.direction);
    const double near = slices.position(last + 0.5 * group.direction);
    const Body body = slab_body(extent, rays, std::max(std::min(far, near), 0.), std::min(std::max(far, near), 1.));
    const std::vector<glm::dvec2> hull = hull_of_slab(body, rays, -kAll, kAll, margin);
    if (hull.size() < 3) continue;
    const auto base = static_cast<uint32_t>(mesh.vertices.size());
    for (const glm::dvec2& p : hull) {
      mesh.vertices.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(group.first),
                               static_cast<float>(group.count * group.direction)});
    }
    const auto first_index = static_cast<uint32_t>(mesh.indices.size());
    for (uint32_t corner = 2; corner < hull.size(); ++corner)
      mesh.indices.insert(mesh.indices.end(), {base, base + corner - 1, base + corner});
    if (mesh.runs.empty() || mesh.runs.back().page != group.page) mesh.runs.push_back({group.page, first_index, 0});
    mesh.runs.back().index_count += static_cast<uint32_t>(mesh.indices.size()) - first_index;
    ++mesh.polygons;
  }
}

}  // namespace volumark
