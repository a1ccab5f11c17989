// What the file of a scene says and load_data has yet to do: the volume to make or read, and the things that are placed
// relative to it. Internal to scenes/.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/mat3x3.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scenes/data/raw.h"
#include "scenes/json_reader.h"
#include "scenes/procedural.h"
#include "scenes/procedural_meshes.h"
#include "scenes/procedural_textures.h"
#include "scenes/scene.h"
#include "scenes/volume_finish.h"

namespace volumark {

struct FileSpec {
  std::string file;          // as written: relative to the scene's folder, or a name to look for
  std::string package;       // Debian package that has it, or "npm:NAME@VERSION"; may be empty
  std::string package_path;  // where the Debian package installs it; its path in the npm package's archive
  std::string sha256;        // lower case; empty: not checked
  std::optional<uint64_t> bytes;
  std::string licence, source;
  std::optional<RawLayout> raw;
  std::optional<glm::dvec3> spacing, origin;
  std::optional<glm::dmat3> axes;
  NonFinite non_finite = NonFinite::Refuse;
};

// A shell as its scene describes it.
struct ShellSpec {
  std::variant<MeshSpec, FileSpec> mesh;
  bool project = false;  // (u, v) by project_texture, not the file's
  // World units: the same everywhere, one a position, or from `least` to `greatest` by noise of `frequency` waves over
  // the mesh's longest side.
  struct Varying {
    double least, greatest, frequency;
    uint32_t seed;
  };
  std::variant<double, std::vector<double>, Varying> thickness;
  std::variant<TextureSpec, FileSpec> texture;  // a file: RGBA texels as FileSpec::raw says, u8 or f32
  double extinction = 100;                      // 1 / world unit, of a texel with A = 1
  glm::dvec2 repeat{1};
};

// What "units": "radius" refers to: the centre of the box (of a shell: of its bounds) and half its diagonal.
struct VolumeFrame {
  glm::dvec3 centre;
  double radius;
};

struct ScenePlan {
  std::variant<ProceduralSpec, FileSpec> volume;
  std::optional<ShellSpec> shell;  // in place of the volume
  std::vector<std::function<void(Scene&, const VolumeFrame&)>> placements;
  std::string canonical;  // text of all that decides the picture, but for the content of data files
};

std::variant<ProceduralSpec, FileSpec> parse_volume(const JsonNode& node);
ShellSpec parse_shell(const JsonNode& node);
// Parts of both: a lattice's size (a number or three), and the keys of a file. `object` has been checked for its keys.
glm::ivec3 parse_size(const JsonNode& node);
FileSpec parse_file(const JsonObject& object);
TransferFunction parse_transfer(const JsonNode& node);
void parse_views(const JsonNode& node, Scene& scene, ScenePlan& plan);
// "isosurface" or "slice_plane", of which a scene has at most one.
void parse_display(const JsonObject& root, Scene& scene, ScenePlan& plan);
void parse_effects(const JsonNode& node, Scene& scene, ScenePlan& plan);

// True for "units": "radius", false for "world"; `fallback` where the key is absent.
bool in_radius_units(const JsonObject& object, bool fallback);

// Makes or reads mesh and texture; `read` finds a file and returns its bytes. Throws DataError.
using ReadFile = std::function<std::vector<std::byte>(const FileSpec&)>;
Shell load_shell(const ShellSpec& spec, const ReadFile& read);

// Sets Scene::source and Scene::hash, as far as they are known before the data are loaded.
void describe_source(Scene& scene);

}  // namespace volumark
