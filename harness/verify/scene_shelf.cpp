#include "harness/verify/scene_shelf.h"

#include <fmt/format.h>

namespace volumark {

const std::vector<SceneShelf::Entry>& SceneShelf::entries() {
  if (!entries_.empty()) return entries_;
  for (const SceneEntry& entry : list_scenes()) {
    Entry out{entry.name, nullptr, ""};
    try {
      out.scene = std::make_shared<const Scene>(load_scene(entry.name, options_));
    } catch (const DataMissing& missing) {
      out.missing = fmt::format("data not installed: {}; to get it: {}", missing.what(), missing.how_to_get);
    }
    entries_.push_back(std::move(out));
  }
  return entries_;
}

}  // namespace volumark
