#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "scenes/scene_io.h"
#include "scenes/scene_plan.h"

namespace volumark {
namespace {

// A change here gives every scene a new hash: bump it when the same file comes to mean another picture.
constexpr int kMeaning = 1;

// Extinction from an opacity over a reference length.
double extinction_of(const JsonObject& point, const JsonObject& transfer) {
  if (point.exactly_one({"extinction", "opacity"}) == "extinction") {
    if (point.has("per")) point.fail("\"per\" belongs to \"opacity\"; an extinction is per world unit already");
    return point.at("extinction").number(0, 1e12);
  }
  const double opacity = point.at("opacity").number(0, 1);
  if (opacity == 1) {
    point.at("opacity").fail(
        "opacity 1 over a finite length needs an infinite extinction; use a value below 1 (0.9999 is opaque to the "
        "eye) "
        "or give \"extinction\"");
  }
  if (!point.has("per") && !transfer.has("per")) {
    point.fail("\"opacity\" needs the length over which it holds: \"per\" here or in \"transfer\" (world units)");
  }
  const double per = (point.has("per") ? point : transfer).at("per").number(0, 1e12, true);
  return -std::log1p(-opacity) / per;
}

std::string canonical_text(nlohmann::json document) {
  for (const char* key : {"title", "description"}) document.erase(key);
  const bool shell = document.contains("shell");
  for (const char* key : {"file", "package", "package_path", "licence", "source", "bytes", "sha256"}) {
    if (!shell) document["volume"].erase(key);
    if (shell) document["shell"]["mesh"].erase(key);
    if (shell) document["shell"]["texture"].erase(key);
  }
  for (nlohmann::json& view : document["views"]) view.erase("name");
  return fmt::format("volumark scene, meaning {}\n{}\n", kMeaning, document.dump());
}

}  // namespace

TransferFunction parse_transfer(const JsonNode& node) {
  const JsonObject object(node, {"points", "per", "window"});
  TransferFunction transfer;
  for (const JsonNode& entry : object.at("points").array(1, 4096)) {
    const JsonObject point(entry, {"value", "colour", "extinction", "opacity", "per"});
    TransferPoint p;
    p.value = point.at("value").number(-1e30, 1e30);
    p.colour = point.at("colour").vec3(0, 1);
    p.extinction = extinction_of(point, object);
    if (!transfer.points.empty() && p.value < transfer.points.back().value) {
      point.at("value").fail(fmt::format("transfer function out of order: {} comes after {}; values must not decrease",
                                         p.value, transfer.points.back().value));
    }
    const size_t n = transfer.points.size();
    if (n >= 2 && p.value == transfer.points[n - 2].value) {
      point.at("value").fail(fmt::format("a third point at {}: two make a jump, more have no meaning", p.value));
    }
    transfer.points.push_back(p);
  }
  const double first = transfer.points.front().value, last = transfer.points.back().value;
  if (const auto window = object.find("window")) {
    const std::vector<JsonNode> ends = window->array(2, 2);
    transfer.lo = ends[0].number(-1e30, 1e30);
    transfer.hi = ends[1].number(-1e30, 1e30);
    if (!(transfer.lo < transfer.hi)) window->fail("expected [lo, hi] with lo < hi");
    if (transfer.lo > first || transfer.hi < last) {
      window->fail(fmt::format("the window must cover all points: {} to {}", first, last));
    }
  } else {
    // One value only (or one jump): any window around it serves.
    transfer.lo = first < last ? first : first - 0.5;
    transfer.hi = first < last ? last : first + 0.5;
  }
  return transfer;
}

bool in_radius_units(const JsonObject& object, bool fallback) {
  const auto units = object.find("units");
  return units ? units->one_of({"world", "radius"}) == "radius" : fallback;
}

Scene parse_scene(std::string_view text, const std::string& path) {
  const nlohmann::json document = parse_json(text, path);
  const JsonObject root(JsonNode(document, "", path),
                        {"volumark_scene", "title", "description", "volume", "transfer", "views", "image", "background",
                         "effects", "isosurface", "slice_plane", "shell"});
  root.at("volumark_scene").integer(1, 1);
  Scene scene;
  auto plan = std::make_shared<ScenePlan>();
  scene.path = path;
  scene.name = std::filesystem::path(path).stem().string();
  scene.title = root.at("title").string();
  if (const auto description = root.find("description")) scene.description = description->string(true);
  if (const auto shell = root.find("shell")) {
    for (const char* key : {"volume", "transfer", "isosurface", "slice_plane"}) {
      if (root.has(key)) root.at(key).fail(fmt::format("a scene with a \"shell\" has no \"{}\"", key));
    }
    plan->shell = parse_shell(*shell);
    scene.display = Display::Shell;
  } else {
    plan->volume = parse_volume(root.at("volume"));
    scene.transfer = parse_transfer(root.at("transfer"));
  }
  parse_views(root.at("views"), scene, *plan);
  if (const auto image = root.find("image")) {
    const JsonObject size(*image, {"width", "height"});
    scene.width = size.at("width").integer(1, 16384);
    scene.height = size.at("height").integer(1, 16384);
  }
  if (const auto background = root.find("background")) scene.background = background->vec3(0, 1);
  if (const auto effects = root.find("effects")) parse_effects(*effects, scene, *plan);
  parse_display(root, scene, *plan);
  plan->canonical = canonical_text(document);
  scene.plan = std::move(plan);
  describe_source(scene);
  return scene;
}

}  // namespace volumark
