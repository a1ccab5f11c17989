#include "harness/picture_store.h"

#include "harness/image_io.h"

namespace volumark {

PictureStore::PictureStore(std::filesystem::path root) : root_(std::move(root)), module_(has_image_module()) {}

ImageFile PictureStore::linear(const std::string& stem, const Image& image, const glm::dvec3& background,
                               const std::string& note) const {
  const std::string base = "images/" + stem;
  ImageFile out;
  out.path = base + (module_ ? ".exr" : ".pfm");
  out.sha256 = pixel_hash(image);
  out.width = image.width;
  out.height = image.height;
  out.colourspace = "linear";
  std::filesystem::create_directories((root_ / base).parent_path());
  write_image(root_ / out.path, image, background, note);
  if (module_) {
    out.preview = base + ".png";
    write_image(root_ / out.preview, image, background, note);
  }
  return out;
}

ImageFile PictureStore::shown(const std::string& stem, const Image& image) const {
  ImageFile out;
  out.path = "images/" + stem + (module_ ? ".png" : ".pfm");
  out.sha256 = pixel_hash(image);
  out.width = image.width;
  out.height = image.height;
  out.colourspace = module_ ? "srgb" : "linear";
  if (module_) out.preview = out.path;
  std::filesystem::create_directories((root_ / out.path).parent_path());
  write_image(root_ / out.path, image, glm::dvec3(0));
  return out;
}

}  // namespace volumark
