// The shipped scenes with their data, each loaded once, for the cases that run over all of them.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scenes/scene_io.h"

namespace volumark {

class SceneShelf {
 public:
  explicit SceneShelf(DataOptions options) : options_(std::move(options)) {}

  struct Entry {
    std::string name;
    std::shared_ptr<const Scene> scene;  // null where it cannot be had
    std::string missing;                 // then why, and how to get it
  };
  const std::vector<Entry>& entries();

 private:
  DataOptions options_;
  std::vector<Entry> entries_;
};

}  // namespace volumark
