#include "scenes/data/ply_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "scenes/data/text_numbers.h"
#include "scenes/errors.h"

namespace volumark {
namespace {

struct TypeName {
  const char *name, *other;
  PlyType type;
};
constexpr TypeName kTypes[] = {
    {"char", "int8", PlyType::I8},      {"uchar", "uint8", PlyType::U8},     {"short", "int16", PlyType::I16},
    {"ushort", "uint16", PlyType::U16}, {"int", "int32", PlyType::I32},      {"uint", "uint32", PlyType::U32},
    {"float", "float32", PlyType::F32}, {"double", "float64", PlyType::F64},
};

size_t bytes_of(PlyType type) {
  constexpr size_t kBytes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<size_t>(type)];
}

template <typename T>
double stored(std::string_view bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T));
  return static_cast<double>(value);
}

double decoded(std::string_view bytes, PlyType type) {
  switch (type) {
    case PlyType::I8:
      return stored<int8_t>(bytes);
    case PlyType::U8:
      return stored<uint8_t>(bytes);
    case PlyType::I16:
      return stored<int16_t>(bytes);
    case PlyType::U16:
      return stored<uint16_t>(bytes);
    case PlyType::I32:
      return stored<int32_t>(bytes);
    case PlyType::U32:
      return stored<uint32_t>(bytes);
    case PlyType::F32:
      return stored<float>(bytes);
    case PlyType::F64:
      return stored<double>(bytes);
  }
  return 0;
}

template <typename T>
bool fits(double value) {
  return value >= static_cast<double>(std::numeric_limits<T>::min()) &&
         value <= static_cast<double>(std::numeric_limits<T>::max()) && value == std::floor(value);
}

bool is_of(double value, PlyType type) {
  switch (type) {
    case PlyType::I8:
      return fits<int8_t>(value);
    case PlyType::U8:
      return fits<uint8_t>(value);
    case PlyType::I16:
      return fits<int16_t>(value);
    case PlyType::U16:
      return fits<uint16_t>(value);
    case PlyType::I32:
      return fits<int32_t>(value);
    case PlyType::U32:
      return fits<uint32_t>(value);
    case PlyType::F32:
    case PlyType::F64:
      return true;
  }
  return false;
}

}  // namespace

void PlyStream::fail(const std::string& message) const {
  if (element_.empty() || format_ == Format::Ascii) throw DataError(fmt::format("{}:{}: {}", name_, line_, message));
  throw DataError(fmt::format("{}: {} {}: {}", name_, element_, index_, message));
}

std::string_view PlyStream::next_line() {
  if (rest_.empty()) fail("the file ends too early");
  const size_t end = std::min(rest_.find('\n'), rest_.size());
  std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  ++line_;
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  return line;
}

std::string_view PlyStream::header_word(std::string_view& line) const {
  const std::string_view word = take_word(line);
  if (word.empty()) fail("expected a further word in the header, found the end of the line");
  return word;
}

PlyType PlyStream::header_type(std::string_view word) const {
  for (const TypeName& type : kTypes) {
    if (word == type.name || word == type.other) return type.type;
  }
  fail(fmt::format("unknown type \"{}\"", word));
}

PlyProperty PlyStream::header_property(std::string_view line) const {
  PlyProperty property;
  std::string_view word = header_word(line);
  if (word == "list") {
    property.count_type = header_type(header_word(line));
    if (*property.count_type == PlyType::F32 || *property.count_type == PlyType::F64) {
      fail("the length of a list is a whole number");
    }
    word = header_word(line);
  }
  property.type = header_type(word);
  property.name = header_word(line);
  return property;
}

std::vector<PlyElement> PlyStream::read_header() {
  if (next_line() != "ply") fail("expected \"ply\": this is no PLY file");
  std::vector<PlyElement> elements;
  bool format = false;
  for (;;) {
    std::string_view line = next_line();
    const std::string_view key = take_word(line);
    if (key == "end_header") break;
    if (key.empty() || key == "comment" || key == "obj_info") continue;
    if (key == "format") {
      const std::string_view name = header_word(line), version = header_word(line);
      if (version != "1.0") fail(fmt::format("expected version 1.0, found \"{}\"", version));
      if (name != "ascii" && name != "binary_little_endian" && name != "binary_big_endian") {
        fail(fmt::format("unknown format \"{}\"", name));
      }
      format_ = name == "ascii" ? Format::Ascii : name == "binary_big_endian" ? Format::Big : Format::Little;
      format = true;
    } else if (key == "element") {
      PlyElement element;
      element.name = header_word(line);
      const std::string_view count = header_word(line);
      const auto value = number_of<uint64_t>(count);
      if (!value || *value > (uint64_t{1} << 32))
        fail(fmt::format("expected a number of elements, found \"{}\"", count));
      element.count = *value;
      elements.push_back(std::move(element));
    } else if (key == "property") {
      if (elements.empty()) fail("a property before the first element");
      elements.back().properties.push_back(header_property(line));
    } else {
      fail(fmt::format("unknown word \"{}\" in the header", key));
    }
  }
  if (!format) fail("the header states no format");
  for (const PlyElement& element : elements) {
    if (element.properties.empty() && element.count > 0) fail("the element " + element.name + " has no property");
  }
  return elements;
}

void PlyStream::begin_row(const std::string& element, size_t index) {
  element_ = element;
  index_ = index;
  if (format_ != Format::Ascii) return;
  if (!row_.empty() && !take_word(row_).empty()) fail("the line goes on after its last number");
  do row_ = next_line();
  while (row_.empty());
}

void PlyStream::end_element() {
  if (!row_.empty() && !take_word(row_).empty()) fail("the line goes on after its last number");
  row_ = {};
}

double PlyStream::number(PlyType type) {
  if (format_ == Format::Ascii) {
    const std::string_view word = take_word(row_);
    if (word.empty()) fail("expected a number, found the end of the line");
    const auto value = number_of<double>(word);
    if (!value || !is_of(*value, type)) fail(fmt::format("expected a number of the stated type, found \"{}\"", word));
    return *value;
  }
  const size_t size = bytes_of(type);
  if (rest_.size() < size) fail("the file ends too early");
  std::array<char, 8> bytes{};
  std::copy_n(rest_.begin(), size, bytes.begin());
  rest_.remove_prefix(size);
  if ((format_ == Format::Big) != (std::endian::native == std::endian::big)) {
    std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  }
  return decoded({bytes.data(), size}, type);
}

}  // namespace volumark
