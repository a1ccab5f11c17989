#include "harness/reference_cache.h"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "reports/results.h"
#include "scenes/sha256.h"

namespace volumark {
namespace {

// File: this header, the sha256 of the payload (64 characters), the payload: RGBA floats, then bounds.
struct Header {
  char magic[8];
  uint32_t format, version;
  char key[64];
  int32_t width, height;
  double max_bound;
  int64_t cells, pieces;
  uint32_t estimate, undecided;
};
constexpr char kMagic[8] = {'V', 'M', 'R', 'E', 'F', '\r', '\n', '\0'};
constexpr uint32_t kFormat = 1;  // of the file
constexpr size_t kHashSize = 64;
constexpr int kLargest = 1 << 15;

std::string text_of(const glm::dvec3& v) { return fmt::format("{:a},{:a},{:a}", v.x, v.y, v.z); }

size_t payload_size(const Header& header) {
  return static_cast<size_t>(header.width) * static_cast<size_t>(header.height) * 5 * sizeof(float);
}

}  // namespace

std::string reference_key(const Scene& scene, const View& view, int width, int height,
                          const ReferenceOptions& options) {
  // Hexadecimal floats: exact.
  return sha256_hex(fmt::format(
      "reference {} scene {} size {}x{} tolerance {:a} view {} {} {} {} {:a} {:a} {:a}", kReferenceVersion, scene.hash,
      width, height, options.tolerance, text_of(view.eye), text_of(view.target), text_of(view.up),
      view.perspective ? "perspective" : "orthographic", view.fov_y, view.half_height, view.near));
}

std::optional<Reference> ReferenceCache::load(const std::string& key) const {
  std::ifstream stream(file_of(key), std::ios::binary);
  if (!stream) return std::nullopt;
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  Header header{};
  if (bytes.size() < sizeof header + kHashSize) return std::nullopt;
  std::memcpy(&header, bytes.data(), sizeof header);
  if (std::memcmp(header.magic, kMagic, sizeof kMagic) != 0 || header.format != kFormat ||
      header.version != static_cast<uint32_t>(kReferenceVersion) || key.size() != sizeof header.key ||
      std::memcmp(header.key, key.data(), sizeof header.key) != 0 || header.width < 1 || header.height < 1 ||
      header.width > kLargest || header.height > kLargest)
    return std::nullopt;
  const std::string_view hash = std::string_view(bytes).substr(sizeof header, kHashSize);
  const std::string_view payload = std::string_view(bytes).substr(sizeof header + kHashSize);
  // The payload's hash covers the header too: a flipped bit in the bound is no better than one in a pixel.
  if (payload.size() != payload_size(header) ||
      hash != sha256_hex(bytes.substr(0, sizeof header) + std::string(payload)))
    return std::nullopt;
  Reference out;
  out.image = Image(header.width, header.height);
  out.bound.resize(out.image.rgba.size() / 4);
  const size_t pixels = out.image.rgba.size() * sizeof(float);
  std::memcpy(out.image.rgba.data(), payload.data(), pixels);
  std::memcpy(out.bound.data(), payload.data() + pixels, out.bound.size() * sizeof(float));
  out.max_bound = header.max_bound;
  out.estimate = header.estimate != 0;
  out.undecided = header.undecided;
  out.cells = header.cells;
  out.pieces = header.pieces;
  return out;
}

void ReferenceCache::store(const std::string& key, const Reference& reference) const {
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  header.format = kFormat;
  header.version = static_cast<uint32_t>(kReferenceVersion);
  std::memcpy(header.key, key.data(), std::min(key.size(), sizeof header.key));
  header.width = reference.image.width;
  header.height = reference.image.height;
  header.max_bound = reference.max_bound;
  header.cells = reference.cells;
  header.pieces = reference.pieces;
  header.estimate = reference.estimate ? 1 : 0;
  header.undecided = static_cast<uint32_t>(reference.undecided);
  const std::string head(reinterpret_cast<const char*>(&header), sizeof header);
  std::string payload(reinterpret_cast<const char*>(reference.image.rgba.data()),
                      reference.image.rgba.size() * sizeof(float));
  payload.append(reinterpret_cast<const char*>(reference.bound.data()), reference.bound.size() * sizeof(float));
  std::error_code ignored;
  std::filesystem::create_directories(folder_, ignored);
  write_file_atomically(file_of(key), head + sha256_hex(head + payload) + payload);
}

Reference ReferenceCache::get(const Scene& scene, const View& view, int width, int height,
                              const ReferenceOptions& options, bool* cached) const {
  const std::string key = reference_key(scene, view, width, height, options);
  if (cached != nullptr) *cached = true;
  if (auto found = load(key); found && found->image.width == width && found->image.height == height) return *found;
  if (cached != nullptr) *cached = false;
  Reference made = render_reference(scene, view, width, height, options);
  try {
    store(key, made);
  } catch (const ResultsError&) {  // a cache may be missing; the picture is there all the same
  }
  return made;
}

}  // namespace volumark
