#include "scenes/data/obj.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string>

#include "scenes/data/text_numbers.h"
#include "scenes/errors.h"

namespace volumark {
namespace {

// A corner of a face: indices from 0; -1: not given.
struct Corner {
  int64_t position = -1, texture = -1, normal = -1;
};

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  Mesh read() {
    std::string joined;
    while (!text_.empty()) {
      std::string_view line = next_line();
      // A backslash at the end joins the next line.
      if (line.ends_with('\\')) {
        joined.clear();
        while (line.ends_with('\\')) {
          joined += line.substr(0, line.size() - 1);
          joined += ' ';
          if (text_.empty()) fail("the file ends after a backslash");
          line = next_line();
        }
        joined += line;
        line = joined;
      }
      statement(line);
    }
    return finished();
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw DataError(fmt::format("{}:{}: {}", name_, line_, message));
  }

  std::string_view next_line() {
    const size_t end = std::min(text_.find('\n'), text_.size());
    std::string_view line = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    ++line_;
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    return line;
  }

  void statement(std::string_view line) {
    line = line.substr(0, line.find('#'));
    const std::string_view kind = take_word(line);
    if (kind == "v") positions_.push_back(triple(line));
    if (kind == "vn") normals_.push_back(triple(line));
    if (kind == "vt") {
      const double u = number(line);
      std::string_view rest = line;
      // A texture of one dimension has u alone.
      textures_.emplace_back(u, take_word(rest).empty() ? 0 : number(line));
    }
    if (kind == "f") face(line);
  }

  double number(std::string_view& line) const {
    const std::string_view word = take_word(line);
    if (word.empty()) fail("expected a number, found the end of the line");
    const auto value = number_of<double>(word);
    if (!value || !std::isfinite(*value)) fail(fmt::format("expected a number, found \"{}\"", word));
    return *value;
  }

  glm::dvec3 triple(std::string_view& line) const {
    const double x = number(line), y = number(line);
    return {x, y, number(line)};
  }

  // "": not given.
  int64_t index(std::string_view word, size_t count, const char* what) const {
    if (word.empty()) return -1;
    const auto value = number_of<int64_t>(word);
    if (!value) fail(fmt::format("expected the index of a {}, found \"{}\"", what, word));
    const auto n = static_cast<int64_t>(count);
    if (*value == 0 || *value > n || *value < -n) {
      fail(fmt::format("index {} of a {}: there are {} so far", *value, what, count));
    }
    return *value > 0 ? *value - 1 : n + *value;
  }

  Corner corner(std::string_view word) const {
    std::string_view parts[3];
    for (size_t i = 0; i < 3; ++i) {
      const size_t slash = std::min(word.find('/'), word.size());
      parts[i] = word.substr(0, slash);
      word.remove_prefix(std::min(slash + 1, word.size()));
    }
    if (!word.empty() || parts[0].empty()) fail("expected a corner such as 1, 1/2, 1//3 or 1/2/3");
    return {index(parts[0], positions_.size(), "position"), index(parts[1], textures_.size(), "texture coordinate"),
            index(parts[2], normals_.size(), "normal")};
  }

  void face(std::string_view& line) {
    std::vector<Corner> corners;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line))
      corners.push_back(corner(word));
    if (corners.size() < 3) fail(fmt::format("a face with {} corners", corners.size()));
    for (size_t i = 1; i + 1 < corners.size(); ++i) faces_.push_back({corners[0], corners[i], corners[i + 1]});
  }

  Mesh finished() const {
    bool normals = !faces_.empty(), textures = !faces_.empty();
    for (const auto& face : faces_) {
      for (const Corner& c : face) {
        normals &= c.normal >= 0;
        textures &= c.texture >= 0;
      }
    }
    Mesh mesh;
    if (!normals) mesh.positions = positions_;
    std::map<std::pair<int64_t, int64_t>, uint32_t> split;  // (position, normal) -> position of the mesh
    for (const auto& face : faces_) {
      std::array<uint32_t, 3> triangle;
      std::array<glm::dvec2, 3> uv;
      for (size_t i = 0; i < 3; ++i) {
        const Corner& c = face[i];
        triangle[i] = static_cast<uint32_t>(c.position);
        if (normals) {
          const auto [it, added] = split.emplace(std::pair(c.position, c.normal), mesh.positions.size());
          triangle[i] = it->second;
          if (added) {
            mesh.positions.push_back(positions_[static_cast<size_t>(c.position)]);
            mesh.normals.push_back(normals_[static_cast<size_t>(c.normal)]);
          }
        }
        if (textures) uv[i] = textures_[static_cast<size_t>(c.texture)];
      }
      mesh.triangles.push_back(triangle);
      if (textures) mesh.texture.push_back(uv);
    }
    return mesh;
  }

  std::string_view text_;
  const std::string& name_;
  size_t line_ = 0;
  std::vector<glm::dvec3> positions_, normals_;
  std::vector<glm::dvec2> textures_;
  std::vector<std::array<Corner, 3>> faces_;
};

}  // namespace

Mesh read_obj(std::string_view text, const std::string& name) { return ObjReader(text, name).read(); }

}  // namespace volumark
