#include "scenes/scene_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <sstream>

#include "scenes/data/find_data.h"
#include "scenes/data/read_volume.h"
#include "scenes/json_reader.h"
#include "scenes/nearest.h"
#include "scenes/scene_plan.h"
#include "scenes/sha256.h"
#include "scenes/shell.h"

namespace volumark {
namespace {

namespace fs = std::filesystem;

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

std::string read_text(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) throw SceneError(fmt::format("{}: no such file", path.string()));
  std::ifstream in(path, std::ios::binary);
  if (!in) throw SceneError(fmt::format("{}: cannot be read", path.string()));
  return {std::istreambuf_iterator<char>(in), {}};
}

bool is_scene_file(const fs::path& path) {
  return path.extension() == ".json" && !path.stem().string().ends_with(".schema");
}

// The files that a scene needs; none: it is procedural.
std::vector<const FileSpec*> files_of(const ScenePlan& plan) {
  std::vector<const FileSpec*> files;
  const auto add = [&](const FileSpec* spec) {
    if (spec != nullptr) files.push_back(spec);
  };
  if (plan.shell) {
    add(std::get_if<FileSpec>(&plan.shell->mesh));
    add(std::get_if<FileSpec>(&plan.shell->texture));
  } else {
    add(std::get_if<FileSpec>(&plan.volume));
  }
  return files;
}

std::string joined(const std::vector<std::string>& items) {
  std::string list;
  for (const std::string& item : items) list += (list.empty() ? "" : ", ") + item;
  return list;
}

// What a shell's two files have in common stands once; what differs, with a comma between.
DataSource describe(const ScenePlan& plan) {
  const std::vector<const FileSpec*> files = files_of(plan);
  if (files.empty()) return {"procedural", "", "", "", ""};
  std::vector<std::string> origins, checksums, licences, ways;
  const auto add = [](std::vector<std::string>& list, const std::string& item) {
    if (!item.empty() && std::find(list.begin(), list.end(), item) == list.end()) list.push_back(item);
  };
  for (const FileSpec* spec : files) {
    const bool debian = !spec->package.empty() && !is_npm(*spec);
    add(origins, spec->package.empty() ? "file" : (debian ? "debian:" : "") + spec->package);
    add(licences, spec->licence);
    add(ways, how_to_get(*spec));
    if (!spec->sha256.empty()) checksums.push_back(spec->sha256);
  }
  if (checksums.size() < files.size()) checksums.clear();  // not known before all are read
  return {joined(origins), "", joined(checksums), joined(licences), joined(ways)};
}

// Finds and reads the files of one scene, and remembers which they were.
class Files {
 public:
  Files(const Scene& scene, const DataOptions& options) : scene_(scene), options_(options) {}
  std::vector<std::byte> operator()(const FileSpec& spec) {
    const fs::path path = find_data(spec, scene_.path, options_);
    std::vector<std::byte> bytes = read_file_bytes(path);
    paths_.push_back(path.string());
    // The search has compared the checksum where the scene states one.
    checksums_.push_back(file_sha256(path));
    return bytes;
  }
  const std::vector<std::string>& paths() const { return paths_; }
  void note_in(DataSource& source) const {
    if (paths_.empty()) return;
    source.path = joined(paths_);
    source.sha256 = joined(checksums_);
  }

 private:
  const Scene& scene_;
  const DataOptions& options_;
  std::vector<std::string> paths_, checksums_;
};

// Both return what "units": "radius" refers to.
VolumeFrame read_shell(Scene& scene, Files& files) {
  scene.shell =
      std::make_shared<const Shell>(load_shell(*scene.plan->shell, [&](const FileSpec& spec) { return files(spec); }));
  const ShellBounds bounds = bounds_of(*scene.shell);
  return {0.5 * (bounds.lo + bounds.hi), 0.5 * glm::length(bounds.hi - bounds.lo)};
}

VolumeFrame read_volume(Scene& scene, Files& files) {
  if (const auto* spec = std::get_if<ProceduralSpec>(&scene.plan->volume)) {
    scene.volume = std::make_shared<const Volume>(make_volume(*spec));
  } else {
    const auto& file = std::get<FileSpec>(scene.plan->volume);
    const std::vector<std::byte> bytes = files(file);
    scene.volume = std::make_shared<const Volume>(volumark::read_volume(file, bytes, files.paths().back()));
  }
  const glm::dmat4 box = scene.volume->box_to_world();
  return {glm::dvec3(box * glm::dvec4(0.5, 0.5, 0.5, 1)), glm::length(scene.volume->extent()) / 2};
}

// The checksum of a detached NRRD header says nothing about its voxels: then they count too, once they are there.
bool is_detached(const ScenePlan& plan) {
  const auto* spec = plan.shell ? nullptr : std::get_if<FileSpec>(&plan.volume);
  return spec != nullptr && !spec->raw && spec->file.ends_with(".nhdr");
}

void set_hash(Scene& scene) {
  const bool detached = is_detached(*scene.plan);
  const bool known =
      scene.source.origin == "procedural" || (!scene.source.sha256.empty() && (scene.volume || !detached));
  if (!known) {
    scene.hash.clear();
    return;
  }
  const std::string voxels = detached ? sha256_hex(scene.volume->voxels) : "";
  scene.hash = sha256_hex(scene.plan->canonical + scene.source.sha256 + voxels);
}

fs::path executable_directory() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path();
}

}  // namespace

DataOptions data_options_from_environment() {
  DataOptions options;
  std::istringstream list(environment("VOLUMARK_DATA"));
  for (std::string directory; std::getline(list, directory, ':');) {
    if (!directory.empty()) options.directories.emplace_back(directory);
  }
  if (const std::string cache = environment("VOLUMARK_CACHE"); !cache.empty()) {
    options.cache = cache;
  } else if (const std::string xdg = environment("XDG_CACHE_HOME"); !xdg.empty()) {
    options.cache = fs::path(xdg) / "volumark";
  } else if (const std::string home = environment("HOME"); !home.empty()) {
    options.cache = fs::path(home) / ".cache" / "volumark";
  }
  return options;
}

fs::path scene_directory() {
  if (const std::string given = environment("VOLUMARK_SCENES"); !given.empty()) return given;
  std::error_code error;
  const fs::path installed = executable_directory() / "../share/volumark/scenes";
  return fs::is_directory(installed, error) ? installed : fs::path(VM_SCENE_DIR);
}

std::vector<SceneEntry> list_scenes() {
  std::vector<SceneEntry> entries;
  std::error_code error;
  for (const auto& file : fs::directory_iterator(scene_directory(), error)) {
    if (!is_scene_file(file.path())) continue;
    const nlohmann::json document = parse_json(read_text(file.path()), file.path().string());
    const bool titled = document.is_object() && document.contains("title") && document["title"].is_string();
    entries.push_back(
        {file.path().stem().string(), titled ? document["title"].get<std::string>() : "", file.path().string()});
  }
  std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return entries;
}

Scene load_scene(const std::string& name_or_path) {
  if (name_or_path.find('/') != std::string::npos || name_or_path.ends_with(".json")) {
    return parse_scene(read_text(name_or_path), name_or_path);
  }
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& file : fs::directory_iterator(scene_directory(), error)) {
    if (is_scene_file(file.path())) names.push_back(file.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  if (std::find(names.begin(), names.end(), name_or_path) == names.end()) {
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
    throw SceneError(fmt::format("unknown scene \"{}\"{}; there are: {}; or the path of a .json file", name_or_path,
                                 did_you_mean(name_or_path, names), all));
  }
  const fs::path path = scene_directory() / (name_or_path + ".json");
  return parse_scene(read_text(path), path.string());
}

Scene load_scene(const std::string& name_or_path, const DataOptions& options) {
  Scene scene = load_scene(name_or_path);
  load_data(scene, options);
  return scene;
}

void describe_source(Scene& scene) {
  scene.source = describe(*scene.plan);
  set_hash(scene);
}

void load_data(Scene& scene, const DataOptions& options) {
  if (scene.volume || scene.shell || !scene.plan) return;
  Files files(scene, options);
  const VolumeFrame frame = scene.plan->shell ? read_shell(scene, files) : read_volume(scene, files);
  files.note_in(scene.source);
  for (const auto& place : scene.plan->placements) place(scene, frame);
  set_hash(scene);
}

}  // namespace volumark
