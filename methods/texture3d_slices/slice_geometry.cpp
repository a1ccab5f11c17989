#include "methods/texture3d_slices/slice_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tuple>

#include "backends/defects.h"

namespace volumark {
namespace {

using Polygon = std::vector<glm::dvec3>;

bool before(const glm::dvec3& a, const glm::dvec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

// The point of edge ab on the plane; the same bits from either end, so that faces that share the edge agree.
glm::dvec3 crossing(glm::dvec3 a, glm::dvec3 b, const LocalPlane& plane) {
  if (before(b, a)) std::swap(a, b);
  const double da = glm::dot(plane.normal, a) - plane.distance, db = glm::dot(plane.normal, b) - plane.distance;
  return glm::mix(a, b, da / (da - db));
}

// What is left of a face; the points of its rim that lie on the plane are added to `rim`.
Polygon cut(const Polygon& polygon, const LocalPlane& plane, Polygon& rim) {
  Polygon kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3& a = polygon[i];
    const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
    const bool a_in = glm::dot(plane.normal, a) >= plane.distance, b_in = glm::dot(plane.normal, b) >= plane.distance;
    if (a_in) kept.push_back(a);
    if (a_in != b_in) {
      kept.push_back(crossing(a, b, plane));
      rim.push_back(kept.back());
    }
  }
  return kept;
}

// The face that a cut opens: its corners, each met once a face that shares it, in order around their middle.
Polygon cap_of(Polygon rim, const glm::dvec3& normal) {
  std::sort(rim.begin(), rim.end(), before);
  rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
  if (rim.size() < 3) return {};
  glm::dvec3 middle(0);
  for (const glm::dvec3& p : rim) middle += p / static_cast<double>(rim.size());
  const glm::dvec3 u = rim.front() - middle, v = glm::cross(normal, u);
  const auto angle = [&](const glm::dvec3& p) { return std::atan2(glm::dot(p - middle, v), glm::dot(p - middle, u)); };
  std::sort(rim.begin(), rim.end(), [&](const glm::dvec3& a, const glm::dvec3& b) { return angle(a) < angle(b); });
  return rim;
}

std::vector<Polygon> faces_of_box(const glm::dvec3& extent) {
  std::vector<Polygon> faces(6);
  constexpr int kCorner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    for (const auto& corner : kCorner) {
      glm::dvec3 p;
      p[axis] = face % 2 == 0 ? -0.5 : 0.5;
      p[(axis + 1) % 3] = 0.5 * corner[0];
      p[(axis + 2) % 3] = 0.5 * corner[1];
      faces[static_cast<size_t>(face)].push_back(p * extent);
    }
  }
  return faces;
}

// Twice the signed area of triangle abc.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Andrew's monotone chain; counter-clockwise, collinear points dropped.
std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2>& points) {
  std::sort(points.begin(), points.end(),
            [](const glm::dvec2& a, const glm::dvec2& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return {};
  std::vector<glm::dvec2> hull(2 * points.size());
  size_t count = 0;
  const auto add = [&](const glm::dvec2& p, size_t least) {
    while (count > least && turn(hull[count - 2], hull[count - 1], p) <= 0) --count;
    hull[count++] = p;
  };
  for (const glm::dvec2& p : points) add(p, 1);
  const size_t lower = count;
  for (size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  hull.resize(count - 1);
  return hull;
}

// Keeps the part where sign * p[axis] <= 1.
std::vector<glm::dvec2> cut_to_viewport(const std::vector<glm::dvec2>& polygon, int axis, double sign) {
  std::vector<glm::dvec2> kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2& a = polygon[i];
    const glm::dvec2& b = polygon[(i + 1) % polygon.size()];
    const double da = 1 - sign * a[axis], db = 1 - sign * b[axis];
    if (da >= 0) kept.push_back(a);
    if ((da >= 0) != (db >= 0)) {
      glm::dvec2 p = glm::mix(a, b, da / (da - db));
      p[axis] = sign;
      kept.push_back(p);
    }
  }
  return kept;
}

glm::dvec2 to_ndc(const ViewRays& rays, const glm::dvec3& p, double z) {
  if (rays.perspective) {
    const glm::dvec3 q = (p - rays.eye) / (rays.reference_depth + z);
    return {glm::dot(q, rays.direction_x) / glm::dot(rays.direction_x, rays.direction_x),
            glm::dot(q, rays.direction_y) / glm::dot(rays.direction_y, rays.direction_y)};
  }
  const glm::dvec3 q = p - rays.origin;
  return {glm::dot(q, rays.origin_x) / glm::dot(rays.origin_x, rays.origin_x),
          glm::dot(q, rays.origin_y) / glm::dot(rays.origin_y, rays.origin_y)};
}

}  // namespace

Body visible_body(const glm::dvec3& extent, const ViewRays& rays, const std::vector<LocalPlane>& planes) {
  const auto depth = [&](const glm::dvec3& p) { return glm::dot(p - rays.origin, rays.forward); };
  std::vector<LocalPlane> cuts = planes;
  cuts.push_back({rays.forward, glm::dot(rays.forward, rays.origin) + rays.z_near});
  // Each cut opens a face of its own: where two cuts meet inside the box, their common edge is on no face of the box.
  std::vector<Polygon> faces = faces_of_box(extent);
  for (const LocalPlane& plane : cuts) {
    Polygon rim;
    for (Polygon& face : faces) face = cut(face, plane, rim);
    faces.push_back(cap_of(std::move(rim), plane.normal));
  }
  std::vector<std::pair<glm::dvec3, glm::dvec3>> ends;
  for (const Polygon& face : faces) {
    for (size_t i = 0; i < face.size(); ++i) {
      const glm::dvec3& a = face[i];
      const glm::dvec3& b = face[(i + 1) % face.size()];
      if (a != b) ends.push_back(before(a, b) ? std::pair(a, b) : std::pair(b, a));
    }
  }
  std::sort(ends.begin(), ends.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? before(a.first, b.first) : before(a.second, b.second);
  });
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  if (defect(Defect::MissingEdge) && !ends.empty()) ends.pop_back();
  Body body;
  for (const auto& [a, b] : ends) {
    const double za = depth(a), zb = depth(b);
    body.edges.push_back(za <= zb ? BodyEdge{a, b, za, zb} : BodyEdge{b, a, zb, za});
  }
  if (body.edges.empty()) return body;
  body.z_first = body.edges.front().za;
  body.z_last = body.edges.front().zb;
  for (const BodyEdge& edge : body.edges) {
    body.z_first = std::min(body.z_first, edge.za);
    body.z_last = std::max(body.z_last, edge.zb);
  }
  return body;
}

Slabs slabs_of(const Body& body, double step) {
  Slabs slabs{body.z_first, step, 0};
  // A last slab thinner than a billionth of a step is rounding.
  if (!body.edges.empty()) slabs.count = static_cast<int>(std::ceil((body.z_last - body.z_first) / step - 1e-9));
  if (defect(Defect::DroppedLastSlab)) slabs.count = std::max(slabs.count - 1, 0);
  return slabs;
}

std::vector<glm::dvec2> hull_of_slab(const Body& body, const ViewRays& rays, double z0, double z1,
                                     const glm::dvec2& margin) {
  std::vector<glm::dvec2> points;
  for (const BodyEdge& edge : body.edges) {
    if (edge.zb < z0 || edge.za > z1) continue;
    const auto at = [&](double z) {
      const double t = edge.zb > edge.za ? (z - edge.za) / (edge.zb - edge.za) : 0;
      return to_ndc(rays, glm::mix(edge.a, edge.b, t), z);
    };
    points.push_back(edge.za >= z0 ? to_ndc(rays, edge.a, edge.za) : at(z0));
    points.push_back(edge.zb <= z1 ? to_ndc(rays, edge.b, edge.zb) : at(z1));
  }
  if (margin.x > 0) {
    const size_t count = points.size();
    for (size_t i = 0; i < count; ++i) {
      const glm::dvec2 p = points[i];
      points[i] = p + margin;
      points.insert(points.end(),
                    {p - margin, p + glm::dvec2(margin.x, -margin.y), p + glm::dvec2(-margin.x, margin.y)});
    }
  }
  std::vector<glm::dvec2> hull = convex_hull(points);
  for (int axis = 0; axis < 2; ++axis) {
    for (const double sign : {-1., 1.}) hull = cut_to_viewport(hull, axis, sign);
  }
  return hull;
}

void build_slices(const Body& body, const ViewRays& rays, const Slabs& slabs, bool whole_slabs, bool front_to_back,
                  SliceMesh& mesh, const glm::dvec2& margin) {
  mesh.vertices.clear();
  mesh.indices.clear();
  mesh.slices = slabs.count;
  mesh.polygons = 0;
  for (int i = 0; i < slabs.count; ++i) {
    if (defect(Defect::LostSlice) && i == slabs.count / 2) continue;
    const int turn = defect(Defect::SwappedSlices) && (i ^ 1) < slabs.count ? i ^ 1 : i;
    const bool forwards = front_to_back && !defect(Defect::OrderIgnored);
    const double middle = slabs.middle(forwards ? turn : slabs.count - 1 - turn);
    const double reach = whole_slabs ? 0.5 * slabs.step : 0;
    const std::vector<glm::dvec2> hull = hull_of_slab(body, rays, middle - reach, middle + reach, margin);
    if (hull.size() < 3) continue;
    const auto base = static_cast<uint32_t>(mesh.vertices.size());
    for (const glm::dvec2& p : hull)
      mesh.vertices.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(middle)});
    for (uint32_t corner = 2; corner < hull.size(); ++corner) {
      mesh.indices.insert(mesh.indices.end(), {base, base + corner - 1, base + corner});
    }
    ++mesh.polygons;
  }
}

void put_window_rays(VolumeUniforms& uniforms, int width, int height) {
  // NDC x = 2 X / width - 1, y = 1 - 2 Y / height.
  const auto put = [&](Float4& base, Float4& along_x, Float4& along_y) {
    for (size_t i = 0; i < 3; ++i) {
      const double x = static_cast<double>(along_x[i]), y = static_cast<double>(along_y[i]);
      base[i] = static_cast<float>(static_cast<double>(base[i]) - x + y);
      along_x[i] = static_cast<float>(2 * x / width);
      along_y[i] = static_cast<float>(-2 * y / height);
    }
  };
  put(uniforms.ray_origin, uniforms.ray_origin_x, uniforms.ray_origin_y);
  put(uniforms.ray_direction, uniforms.ray_direction_x, uniforms.ray_direction_y);
}

}  // namespace volumark
