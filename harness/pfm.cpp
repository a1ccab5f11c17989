#include "harness/pfm.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <sstream>

#include "harness/image_io.h"

namespace volumark {
namespace {

constexpr int kLargest = 1 << 15;

float load_float(const char* bytes, bool swap) {
  uint32_t word = 0;
  std::memcpy(&word, bytes, 4);
  return std::bit_cast<float>(swap ? __builtin_bswap32(word) : word);
}

}  // namespace

std::string encode_pfm(const Image& image) {
  std::ostringstream header;
  header << "PF\n"
         << image.width << ' ' << image.height << '\n'
         << (std::endian::native == std::endian::little ? -1 : 1) << ".0\n";
  std::string out = header.str();
  const size_t start = out.size();
  out.resize(start + static_cast<size_t>(image.width) * static_cast<size_t>(image.height) * 12);
  char* to = out.data() + start;
  for (int y = image.height - 1; y >= 0; --y)
    for (int x = 0; x < image.width; ++x, to += 12) std::memcpy(to, image.pixel(x, y), 12);
  return out;
}

Image decode_pfm(std::string_view text, const std::string& name) {
  std::istringstream header{std::string(text.substr(0, 128))};
  std::string magic;
  long width = 0, height = 0;
  double scale = 0;
  if (!(header >> magic >> width >> height >> scale) || magic != "PF" || scale == 0 || !std::isfinite(scale))
    throw ImageError(name + ": no portable float map: expected \"PF\", width, height and scale at its start");
  if (width < 1 || height < 1 || width > kLargest || height > kLargest)
    throw ImageError(name + ": " + std::to_string(width) + " x " + std::to_string(height) + " pixels: expected 1 to " +
                     std::to_string(kLargest) + " each");
  const auto start = static_cast<size_t>(header.tellg()) + 1;  // one white space after the scale
  const size_t wanted = static_cast<size_t>(width) * static_cast<size_t>(height) * 12;
  if (text.size() < start || text.size() - start != wanted)
    throw ImageError(name + ": truncated or too long: expected " + std::to_string(wanted) + " bytes of pixels, found " +
                     std::to_string(text.size() < start ? 0 : text.size() - start));
  const bool swap = (scale < 0) != (std::endian::native == std::endian::little);
  Image image(static_cast<int>(width), static_cast<int>(height));
  const char* from = text.data() + start;
  for (int y = image.height - 1; y >= 0; --y)
    for (int x = 0; x < image.width; ++x) {
      float* pixel = image.pixel(x, y);
      for (int c = 0; c < 3; ++c, from += 4) pixel[c] = load_float(from, swap);
      pixel[3] = 1;
    }
  return image;
}

}  // namespace volumark
