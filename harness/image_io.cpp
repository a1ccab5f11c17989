#include "harness/image_io.h"

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <vector>

#include "harness/oiio_module/oiio_module.h"
#include "harness/paths.h"
#include "harness/pfm.h"
#include "reports/results.h"
#include "scenes/sha256.h"

namespace volumark {
namespace {

namespace fs = std::filesystem;

struct Module {
  decltype(&vm_oiio_write) write = nullptr;
  decltype(&vm_oiio_read) read = nullptr;
  decltype(&vm_oiio_free) free = nullptr;
  std::string missing;  // why it is not there
};

Module load_module() {
  Module module;
  std::string tried;
  for (const fs::path& folder : library_folders()) {
    const fs::path file = folder / "libvolumark_oiio.so";
    tried += (tried.empty() ? "" : ", ") + file.string();
    if (!fs::exists(file)) continue;
    void* handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) {
      module.missing = ::dlerror();
      return module;
    }
    module.write = reinterpret_cast<decltype(&vm_oiio_write)>(::dlsym(handle, "vm_oiio_write"));
    module.read = reinterpret_cast<decltype(&vm_oiio_read)>(::dlsym(handle, "vm_oiio_read"));
    module.free = reinterpret_cast<decltype(&vm_oiio_free)>(::dlsym(handle, "vm_oiio_free"));
    if (module.write == nullptr || module.read == nullptr || module.free == nullptr)
      module.missing = file.string() + ": not the module of this program";
    return module;
  }
  module.missing = "no OpenImageIO module (looked for " + tried + "); build with -DVM_OIIO=ON, or use .pfm";
  return module;
}

const Module& image_module() {
  static const Module module = load_module();
  return module;
}

const Module& need_module(const fs::path& file) {
  const Module& module = image_module();
  if (!module.missing.empty())
    throw ImageError(file.string() + ": " + file.extension().string() + " images: " + module.missing);
  return module;
}

std::string suffix_of(const fs::path& file) {
  std::string suffix = file.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(), [](unsigned char c) { return std::tolower(c); });
  if (suffix != ".pfm" && suffix != ".exr" && suffix != ".png")
    throw ImageError(file.string() + ": unknown image format '" + suffix + "': use .exr, .png or .pfm");
  return suffix;
}

Image over(const Image& image, const glm::dvec3& background) {
  Image out = image;
  for (size_t i = 0; i < out.rgba.size(); i += 4) {
    const double through = 1.0 - static_cast<double>(out.rgba[i + 3]);
    for (size_t c = 0; c < 3; ++c)
      out.rgba[i + c] += static_cast<float>(through * background[static_cast<glm::length_t>(c)]);
    out.rgba[i + 3] = 1;
  }
  return out;
}

void write_with_module(const fs::path& file, const std::string& suffix, const Image& image,
                       const glm::dvec3& background, const std::string& note) {
  const Module& module = need_module(file);
  const std::string temporary = file.string() + ".tmp" + std::to_string(::getpid()) + suffix;
  const bool png = suffix == ".png";
  const Image flat = png ? over(image, background) : Image();
  char error[512] = "";
  const float* pixels = png ? flat.rgba.data() : image.rgba.data();
  if (module.write(temporary.c_str(), suffix.c_str() + 1, image.width, image.height, pixels, png, note.c_str(), error,
                   sizeof error) != 0) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw ImageError(file.string() + ": cannot be written: " + error);
  }
  std::error_code failed;
  fs::rename(temporary, file, failed);
  if (failed) throw ImageError(file.string() + ": cannot be renamed into place: " + failed.message());
}

}  // namespace

bool has_image_module(std::string* why) {
  if (why != nullptr) *why = image_module().missing;
  return image_module().missing.empty();
}

void write_image(const fs::path& file, const Image& image, const glm::dvec3& background, const std::string& note) {
  const std::string suffix = suffix_of(file);
  if (image.width < 1 || image.height < 1) throw ImageError(file.string() + ": an image without pixels");
  if (suffix != ".pfm") {
    write_with_module(file, suffix, image, background, note);
    return;
  }
  try {
    write_file_atomically(file, encode_pfm(over(image, background)));
  } catch (const ResultsError& error) {
    throw ImageError(error.what());
  }
}

Image read_image(const fs::path& file) {
  const std::string suffix = suffix_of(file);
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw ImageError(file.string() + ": cannot be read: no such file, or no permission");
  if (suffix == ".pfm") {
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    return decode_pfm(text, file.string());
  }
  const Module& module = need_module(file);
  int width = 0, height = 0;
  float* pixels = nullptr;
  char error[512] = "";
  if (module.read(file.c_str(), &width, &height, &pixels, error, sizeof error) != 0)
    throw ImageError(file.string() + ": cannot be read: " + error);
  Image image(width, height);
  std::copy_n(pixels, image.rgba.size(), image.rgba.begin());
  module.free(pixels);
  return image;
}

std::string pixel_hash(const Image& image) {
  std::string bytes = std::to_string(image.width) + "x" + std::to_string(image.height) + ":";
  bytes.append(reinterpret_cast<const char*>(image.rgba.data()), image.rgba.size() * sizeof(float));
  return sha256_hex(std::string_view(bytes));
}

}  // namespace volumark
