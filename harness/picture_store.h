// The pictures of a run, under images/ of its folder: float EXR with a PNG for the eye, or PFM without the OpenImageIO
// module. A picture is written whole or not at all.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <string>

#include "reports/results.h"
#include "scenes/image.h"

namespace volumark {

class PictureStore {
 public:
  // Files lie under `root`; paths in ImageFile are relative to it.
  explicit PictureStore(std::filesystem::path root);

  // A linear picture (premultiplied RGBA) with its preview over the background. `stem`: "sphere/reference-v0".
  // `note` as in write_image.
  ImageFile linear(const std::string& stem, const Image& image, const glm::dvec3& background,
                   const std::string& note = "") const;
  // A picture for the eye alone: differences and maps, opaque.
  ImageFile shown(const std::string& stem, const Image& image) const;

 private:
  std::filesystem::path root_;
  bool module_;
};

}  // namespace volumark
