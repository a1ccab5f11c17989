#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scenes/scene_plan.h"

namespace volumark {
namespace {

struct Axis {
  int index;
  double sign;
};

Axis parse_axis(const JsonNode& node) {
  const std::string name = node.one_of({"x", "y", "z", "-x", "-y", "-z"});
  return {name.back() - 'x', name[0] == '-' ? -1.0 : 1.0};
}

// The keys that both kinds of view share.
View parse_projection(const JsonObject& object) {
  View view;
  view.perspective = object.exactly_one({"fov_y", "half_height"}) == "fov_y";
  if (view.perspective) {
    view.fov_y = glm::radians(object.at("fov_y").number(0.01, 179));
  } else {
    view.half_height = object.at("half_height").number(0, 1e12, true);
  }
  return view;
}

// The near plane: as written, else 1/100 of the distance to the target (perspective) or the eye itself.
double near_of(const JsonObject& object, const View& view) {
  if (!object.has("near")) return view.perspective ? 0.01 * glm::length(view.target - view.eye) : 0;
  if (view.perspective) return object.at("near").number(0, 1e12, true);
  return object.at("near").number(-1e12, 1e12);
}

// Lengths and positions in units of the volume's radius, about its centre -> world.
View scaled(View view, const VolumeFrame& frame) {
  view.eye = frame.centre + view.eye * frame.radius;
  view.target = frame.centre + view.target * frame.radius;
  view.near *= frame.radius;
  view.half_height *= frame.radius;
  return view;
}

// Adds a view whose place is known now, or once the volume is.
void add_view(Scene& scene, ScenePlan& plan, View view, bool relative) {
  if (relative) {
    plan.placements.push_back([view, index = scene.views.size()](Scene& s, const VolumeFrame& frame) {
      s.views[index] = scaled(view, frame);
    });
  }
  scene.views.push_back(std::move(view));
}

void parse_explicit(const JsonNode& node, Scene& scene, ScenePlan& plan) {
  const JsonObject object(node, {"name", "eye", "target", "up", "fov_y", "half_height", "near", "units"});
  View view = parse_projection(object);
  view.eye = object.at("eye").vec3(-1e12, 1e12);
  view.target = object.at("target").vec3(-1e12, 1e12);
  if (const auto up = object.find("up")) view.up = up->direction();
  const glm::dvec3 towards = view.target - view.eye;
  if (!(glm::length(towards) > 0)) object.fail("\"eye\" and \"target\" are the same point");
  if (!(glm::length(glm::cross(glm::normalize(towards), view.up)) > 1e-6)) {
    object.fail("\"up\" is parallel to the direction of view");
  }
  view.near = near_of(object, view);
  view.name = object.has("name") ? object.at("name").string() : fmt::format("view_{}", scene.views.size());
  add_view(scene, plan, std::move(view), in_radius_units(object, false));
}

// Azimuth 0 is the axis after `up` (y: z, z: x, x: y); it grows counter-clockwise when seen from the tip of `up`.
glm::dvec3 orbit_direction(const Axis& up, double azimuth, double elevation) {
  glm::dvec3 direction(0);
  direction[up.index] = up.sign * std::sin(elevation);
  direction[(up.index + 1) % 3] = std::cos(elevation) * std::cos(azimuth);
  direction[(up.index + 2) % 3] = up.sign * std::cos(elevation) * std::sin(azimuth);
  return direction;
}

void parse_orbit(const JsonNode& node, Scene& scene, ScenePlan& plan) {
  const JsonObject object(
      node, {"count", "azimuth", "elevation", "distance", "up", "fov_y", "half_height", "near", "units", "target"});
  const int count = object.at("count").integer(1, 3600);
  const double azimuth = object.number_or("azimuth", 0, -360, 360);
  const double elevation = object.number_or("elevation", 0, -89, 89);
  const double distance = object.at("distance").number(0, 1e12, true);
  const auto up_node = object.find("up");
  const Axis up = up_node ? parse_axis(*up_node) : Axis{1, 1.0};
  View common = parse_projection(object);
  const bool relative = in_radius_units(object, true);
  if (const auto target = object.find("target")) {
    common.target = target->vec3(-1e12, 1e12);
  } else if (!relative) {
    object.fail("missing key \"target\": with \"units\": \"world\" an orbit needs its centre");
  }
  common.up = glm::dvec3(0);
  common.up[up.index] = up.sign;
  for (int i = 0; i < count; ++i) {
    View view = common;
    const double turned = azimuth + 360.0 * i / count;
    view.eye = common.target + orbit_direction(up, glm::radians(turned), glm::radians(elevation)) * distance;
    view.near = near_of(object, view);
    view.name = fmt::format("azimuth_{:g}", turned);
    add_view(scene, plan, std::move(view), relative);
  }
}

}  // namespace

void parse_views(const JsonNode& node, Scene& scene, ScenePlan& plan) {
  for (const JsonNode& entry : node.array(1, 10000)) {
    if (entry.json().is_object() && entry.json().contains("orbit")) {
      const JsonObject object(entry, {"orbit"});
      parse_orbit(object.at("orbit"), scene, plan);
    } else {
      parse_explicit(entry, scene, plan);
    }
  }
}

}  // namespace volumark
