// Scene files: JSON text -> Scene, and its data. The format is described in docs/scenes.md and
// scenes/scene.schema.json. Parsing touches no data file. Until load_data has run, Scene::volume is null, and of a view
// that is placed relative to the volume only the name is valid (the number of views always is).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/errors.h"
#include "scenes/scene.h"

namespace volumark {

// Where data files are looked for, after the folder of the scene file: `directories` (recursively, by file name, and by
// size and checksum where the scene states them), the path at which the Debian package installs the file, `cache`.
struct DataOptions {
  std::vector<std::filesystem::path> directories;  // --data
  std::filesystem::path cache;                     // that scripts/fetch_data.sh fills; empty: not used
  bool installed_packages = true;
};
// directories: VOLUMARK_DATA (colon-separated). cache: VOLUMARK_CACHE, else XDG_CACHE_HOME/volumark, else
// HOME/.cache/volumark.
DataOptions data_options_from_environment();

// Text of a scene file; `path` is used in messages, and its folder for relative file names. Throws SceneError.
Scene parse_scene(std::string_view text, const std::string& path);

// A shipped scene by name, or a file (anything with a '/' or ending in .json). Throws SceneError.
Scene load_scene(const std::string& name_or_path);
// The same, with its data.
Scene load_scene(const std::string& name_or_path, const DataOptions& options);

// Fills volume, source, views and hash. Throws DataMissing, DataError. A second call does nothing.
void load_data(Scene& scene, const DataOptions& options);

struct SceneEntry {
  std::string name, title, path;
};
// Shipped scenes by name: of VOLUMARK_SCENES, else of the installation, else of the source tree.
std::vector<SceneEntry> list_scenes();
std::filesystem::path scene_directory();

}  // namespace volumark
