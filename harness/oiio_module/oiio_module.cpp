#include "harness/oiio_module/oiio_module.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

constexpr int kLargest = 1 << 15;

int fail(char* error, size_t size, const std::string& message) {
  std::snprintf(error, size, "%s", message.c_str());
  return 1;
}

unsigned char srgb8(float linear) {
  const double v = linear > 0 ? std::min(1.0, static_cast<double>(linear)) : 0.0;  // NaN becomes 0
  const double s = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  return static_cast<unsigned char>(std::lround(s * 255));
}

float linear_of(float s) { return s <= 0.04045F ? s / 12.92F : std::pow((s + 0.055F) / 1.055F, 2.4F); }

int write(const char* path, const char* format, int width, int height, const float* rgba, bool as_srgb8,
          const char* note, char* error, size_t error_size) {
  auto out = OIIO::ImageOutput::create(format);
  if (!out) return fail(error, error_size, OIIO::geterror());
  const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
  OIIO::ImageSpec spec(width, height, as_srgb8 ? 3 : 4, as_srgb8 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT);
  if (*note != '\0') spec.attribute("ImageDescription", note);
  std::vector<unsigned char> bytes;
  if (as_srgb8) {
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("png:compressionLevel", 4);
    bytes.resize(pixels * 3);
    for (size_t i = 0; i < pixels; ++i)
      for (size_t c = 0; c < 3; ++c) bytes[i * 3 + c] = srgb8(rgba[i * 4 + c]);
  } else {
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("compression", "zip");
  }
  if (!out->open(path, spec)) return fail(error, error_size, out->geterror());
  const bool written =
      as_srgb8 ? out->write_image(OIIO::TypeDesc::UINT8, bytes.data()) : out->write_image(OIIO::TypeDesc::FLOAT, rgba);
  const bool closed = out->close();
  return written && closed ? 0 : fail(error, error_size, out->geterror());
}

int read(const char* path, int* width, int* height, float** rgba, char* error, size_t error_size) {
  auto in = OIIO::ImageInput::open(path);
  if (!in) return fail(error, error_size, OIIO::geterror());
  const OIIO::ImageSpec& spec = in->spec();
  if (spec.width < 1 || spec.height < 1 || spec.width > kLargest || spec.height > kLargest || spec.depth > 1)
    return fail(error, error_size, "not a two-dimensional image of at most 32768 x 32768 pixels");
  const auto channels = static_cast<size_t>(spec.nchannels);
  if (channels < 1 || channels > 4) return fail(error, error_size, "expected 1 to 4 channels");
  const size_t pixels = static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height);
  std::vector<float> data(pixels * channels);
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, data.data()))
    return fail(error, error_size, in->geterror());
  const bool encoded = !spec.format.is_floating_point();
  const bool grey = channels <= 2, alpha = channels == 2 || channels == 4;
  auto* out = static_cast<float*>(std::malloc(pixels * 4 * sizeof(float)));
  if (out == nullptr) return fail(error, error_size, "out of memory");
  for (size_t i = 0; i < pixels; ++i) {
    for (size_t c = 0; c < 3; ++c) {
      const float value = data[i * channels + (grey ? 0 : c)];
      out[i * 4 + c] = encoded ? linear_of(value) : value;
    }
    out[i * 4 + 3] = alpha ? data[i * channels + channels - 1] : 1.0F;
  }
  *width = spec.width;
  *height = spec.height;
  *rgba = out;
  return 0;
}

}  // namespace

// Nothing may be thrown through a C interface.
extern "C" int vm_oiio_write(const char* path, const char* format, int width, int height, const float* rgba, int srgb8,
                             const char* note, char* error, size_t error_size) {
  try {
    return write(path, format, width, height, rgba, srgb8 != 0, note, error, error_size);
  } catch (const std::exception& e) {
    return fail(error, error_size, e.what());
  }
}

extern "C" int vm_oiio_read(const char* path, int* width, int* height, float** rgba, char* error, size_t error_size) {
  try {
    return read(path, width, height, rgba, error, error_size);
  } catch (const std::exception& e) {
    return fail(error, error_size, e.what());
  }
}

extern "C" void vm_oiio_free(float* rgba) { std::free(rgba); }
