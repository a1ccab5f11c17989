#include "scenes/data/ply.h"

#include <fmt/format.h>

#include <cmath>

#include "scenes/data/ply_stream.h"
#include "scenes/errors.h"

namespace volumark {
namespace {

int find_property(const PlyElement& element, std::initializer_list<const char*> names, bool list) {
  for (const char* name : names) {
    for (size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.name == name && property.count_type.has_value() == list) return static_cast<int>(i);
    }
  }
  return -1;
}

// What an element's instance holds: of each property its value, or its list.
using Row = std::vector<std::vector<double>>;

void read_row(PlyStream& in, const PlyElement& element, Row& row) {
  row.resize(element.properties.size());
  for (size_t i = 0; i < row.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    row[i].clear();
    size_t count = 1;
    if (property.count_type) {
      const double stated = in.number(*property.count_type);
      if (!(stated >= 0) || stated != std::floor(stated)) in.fail(fmt::format("a list of {} entries", stated));
      count = static_cast<size_t>(stated);
    }
    // Grows with what is there, not with what the count claims.
    for (size_t n = 0; n < count; ++n) row[i].push_back(in.number(property.type));
  }
}

class PlyMesh {
 public:
  explicit PlyMesh(PlyStream& in) : in_(in) {}

  void vertices(const PlyElement& element) {
    const int x = find_property(element, {"x"}, false), y = find_property(element, {"y"}, false),
              z = find_property(element, {"z"}, false);
    if (x < 0 || y < 0 || z < 0) in_.fail("the vertices have no x, y and z");
    const int nx = find_property(element, {"nx"}, false), ny = find_property(element, {"ny"}, false),
              nz = find_property(element, {"nz"}, false);
    const int u = find_property(element, {"u", "s", "texture_u"}, false),
              v = find_property(element, {"v", "t", "texture_v"}, false);
    Row row;
    const auto value = [&row](int property) { return row[static_cast<size_t>(property)][0]; };
    for (size_t i = 0; i < element.count; ++i) {
      in_.begin_row(element.name, i);
      read_row(in_, element, row);
      mesh_.positions.push_back(finite({value(x), value(y), value(z)}, "position"));
      if (nx >= 0 && ny >= 0 && nz >= 0) {
        mesh_.normals.push_back(finite({value(nx), value(ny), value(nz)}, "normal"));
      }
      if (u >= 0 && v >= 0) uv_.emplace_back(finite({value(u), value(v), 0}, "texture coordinate"));
    }
    in_.end_element();
  }

  void faces(const PlyElement& element) {
    const int indices = find_property(element, {"vertex_indices", "vertex_index"}, true);
    if (indices < 0) in_.fail("the faces have no list vertex_indices");
    const int texcoord = find_property(element, {"texcoord"}, true);
    Row row;
    for (size_t i = 0; i < element.count; ++i) {
      in_.begin_row(element.name, i);
      read_row(in_, element, row);
      const std::vector<double>& corners = row[static_cast<size_t>(indices)];
      if (corners.size() < 3) in_.fail(fmt::format("a face with {} corners", corners.size()));
      for (const double corner : corners) check_index(corner);
      const std::vector<double>* own = texcoord < 0 ? nullptr : &row[static_cast<size_t>(texcoord)];
      if (own != nullptr && own->size() != 2 * corners.size()) {
        in_.fail(fmt::format("{} texture coordinates for {} corners", own->size(), corners.size()));
      }
      for (size_t c = 1; c + 1 < corners.size(); ++c) add(corners, own, {0, c, c + 1});
    }
    in_.end_element();
  }

  void skip(const PlyElement& element) {
    Row row;
    for (size_t i = 0; i < element.count; ++i) {
      in_.begin_row(element.name, i);
      read_row(in_, element, row);
    }
    in_.end_element();
  }

  Mesh take() { return std::move(mesh_); }

 private:
  glm::dvec3 finite(const glm::dvec3& p, const char* what) const {
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) return p;
    in_.fail(fmt::format("a {} of ({}, {}, {})", what, p.x, p.y, p.z));
  }

  void check_index(double index) const {
    if (index >= 0 && index < static_cast<double>(mesh_.positions.size()) && index == std::floor(index)) return;
    in_.fail(fmt::format("index {} of a vertex: there are {}", index, mesh_.positions.size()));
  }

  void add(const std::vector<double>& corners, const std::vector<double>* own, const std::array<size_t, 3>& which) {
    std::array<uint32_t, 3> triangle;
    std::array<glm::dvec2, 3> uv;
    for (size_t i = 0; i < 3; ++i) {
      triangle[i] = static_cast<uint32_t>(corners[which[i]]);
      if (own != nullptr) {
        uv[i] = finite({(*own)[2 * which[i]], (*own)[2 * which[i] + 1], 0}, "texture coordinate");
      } else if (!uv_.empty()) {
        uv[i] = uv_[triangle[i]];
      }
    }
    mesh_.triangles.push_back(triangle);
    if (own != nullptr || !uv_.empty()) mesh_.texture.push_back(uv);
  }

  PlyStream& in_;
  Mesh mesh_;
  std::vector<glm::dvec2> uv_;
};

}  // namespace

Mesh read_ply(std::string_view file, const std::string& name) {
  PlyStream in(file, name);
  const std::vector<PlyElement> elements = in.read_header();
  PlyMesh mesh(in);
  bool vertices = false, faces = false;
  for (const PlyElement& element : elements) {
    const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
    if ((is_vertex && vertices) || (is_face && faces)) in.fail("the element " + element.name + " is there twice");
    if (is_face && !vertices) in.fail("the faces come before the vertices");
    if (is_vertex) mesh.vertices(element);
    if (is_face) mesh.faces(element);
    if (!is_vertex && !is_face) mesh.skip(element);
    vertices |= is_vertex;
    faces |= is_face;
  }
  if (!vertices || !faces) in.fail("expected the elements vertex and face");
  return mesh.take();
}

}  // namespace volumark
