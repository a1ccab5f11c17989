#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "scenes/nearest.h"
#include "scenes/scene_plan.h"

namespace volumark {
namespace {

glm::dvec2 pair_of(const JsonNode& node, double lo, double hi, bool above = false) {
  const std::vector<JsonNode> both = node.array(2, 2);
  return {both[0].number(lo, hi, above), both[1].number(lo, hi, above)};
}

glm::ivec2 counts_of(const JsonObject& object, const char* key, const glm::ivec2& fallback, int least) {
  const auto node = object.find(key);
  if (!node) return fallback;
  const std::vector<JsonNode> both = node->array(2, 2);
  return {both[0].integer(least, 4096), both[1].integer(least, 4096)};
}

uint32_t seed_of(const JsonObject& object) {
  return object.has("seed") ? static_cast<uint32_t>(object.at("seed").integer(0, 2147483647)) : 1;
}

MeshSpec parse_mesh_generator(const JsonNode& node) {
  if (!node.json().is_object()) node.fail("expected an object with \"kind\"");
  if (!node.json().contains("kind")) node.fail("missing key \"kind\"");
  const JsonNode kind_node(node.json()["kind"], node.pointer() + "/kind", node.file());
  const std::string kind = kind_node.one_of({"torus", "terrain", "strip"});
  if (kind == "torus") {
    const JsonObject object(node, {"kind", "segments", "radius", "tube", "distortion"});
    TorusMesh torus;
    torus.segments = counts_of(object, "segments", torus.segments, 3);
    torus.radius = object.number_or("radius", torus.radius, 0, 1e12, true);
    torus.tube = object.number_or("tube", torus.tube, 0, 1e12, true);
    torus.distortion = object.number_or("distortion", torus.distortion, 0, 1);
    return torus;
  }
  if (kind == "terrain") {
    const JsonObject object(node, {"kind", "cells", "extent", "height", "frequency", "seed"});
    TerrainMesh terrain;
    terrain.cells = counts_of(object, "cells", terrain.cells, 1);
    terrain.extent = object.number_or("extent", terrain.extent, 0, 1e12, true);
    terrain.height = object.number_or("height", terrain.height, 0, 1e12);
    terrain.frequency = object.number_or("frequency", terrain.frequency, 0, 64);
    terrain.seed = seed_of(object);
    return terrain;
  }
  const JsonObject object(node, {"kind", "cells", "extent", "bend"});
  StripMesh strip;
  strip.cells = counts_of(object, "cells", strip.cells, 1);
  if (const auto extent = object.find("extent")) strip.extent = pair_of(*extent, 0, 1e12, true);
  strip.bend = glm::radians(object.number_or("bend", 0, 0, 359));
  return strip;
}

void parse_mesh(const JsonNode& node, ShellSpec& spec) {
  const JsonObject object(
      node, {"generator", "file", "package", "package_path", "sha256", "bytes", "licence", "source", "projection"});
  if (object.exactly_one({"generator", "file"}) == "generator") {
    const JsonObject only(node, {"generator"});
    spec.mesh = parse_mesh_generator(only.at("generator"));
    return;
  }
  spec.mesh = parse_file(object);
  if (const auto projection = object.find("projection")) spec.project = projection->one_of({"file", "box"}) == "box";
}

TextureSpec parse_texture_generator(const JsonNode& node) {
  const JsonObject object(node, {"kind", "size", "seed"});
  TextureSpec spec;
  const JsonNode kind = object.at("kind");
  const std::string name = kind.string();
  const auto kinds = texture_kinds();
  const auto found = std::find(kinds.begin(), kinds.end(), name);
  if (found == kinds.end()) {
    const std::vector<std::string> all(kinds.begin(), kinds.end());
    std::string list;
    for (const std::string& known : all) list += (list.empty() ? "" : ", ") + known;
    kind.fail("unknown texture \"" + name + "\"" + did_you_mean(name, all) + "; there are: " + list);
  }
  spec.kind = *found;
  if (const auto size = object.find("size")) {
    spec.size = parse_size(*size);
    if (std::max({spec.size.x, spec.size.y, spec.size.z}) > 1024) size->fail("expected sizes up to 1024");
  }
  spec.seed = seed_of(object);
  return spec;
}

void parse_texture(const JsonNode& node, ShellSpec& spec) {
  const JsonObject object(node, {"generator", "file", "package", "package_path", "sha256", "bytes", "licence", "source",
                                 "raw", "extinction"});
  spec.extinction = object.number_or("extinction", spec.extinction, 0, 1e12);
  if (object.exactly_one({"generator", "file"}) == "generator") {
    const JsonObject only(node, {"generator", "extinction"});
    TextureSpec texture = parse_texture_generator(only.at("generator"));
    texture.extinction = spec.extinction;
    spec.texture = texture;
    return;
  }
  const FileSpec file = parse_file(object);
  const JsonNode raw = object.at("raw");
  if (file.raw->type != VoxelType::U8 && file.raw->type != VoxelType::F32) {
    raw.fail("the texels of a shell are RGBA of \"u8\" or \"f32\"");
  }
  if (std::max({file.raw->size.x, file.raw->size.y, file.raw->size.z}) > 4096) raw.fail("expected sizes up to 4096");
  spec.texture = file;
}

// A number, or {"least", "greatest", ...}.
void parse_thickness(const JsonNode& node, ShellSpec& spec) {
  if (node.is_number()) {
    spec.thickness = node.number(0, 1e12, true);
    return;
  }
  const JsonObject object(node, {"least", "greatest", "frequency", "seed"});
  ShellSpec::Varying varying{};
  varying.least = object.at("least").number(0, 1e12);
  varying.greatest = object.at("greatest").number(0, 1e12, true);
  if (varying.least > varying.greatest) object.fail("\"least\" is above \"greatest\"");
  varying.frequency = object.number_or("frequency", 2, 0, 100, true);
  varying.seed = seed_of(object);
  spec.thickness = varying;
}

}  // namespace

ShellSpec parse_shell(const JsonNode& node) {
  const JsonObject object(node, {"mesh", "thickness", "vertex_thickness", "texture", "repeat"});
  ShellSpec spec;
  parse_mesh(object.at("mesh"), spec);
  if (object.exactly_one({"thickness", "vertex_thickness"}) == "thickness") {
    parse_thickness(object.at("thickness"), spec);
  } else {
    std::vector<double> each;
    for (const JsonNode& entry : object.at("vertex_thickness").array(1, 10000000))
      each.push_back(entry.number(0, 1e12));
    spec.thickness = std::move(each);
  }
  parse_texture(object.at("texture"), spec);
  if (const auto repeat = object.find("repeat")) spec.repeat = pair_of(*repeat, 0, 1e4, true);
  return spec;
}

}  // namespace volumark
