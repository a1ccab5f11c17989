#include "methods/slices2d/plane_section.h"

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace volumark {
namespace {

using Polygon = std::vector<glm::dvec3>;

// Keeps dot(normal, p) >= distance; `slack`: what counts as on the plane.
void cut(Polygon& polygon, const LocalPlane& plane, double slack) {
  Polygon kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3& a = polygon[i];
    const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
    const double da = glm::dot(plane.normal, a) - plane.distance, db = glm::dot(plane.normal, b) - plane.distance;
    const bool a_in = da >= -slack, b_in = db >= -slack;
    if (a_in) kept.push_back(a);
    if (a_in != b_in && da != db) kept.push_back(glm::mix(a, b, glm::clamp(da / (da - db), 0., 1.)));
  }
  polygon.swap(kept);
}

// A square on the plane that holds its whole section with the box.
Polygon square_on(const LocalPlane& plane, double diagonal) {
  const glm::dvec3 n = plane.normal, size = glm::abs(n);
  const glm::dvec3 least = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                           : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                : glm::dvec3(0, 0, 1);
  const glm::dvec3 u = glm::normalize(glm::cross(n, least)) * diagonal, v = glm::cross(n, u),
                   middle = n * plane.distance;
  return {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
}

bool seen_from_its_edge(const ViewRays& rays, const LocalPlane& plane, double diagonal) {
  if (rays.perspective) return std::abs(glm::dot(plane.normal, rays.eye) - plane.distance) < 1e-9 * diagonal;
  return std::abs(glm::dot(plane.normal, rays.forward)) < 1e-9;
}

// The four sides of the view's frame.
std::vector<LocalPlane> frame_sides(const ViewRays& rays) {
  std::vector<LocalPlane> sides;
  for (const glm::dvec3& axis :
       rays.perspective ? std::array{rays.direction_x, rays.direction_y} : std::array{rays.origin_x, rays.origin_y}) {
    // NDC of p along the axis: dot(p - eye, unit) / depth, or dot(p - origin, unit).
    const glm::dvec3 unit = axis / glm::dot(axis, axis);
    for (const double sign : {-1., 1.}) {
      if (rays.perspective) {
        const glm::dvec3 normal = rays.forward - sign * unit;
        sides.push_back({normal, glm::dot(normal, rays.eye)});
      } else {
        sides.push_back({-sign * unit, -1 - sign * glm::dot(unit, rays.origin)});
      }
    }
  }
  return sides;
}

}  // namespace

std::vector<glm::dvec3> visible_section(const glm::dvec3& extent, const ViewRays& rays, const LocalPlane& plane) {
  const double diagonal = glm::length(extent);
  if (std::abs(plane.distance) > diagonal || seen_from_its_edge(rays, plane, diagonal)) return {};
  Polygon polygon = square_on(plane, diagonal);
  // The plane may lie on a face, up to the rounding of its place.
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1., 1.}) {
      glm::dvec3 normal(0);
      normal[axis] = sign;
      cut(polygon, {normal, -0.5 * extent[axis]}, 1e-12 * diagonal);
    }
  }
  cut(polygon, {rays.forward, glm::dot(rays.forward, rays.origin) + rays.z_near}, 0);
  for (const LocalPlane& side : frame_sides(rays)) cut(polygon, side, 0);
  return polygon;
}

glm::dvec3 clip_place(const ViewRays& rays, const glm::dvec3& p) {
  const glm::dvec3 &x = rays.perspective ? rays.direction_x : rays.origin_x,
                   &y = rays.perspective ? rays.direction_y : rays.origin_y,
                   q = p - (rays.perspective ? rays.eye : rays.origin);
  return {glm::dot(q, x) / glm::dot(x, x), glm::dot(q, y) / glm::dot(y, y),
          rays.perspective ? glm::dot(q, rays.forward) : 1};
}

}  // namespace volumark
