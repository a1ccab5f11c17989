#include <glm/geometric.hpp>

#include "scenes/scene_plan.h"

namespace volumark {
namespace {

Light parse_light(const JsonNode& node, size_t index, ScenePlan& plan) {
  const JsonObject object(node, {"directional", "point", "colour", "units"});
  Light light;
  if (const auto colour = object.find("colour")) light.colour = colour->vec3(0, 1000);
  if (object.exactly_one({"directional", "point"}) == "directional") {
    if (object.has("units")) object.fail("\"units\" belongs to a point light");
    light.kind = Light::Kind::Directional;
    light.vector = object.at("directional").direction();
    return light;
  }
  light.kind = Light::Kind::Point;
  light.vector = object.at("point").vec3(-1e12, 1e12);
  if (in_radius_units(object, false)) {
    plan.placements.push_back([index, position = light.vector](Scene& scene, const VolumeFrame& frame) {
      scene.effects.lighting->lights[index].vector = frame.centre + position * frame.radius;
    });
  }
  return light;
}

Lighting parse_lighting(const JsonNode& node, ScenePlan& plan) {
  const JsonObject object(node,
                          {"ambient", "diffuse", "specular", "shininess", "two_sided", "gradient_floor", "lights"});
  Lighting lighting;
  lighting.ambient = object.number_or("ambient", lighting.ambient, 0, 1000);
  lighting.diffuse = object.number_or("diffuse", lighting.diffuse, 0, 1000);
  lighting.specular = object.number_or("specular", lighting.specular, 0, 1000);
  lighting.shininess = object.number_or("shininess", lighting.shininess, 1, 10000);
  lighting.gradient_floor = object.number_or("gradient_floor", lighting.gradient_floor, 1e-6, 10);
  if (const auto two_sided = object.find("two_sided")) lighting.two_sided = two_sided->boolean();
  for (const JsonNode& light : object.at("lights").array(1, 1000)) {
    lighting.lights.push_back(parse_light(light, lighting.lights.size(), plan));
  }
  return lighting;
}

ClipPlane parse_clip_plane(const JsonNode& node, size_t index, ScenePlan& plan) {
  const JsonObject object(node, {"normal", "distance", "point", "units"});
  ClipPlane plane;
  plane.normal = object.at("normal").direction();
  plane.distance = object.exactly_one({"distance", "point"}) == "distance"
                       ? object.at("distance").number(-1e12, 1e12)
                       : glm::dot(plane.normal, object.at("point").vec3(-1e12, 1e12));
  if (in_radius_units(object, false)) {
    plan.placements.push_back([index, plane](Scene& scene, const VolumeFrame& frame) {
      scene.effects.clip_planes[index].distance = glm::dot(plane.normal, frame.centre) + plane.distance * frame.radius;
    });
  }
  return plane;
}

}  // namespace

void parse_effects(const JsonNode& node, Scene& scene, ScenePlan& plan) {
  // Of effects that nothing simulates yet only the name is kept: their parameters come with the technique.
  std::vector<const char*> names;
  for (const EffectInfo& effect : effect_list()) names.push_back(effect.name);
  const JsonObject object(node, names);
  if (const auto lighting = object.find("lighting")) scene.effects.lighting = parse_lighting(*lighting, plan);
  if (const auto planes = object.find("clip_planes")) {
    for (const JsonNode& plane : planes->array(1, 64)) {
      scene.effects.clip_planes.push_back(parse_clip_plane(plane, scene.effects.clip_planes.size(), plan));
    }
  }
  if (const auto fixed_point = object.find("fixed_point")) scene.effects.fixed_point = fixed_point->boolean();
  for (const char* name : names) {
    const std::string_view known(name);
    if (known == "lighting" || known == "clip_planes" || known == "fixed_point" || !object.has(name)) continue;
    if (!object.at(name).json().is_object()) object.at(name).fail("expected an object");
    scene.effects.others.emplace_back(name);
  }
}

}  // namespace volumark
