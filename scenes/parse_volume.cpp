#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "scenes/data/find_data.h"
#include "scenes/data/orientation.h"
#include "scenes/scene_plan.h"

namespace volumark {
namespace {

VoxelType type_named(const std::string& name) {
  return name == "u8"    ? VoxelType::U8
         : name == "u16" ? VoxelType::U16
         : name == "i16" ? VoxelType::I16
                         : VoxelType::F32;
}

VoxelType parse_type(const JsonNode& node) { return type_named(node.one_of({"u8", "u16", "i16", "f32"})); }

int whole_or(const JsonObject& object, const char* key, int fallback, int lo, int hi) {
  return object.has(key) ? object.at(key).integer(lo, hi) : fallback;
}

Field parse_field(const JsonNode& node, const std::string& kind) {
  if (kind == "constant") {
    const JsonObject object(node, {"kind", "size", "type", "extent", "value"});
    return ConstantField{object.number_or("value", 1, -1e9, 1e9)};
  }
  if (kind == "distance") {
    const JsonObject object(node, {"kind", "size", "type", "extent"});
    return DistanceField{};
  }
  if (kind == "ramp") {
    const JsonObject object(node, {"kind", "size", "type", "extent", "axis", "from", "to"});
    RampField field;
    if (const auto axis = object.find("axis")) field.axis = axis->one_of({"x", "y", "z"})[0] - 'x';
    field.from = object.number_or("from", field.from, -1e9, 1e9);
    field.to = object.number_or("to", field.to, -1e9, 1e9);
    return field;
  }
  if (kind == "marschner_lobb") {
    const JsonObject object(node, {"kind", "size", "type", "extent", "frequency", "alpha"});
    MarschnerLobbField field;
    field.frequency = object.number_or("frequency", field.frequency, 0, 1e6);
    field.alpha = object.number_or("alpha", field.alpha, 0, 1e6);
    return field;
  }
  if (kind == "vessel_tree") {
    const JsonObject object(
        node, {"kind", "size", "type", "extent", "seed", "generations", "radius", "aneurysm", "softness"});
    VesselTreeField field;
    field.seed = static_cast<uint32_t>(whole_or(object, "seed", 1, 0, 2147483647));
    field.generations = whole_or(object, "generations", field.generations, 0, 12);
    field.radius = object.number_or("radius", field.radius, 1e-3, 1);
    field.aneurysm = object.number_or("aneurysm", field.aneurysm, 0, 10);
    field.softness = object.number_or("softness", field.softness, 1e-6, 1);
    return field;
  }
  const JsonObject object(node, {"kind", "size", "type", "extent", "seed", "octaves", "frequency", "gain", "radius",
                                 "amplitude", "steepness"});
  PerlinCloudField field;
  field.seed = static_cast<uint32_t>(whole_or(object, "seed", 1, 0, 2147483647));
  field.octaves = whole_or(object, "octaves", field.octaves, 1, 16);
  field.frequency = object.number_or("frequency", field.frequency, 0, 1e3, true);
  field.gain = object.number_or("gain", field.gain, 0, 2);
  field.radius = object.number_or("radius", field.radius, -10, 10);
  field.amplitude = object.number_or("amplitude", field.amplitude, 0, 10);
  field.steepness = object.number_or("steepness", field.steepness, 0, 1e3, true);
  return field;
}

ProceduralSpec parse_generator(const JsonNode& node) {
  if (!node.json().is_object()) node.fail("expected an object with \"kind\"");
  if (!node.json().contains("kind")) node.fail("missing key \"kind\"");
  const JsonNode kind_node(node.json()["kind"], node.pointer() + "/kind", node.file());
  const std::string kind =
      kind_node.one_of({"constant", "distance", "ramp", "marschner_lobb", "perlin_cloud", "vessel_tree"});
  ProceduralSpec spec;
  spec.field = parse_field(node, kind);
  const JsonObject object(
      node, {"kind", "size", "type", "extent", "value", "axis", "from", "to", "frequency", "alpha", "seed", "octaves",
             "gain", "radius", "amplitude", "steepness", "generations", "aneurysm", "softness"});
  spec.size = parse_size(object.at("size"));
  if (const auto type = object.find("type")) spec.type = parse_type(*type);
  spec.extent = object.number_or("extent", 2, 1e-12, 1e12);
  return spec;
}

RawLayout parse_raw(const JsonNode& node) {
  const JsonObject object(node, {"size", "type", "endian", "header_bytes", "encoding", "member"});
  RawLayout raw;
  raw.size = parse_size(object.at("size"));
  const std::string type = object.at("type").one_of({"u8", "i8", "u16", "i16", "f32"});
  raw.signed_bytes = type == "i8";
  raw.type = type_named(raw.signed_bytes ? "u8" : type);
  if (const auto endian = object.find("endian")) raw.big_endian = endian->one_of({"little", "big"}) == "big";
  if (raw.type != VoxelType::U8 && !object.has("endian")) object.fail("missing key \"endian\" (\"little\" or \"big\")");
  raw.header_bytes = static_cast<size_t>(whole_or(object, "header_bytes", 0, 0, 1 << 30));
  if (const auto encoding = object.find("encoding")) raw.gzip = encoding->one_of({"raw", "gzip"}) == "gzip";
  if (const auto member = object.find("member")) raw.member = member->string();
  return raw;
}

// Three directions, at right angles; normalised.
glm::dmat3 parse_axes(const JsonNode& node) {
  const std::vector<JsonNode> columns = node.array(3, 3);
  const glm::dmat3 axes(columns[0].direction(), columns[1].direction(), columns[2].direction());
  for (int a = 0; a < 3; ++a) {
    if (std::abs(glm::dot(axes[a], axes[(a + 1) % 3])) > 1e-3) node.fail("expected three directions at right angles");
  }
  return orthonormal(axes);
}

std::string parse_sha256(const JsonNode& node) {
  const std::string text = node.string();
  if (text.size() != 64 || text.find_first_not_of("0123456789abcdef") != std::string::npos) {
    node.fail("expected 64 lower-case hexadecimal digits");
  }
  return text;
}

}  // namespace

glm::ivec3 parse_size(const JsonNode& node) {
  if (node.is_number()) return glm::ivec3(node.integer(1, 65536));
  const std::vector<JsonNode> sides = node.array(3, 3);
  return {sides[0].integer(1, 65536), sides[1].integer(1, 65536), sides[2].integer(1, 65536)};
}

FileSpec parse_file(const JsonObject& object) {
  FileSpec spec;
  spec.file = object.at("file").string();
  const auto text = [&](const char* key) { return object.has(key) ? object.at(key).string() : std::string(); };
  spec.package = text("package");
  spec.package_path = text("package_path");
  if (spec.package.empty() != spec.package_path.empty()) {
    object.fail("\"package\" and \"package_path\" (where the package installs the file) belong together");
  }
  const bool absolute = spec.package_path.starts_with('/');
  if (!spec.package.empty() && is_npm(spec) == absolute) {
    object.at("package_path")
        .fail(absolute ? "expected a path in the npm package's archive, such as package/file"
                       : "expected the absolute path at which the package installs the file");
  }
  spec.licence = text("licence");
  spec.source = text("source");
  if (const auto sha256 = object.find("sha256")) spec.sha256 = parse_sha256(*sha256);
  if (const auto bytes = object.find("bytes")) spec.bytes = static_cast<uint64_t>(bytes->number(1, 1e12));
  if (const auto raw = object.find("raw")) spec.raw = parse_raw(*raw);
  if (const auto spacing = object.find("spacing")) spec.spacing = spacing->vec3(1e-12, 1e12);
  if (const auto origin = object.find("origin")) spec.origin = origin->vec3(-1e12, 1e12);
  if (const auto axes = object.find("axes")) spec.axes = parse_axes(*axes);
  if (const auto non_finite = object.find("non_finite")) {
    spec.non_finite = non_finite->one_of({"refuse", "zero"}) == "zero" ? NonFinite::Zero : NonFinite::Refuse;
  }
  return spec;
}

std::variant<ProceduralSpec, FileSpec> parse_volume(const JsonNode& node) {
  const JsonObject object(node, {"generator", "file", "package", "package_path", "sha256", "bytes", "licence", "source",
                                 "raw", "spacing", "origin", "axes", "non_finite"});
  if (object.exactly_one({"generator", "file"}) == "file") return parse_file(object);
  const JsonObject only(node, {"generator"});
  return parse_generator(only.at("generator"));
}

}  // namespace volumark
