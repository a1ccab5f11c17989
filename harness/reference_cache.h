// Reference images on disk, under the hash of everything that they depend on: the scene (with its data), the view, the
// size, the tolerance and the version of the integrator. A file that is truncated, foreign or damaged is made anew.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "methods/reference/reference.h"

namespace volumark {

std::string reference_key(const Scene& scene, const View& view, int width, int height, const ReferenceOptions& options);

class ReferenceCache {
 public:
  explicit ReferenceCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // From the cache, else rendered and kept there. A folder that cannot be written costs only the time. `cached`:
  // whether it was there.
  Reference get(const Scene& scene, const View& view, int width, int height, const ReferenceOptions& options,
                bool* cached = nullptr) const;

  std::optional<Reference> load(const std::string& key) const;  // nothing where there is no whole file of this key
  void store(const std::string& key, const Reference& reference) const;  // throws ResultsError
  std::filesystem::path file_of(const std::string& key) const { return folder_ / (key + ".vmref"); }

 private:
  std::filesystem::path folder_;
};

}  // namespace volumark
