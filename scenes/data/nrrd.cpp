#include "scenes/data/nrrd.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <optional>
#include <string_view>

#include "scenes/data/byte_source.h"
#include "scenes/data/orientation.h"
#include "scenes/errors.h"
#include "scenes/nearest.h"

namespace volumark {
namespace {

enum class Use { Read, Ignored };  // Ignored: says nothing about the samples or where they are

const std::map<std::string, Use>& known_fields() {
  static const std::map<std::string, Use> fields = {{"type", Use::Read},
                                                    {"dimension", Use::Read},
                                                    {"sizes", Use::Read},
                                                    {"endian", Use::Read},
                                                    {"encoding", Use::Read},
                                                    {"spacings", Use::Read},
                                                    {"space directions", Use::Read},
                                                    {"space origin", Use::Read},
                                                    {"space", Use::Read},
                                                    {"space dimension", Use::Read},
                                                    {"data file", Use::Read},
                                                    {"byte skip", Use::Read},
                                                    {"line skip", Use::Read},
                                                    {"kinds", Use::Read},
                                                    {"content", Use::Ignored},
                                                    {"centers", Use::Ignored},
                                                    {"thicknesses", Use::Ignored},
                                                    {"labels", Use::Ignored},
                                                    {"units", Use::Ignored},
                                                    {"space units", Use::Ignored},
                                                    {"sample units", Use::Ignored},
                                                    {"min", Use::Ignored},
                                                    {"max", Use::Ignored},
                                                    {"old min", Use::Ignored},
                                                    {"old max", Use::Ignored},
                                                    {"number", Use::Ignored},
                                                    {"measurement frame", Use::Ignored}};
  return fields;
}

std::string trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.remove_suffix(1);
  return std::string(text);
}

std::string lowered(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// Spellings that the format allows for one field.
std::string canonical_field(std::string name) {
  name = lowered(std::move(name));
  static const std::map<std::string, std::string> other = {
      {"datafile", "data file"}, {"byteskip", "byte skip"}, {"lineskip", "line skip"},      {"centerings", "centers"},
      {"oldmin", "old min"},     {"oldmax", "old max"},     {"sampleunits", "sample units"}};
  const auto it = other.find(name);
  return it == other.end() ? name : it->second;
}

class NrrdHeader {
 public:
  NrrdHeader(std::span<const std::byte> file, const std::string& what) : file_(file), what_(what) {
    const std::string magic = next_line();
    if (!magic.starts_with("NRRD000") || magic.size() != 8 || magic[7] < '1' || magic[7] > '5') {
      fail("not a NRRD file (expected NRRD0001 to NRRD0005 in the first line)");
    }
    while (at_ < file_.size()) {
      const std::string line = next_line();
      if (line.empty()) break;  // the samples follow
      if (line[0] != '#') add_field(line);
    }
  }

  [[noreturn]] void fail(const std::string& message) const { throw DataError(what_ + ": " + message); }

  std::optional<std::string> find(const std::string& field) const {
    const auto it = fields_.find(field);
    return it == fields_.end() ? std::nullopt : std::optional(it->second);
  }
  std::string get(const std::string& field) const {
    if (const auto value = find(field)) return *value;
    fail(fmt::format("missing field \"{}\"", field));
  }

  // Numbers separated by blanks, commas and parentheses; "none" is refused where a number must be.
  std::vector<double> numbers(const std::string& field, size_t count) const {
    const std::string text = get(field);
    std::vector<double> values;
    for (size_t i = 0; i < text.size();) {
      if (std::string_view(" \t,()").find(text[i]) != std::string_view::npos) {
        ++i;
        continue;
      }
      double value = 0;
      const auto [end, error] = std::from_chars(text.data() + i, text.data() + text.size(), value);
      if (error != std::errc()) fail(fmt::format("{}: expected {} numbers, found \"{}\"", field, count, text));
      values.push_back(value);
      i = static_cast<size_t>(end - text.data());
    }
    if (values.size() != count) fail(fmt::format("{}: expected {} numbers, found \"{}\"", field, count, text));
    return values;
  }

  std::span<const std::byte> rest() const { return file_.subspan(at_); }

 private:
  std::string next_line() {
    std::string line;
    while (at_ < file_.size()) {
      const char c = static_cast<char>(file_[at_++]);
      if (c == '\n') break;
      line += c;
      if (line.size() > 65536) fail("a header line is longer than 65536 bytes");
    }
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
  }

  void add_field(const std::string& line) {
    const size_t colon = line.find(':');
    if (colon == std::string::npos) fail(fmt::format("header line without a colon: \"{}\"", line.substr(0, 80)));
    if (line.compare(colon, 2, ":=") == 0) return;  // a key of the user's own
    const std::string name = canonical_field(line.substr(0, colon));
    if (!known_fields().contains(name)) {
      std::vector<std::string> names;
      for (const auto& [field, use] : known_fields()) names.push_back(field);
      fail(fmt::format("field \"{}\" is not supported{}", name.substr(0, 80), did_you_mean(name, names)));
    }
    if (!fields_.emplace(name, trimmed(std::string_view(line).substr(colon + 1))).second) {
      fail(fmt::format("field \"{}\" appears twice", name));
    }
  }

  std::span<const std::byte> file_;
  size_t at_ = 0;
  std::map<std::string, std::string> fields_;
  const std::string& what_;
};

bool type_is(const NrrdHeader& header, std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), lowered(header.get("type"))) != names.end();
}

bool signed_bytes(const NrrdHeader& header) { return type_is(header, {"signed char", "int8", "int8_t"}); }

VoxelType parse_type(const NrrdHeader& header) {
  const auto is = [&](std::initializer_list<const char*> names) { return type_is(header, names); };
  if (signed_bytes(header)) return VoxelType::U8;
  if (is({"uchar", "unsigned char", "uint8", "uint8_t"})) return VoxelType::U8;
  if (is({"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"})) return VoxelType::U16;
  if (is({"short", "short int", "signed short", "signed short int", "int16", "int16_t"})) return VoxelType::I16;
  if (is({"float"})) return VoxelType::F32;
  header.fail(fmt::format("type \"{}\" is not supported; expected uint8, int8, uint16, int16 or float",
                          lowered(header.get("type"))));
}

glm::dvec3 parse_sizes(const NrrdHeader& header) {
  if (const auto dimension = header.numbers("dimension", 1)[0]; dimension != 3) {
    header.fail(fmt::format("dimension {} is not supported; expected 3", dimension));
  }
  const std::vector<double> sizes = header.numbers("sizes", 3);
  for (const double n : sizes) {
    if (n != static_cast<double>(static_cast<int64_t>(std::clamp(n, -1e15, 1e15)))) {
      header.fail(fmt::format("sizes: expected whole numbers, found {}", n));
    }
  }
  return {sizes[0], sizes[1], sizes[2]};
}

// From the file's anatomical space to RAS (right, anterior, superior positive).
glm::dvec3 signs_to_ras(const NrrdHeader& header) {
  const auto space = header.find("space");
  if (!space) return glm::dvec3(1);
  const std::string name = lowered(*space);
  if (name == "right-anterior-superior" || name == "ras") return {1, 1, 1};
  if (name == "left-anterior-superior" || name == "las") return {-1, 1, 1};
  if (name == "left-posterior-superior" || name == "lps") return {-1, -1, 1};
  if (name == "scanner-xyz" || name == "3d-right-handed" || name == "3d-left-handed") return {1, 1, 1};
  header.fail(fmt::format("space \"{}\" is not supported", *space));
}

void orient(Volume& volume, const NrrdHeader& header, const std::string& what) {
  if (const auto dimension = header.find("space dimension"); dimension && *dimension != "3") {
    header.fail(fmt::format("space dimension {} is not supported; expected 3", *dimension));
  }
  const glm::dvec3 signs = signs_to_ras(header);
  glm::dmat3 steps(1);
  if (header.find("space directions")) {
    if (header.find("spacings")) header.fail("\"spacings\" and \"space directions\" exclude each other");
    const std::vector<double> d = header.numbers("space directions", 9);
    for (int a = 0; a < 3; ++a) {
      const size_t at = 3 * static_cast<size_t>(a);
      steps[a] = glm::dvec3(d[at], d[at + 1], d[at + 2]) * signs;
    }
  } else if (header.find("spacings")) {
    const std::vector<double> s = header.numbers("spacings", 3);
    for (int a = 0; a < 3; ++a) steps[a] *= s[static_cast<size_t>(a)] * signs[a];
  }
  for (int a = 0; a < 3; ++a) {
    if (!header.find("space directions") && !(steps[a][a] * signs[a] > 0)) {
      header.fail(fmt::format("spacings: expected numbers > 0, found {}", steps[a][a] * signs[a]));
    }
  }
  set_steps(volume, steps, what);
  if (header.find("space origin")) {
    const std::vector<double> o = header.numbers("space origin", 3);
    volume.origin = glm::dvec3(o[0], o[1], o[2]) * signs;
    for (int a = 0; a < 3; ++a) {
      if (!(std::abs(volume.origin[a]) < 1e30)) header.fail("space origin: expected finite numbers");
    }
  } else {
    centre_at_origin(volume);
  }
}

// Every axis must be one of space; "kinds" can say otherwise (vectors, colours, lists).
void check_kinds(const NrrdHeader& header) {
  const std::string kinds = header.find("kinds").value_or("");
  for (size_t i = 0; i < kinds.size();) {
    const size_t end = std::min(kinds.find_first_of(" \t", i), kinds.size());
    const std::string kind = lowered(kinds.substr(i, end - i));
    if (!kind.empty() && kind != "domain" && kind != "space" && kind != "???" && kind != "none") {
      header.fail(fmt::format("kinds: \"{}\" is not supported; expected domain or space", kind));
    }
    i = end + 1;
  }
}

bool gzip_encoding(const NrrdHeader& header) {
  const std::string encoding = lowered(header.get("encoding"));
  if (encoding == "gzip" || encoding == "gz") return true;
  if (encoding != "raw") header.fail(fmt::format("encoding \"{}\" is not supported; expected raw or gzip", encoding));
  return false;
}

bool big_endian(const NrrdHeader& header, VoxelType type) {
  if (type == VoxelType::U8) return false;
  const std::string endian = lowered(header.get("endian"));
  if (endian != "little" && endian != "big") header.fail(fmt::format("endian \"{}\": expected little or big", endian));
  return endian == "big";
}

}  // namespace

Volume read_nrrd(std::span<const std::byte> file, const ReadBeside& beside, NonFinite non_finite,
                 const std::string& what) {
  const NrrdHeader header(file, what);
  Volume volume;
  volume.type = parse_type(header);
  const glm::dvec3 size = parse_sizes(header);
  checked_bytes(size, volume.type, what);
  volume.size = glm::ivec3(size);
  check_kinds(header);
  orient(volume, header, what);

  const bool gzip = gzip_encoding(header);
  const bool swap = big_endian(header, volume.type);
  if (header.find("line skip").value_or("0") != "0") header.fail("line skip other than 0 is not supported");
  const double byte_skip = header.find("byte skip") ? header.numbers("byte skip", 1)[0] : 0;
  if (!(byte_skip >= 0) || byte_skip > 1e9 || byte_skip != static_cast<double>(static_cast<int64_t>(byte_skip))) {
    header.fail(fmt::format("byte skip {} is not supported; expected a whole number >= 0", byte_skip));
  }
  std::vector<std::byte> detached;
  std::span<const std::byte> data = header.rest();
  if (const auto name = header.find("data file")) {
    if (name->starts_with("LIST") || name->find('%') != std::string::npos) {
      header.fail("data file: only a single file is supported");
    }
    detached = beside(*name);
    data = detached;
  }
  ByteSource source(data, gzip, what);
  source.skip(static_cast<size_t>(byte_skip));
  volume.voxels = source.read_voxels(size, volume.type, swap);
  if (signed_bytes(header)) from_signed_bytes(volume);
  finish_volume(volume, non_finite, what);
  return volume;
}

}  // namespace volumark
