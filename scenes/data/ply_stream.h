// The header of a PLY file and its numbers one after the other, in any of its three formats.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace volumark {

enum class PlyType : uint8_t { I8, U8, I16, U16, I32, U32, F32, F64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::F32;        // of the value, or of a list's entries
  std::optional<PlyType> count_type;  // of a list's length; none: a single value
};

struct PlyElement {
  std::string name;
  size_t count = 0;
  std::vector<PlyProperty> properties;
};

class PlyStream {
 public:
  PlyStream(std::string_view file, const std::string& name) : rest_(file), name_(name) {}

  std::vector<PlyElement> read_header();

  // The next instance of an element: in ASCII the next line that is not empty.
  void begin_row(const std::string& element, size_t index);
  void end_element();
  // The next number of the row, as the file has it; whole where the type is whole. Throws DataError at the end of the
  // file (in ASCII: of the line), and in ASCII for what is no number of the type.
  double number(PlyType type);

  // DataError with the place that was reached last.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  enum class Format : uint8_t { Ascii, Little, Big };
  std::string_view next_line();
  std::string_view header_word(std::string_view& line) const;
  PlyType header_type(std::string_view word) const;
  PlyProperty header_property(std::string_view line) const;

  std::string_view rest_, row_;
  const std::string& name_;
  Format format_ = Format::Ascii;
  size_t line_ = 0;
  std::string element_;  // of the row that is being read
  size_t index_ = 0;
};

}  // namespace volumark
