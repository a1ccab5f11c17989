#include "reports/merge.h"

#include <algorithm>

namespace volumark {
namespace {

std::filesystem::path folder_of(const std::filesystem::path& path) {
  const std::filesystem::path whole = std::filesystem::absolute(path).lexically_normal();
  const std::filesystem::path folder = std::filesystem::is_directory(whole) ? whole : whole.parent_path();
  return folder.has_filename() ? folder : folder.parent_path();  // no slash at the end
}

std::filesystem::path common(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::filesystem::path out;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end() && *i == *j; ++i, ++j) out /= *i;
  return out;
}

// Only put in front, never resolved: a path that climbs out of its run's folder stays one that does.
void move_image(std::optional<ImageFile>& image, const std::filesystem::path& below) {
  if (!image) return;
  auto moved = [&](const std::string& path) { return path.empty() ? path : (below / path).generic_string(); };
  image->path = moved(image->path);
  image->preview = moved(image->preview);
}

void move_images(Results& results, const std::filesystem::path& below) {
  if (below == "." || below.empty()) return;
  for (Result& cell : results.results)
    for (ViewResult& view : cell.views)
      for (auto* image : {&view.rendered, &view.reference_image, &view.difference, &view.flip})
        move_image(*image, below);
  for (HardCaseRow& row : results.hard_cases) {
    move_image(row.picture, below);
    move_image(row.difference, below);
  }
}

template <class T>
void append(std::vector<T>& to, std::vector<T>& from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

// What has a name is described once.
template <class T, class Name>
void append_new(std::vector<T>& to, const std::vector<T>& from, const Name& name) {
  for (const T& one : from)
    if (std::none_of(to.begin(), to.end(), [&](const T& other) { return name(other) == name(one); })) to.push_back(one);
}

void add(Results& to, Results& from) {
  append(to.results, from.results);
  append(to.convergence, from.convergence);
  append(to.parity, from.parity);
  append(to.claims, from.claims);
  append(to.attribution, from.attribution);
  append(to.pairs, from.pairs);
  append(to.effects, from.effects);
  if (to.hard_cases.empty()) append(to.hard_cases, from.hard_cases);
  if (to.sensitivity.empty()) append(to.sensitivity, from.sensitivity);
  append_new(to.backends, from.backends, [](const auto& one) { return one.id; });
  append_new(to.experiments, from.experiments, [](const auto& one) { return one.name; });
  append_new(to.scenes, from.scenes, [](const auto& one) { return one.name; });
  append_new(to.methods, from.methods, [](const auto& one) { return one.name; });
  append_new(to.self_test, from.self_test, [](const auto& one) { return one.metric + "/" + one.name; });
}

std::vector<std::string> differences(const Results& first, const Results& other) {
  std::vector<std::string> out;
  if (other.git.sha != first.git.sha || other.git.dirty != first.git.dirty)
    out.push_back("commit " + other.git.sha.substr(0, 12) + (other.git.dirty ? ", with uncommitted changes" : ""));
  if (other.machine.cpu != first.machine.cpu || other.machine.cores != first.machine.cores ||
      other.machine.os != first.machine.os)
    out.push_back("machine " + other.machine.cpu + ", " + std::to_string(other.machine.cores) + " cores, " +
                  other.machine.os);
  if (other.build.flags != first.build.flags || other.build.version != first.build.version ||
      other.build.type != first.build.type)
    out.push_back("build " + other.build.compiler + " " + other.build.version + " " + other.build.type);
  for (const BackendResultInfo& backend : other.backends)
    for (const BackendResultInfo& known : first.backends)
      if (known.id == backend.id && known.software == backend.software &&
          (known.renderer != backend.renderer || known.version != backend.version))
        out.push_back(backend.id + ": " + backend.renderer + " " + backend.version);
  for (const SceneResultInfo& scene : other.scenes)
    for (const SceneResultInfo& known : first.scenes)
      if (known.name == scene.name && known.hash != scene.hash) out.push_back("scene " + scene.name);
  return out;
}

// A backend is described once, and software is never ranked against hardware.
void refuse_mixed_backends(const Results& first, const Results& other, const std::string& path) {
  for (const BackendResultInfo& backend : other.backends)
    for (const BackendResultInfo& known : first.backends)
      if (known.id == backend.id && known.software != backend.software)
        throw ResultsError(path + ": " + backend.id + " is " + (backend.software ? "software" : "hardware") +
                           " here and not in the first of these results; report them apart");
}

}  // namespace

MergedResults merge_results(std::span<const std::filesystem::path> paths) {
  if (paths.empty()) throw ResultsError("no results to merge");
  MergedResults out;
  std::vector<Results> all;
  out.folder = folder_of(paths.front());
  for (const std::filesystem::path& path : paths) {
    all.push_back(read_results(path));
    out.folder = common(out.folder, folder_of(path));
  }
  for (size_t i = 0; i < all.size(); ++i) {
    move_images(all[i], folder_of(paths[i]).lexically_relative(out.folder));
    std::string note;
    for (const std::string& difference : differences(all.front(), all[i]))
      note += (note.empty() ? paths[i].generic_string() + " is of another " : "; another ") + difference;
    if (!note.empty()) out.notes.push_back(note);
    if (paths.size() > 1 && (all[i].run.interrupted || all[i].run.finished_at.empty()))
      out.notes.push_back(paths[i].generic_string() + " did not finish: rows may be missing");
    if (i == 0) continue;
    refuse_mixed_backends(all.front(), all[i], paths[i].string());
    for (const Result& cell : all[i].results)
      if (std::any_of(all.front().results.begin(), all.front().results.end(),
                      [&](const Result& other) { return other.key == cell.key; }))
        throw ResultsError(paths[i].string() + ": " + cell.key.experiment + ", " + cell.key.scene + ", " +
                           cell.key.method + " on " + cell.key.backend +
                           " is in another of these results too; report them apart");
    if (!all.front().hard_cases.empty() && !all[i].hard_cases.empty())
      out.notes.push_back("the hard cases of " + paths[i].generic_string() + " are left out: an earlier one has them");
    add(all.front(), all[i]);
  }
  out.results = std::move(all.front());
  return out;
}

}  // namespace volumark
