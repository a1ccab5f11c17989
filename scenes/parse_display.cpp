#include <glm/geometric.hpp>

#include "scenes/scene_plan.h"

namespace volumark {
namespace {

Isosurface parse_isosurface(const JsonNode& node) {
  const JsonObject object(node, {"value", "colour", "ambient_colour"});
  Isosurface surface;
  surface.value = object.at("value").number(-1e30, 1e30);
  if (const auto colour = object.find("colour")) surface.colour = colour->vec3(0, 1);
  surface.ambient_colour = surface.colour;
  if (const auto colour = object.find("ambient_colour")) surface.ambient_colour = colour->vec3(0, 1);
  return surface;
}

SlicePlane parse_slice_plane(const JsonNode& node, ScenePlan& plan) {
  const JsonObject object(node, {"point", "normal", "units"});
  SlicePlane plane;
  plane.normal = object.at("normal").direction();
  plane.point = object.at("point").vec3(-1e12, 1e12);
  if (in_radius_units(object, false)) {
    plan.placements.push_back([point = plane.point](Scene& scene, const VolumeFrame& frame) {
      scene.slice_plane->point = frame.centre + point * frame.radius;
    });
  }
  return plane;
}

}  // namespace

void parse_display(const JsonObject& root, Scene& scene, ScenePlan& plan) {
  const auto isosurface = root.find("isosurface"), plane = root.find("slice_plane");
  if (isosurface && plane) plane->fail("a scene shows an isosurface or a slice plane, not both");
  if (isosurface) {
    scene.display = Display::Isosurface;
    scene.isosurface = parse_isosurface(*isosurface);
  }
  if (plane) {
    scene.display = Display::SlicePlane;
    scene.slice_plane = parse_slice_plane(*plane, plan);
  }
}

}  // namespace volumark
