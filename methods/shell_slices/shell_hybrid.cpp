// lensch2002, section 5: the host classifies and names edges, the vertex program meets them with the plane.
#include "methods/shell_slices/shell_slicer.h"
#include "methods/shell_slices/shell_slices.h"
#include "methods/shell_slices/shell_twin.h"
#include "programs/shell_hybrid_lit_vert.h"
#include "programs/shell_hybrid_vert.h"

namespace volumark {
namespace {

const Flag kShareEdges{"share_edges",
                       "on: prisms that meet at an edge, with the same texture coordinates, use one fake vertex; off: "
                       "nine a prism",
                       true};

// What is uploaded for a corner of a section: its edge and its plane, both exact as floats.
struct EdgeOnPlane {
  float edge, plane;
};

class PreparedHybrid final : public ShellSlicer {
 public:
  PreparedHybrid(const Scene& scene, const Values& values, Device& device)
      : ShellSlicer(scene, values, device,
                    {"shell_hybrid",
                     &programs::shell_hybrid_vert,
                     &programs::shell_hybrid_lit_vert,
                     &shell_hybrid_twin,
                     storage_bindings({5}, scene),
                     {},
                     {{sizeof(EdgeOnPlane), false, {{0, 2, 0}}}}}),
        table_(edge_table(shell_, kShareEdges(values))),
        edge_buffer_(device, "fake vertices"),
        cotangent_buffer_(device, "cotangents of fake vertices"),
        vertex_buffer_(device, "edges on planes"),
        index_buffer_(device, "section triangles") {
    if (!table_.edges.empty()) edges_ = edge_buffer_.upload(bytes_of(table_.edges));
    if (!table_.cotangents.empty()) cotangents_ = cotangent_buffer_.upload(bytes_of(table_.cotangents));
  }

 private:
  void classify(const ShellFrame& frame) override;
  std::vector<DrawDesc> upload(const ShellFrame&) override;
  void count(Counters& counters) const override {
    counters["vertices"] = static_cast<int64_t>(vertices_.size());
    counters["vertex_bytes"] = static_cast<int64_t>(table_.edges.size() * sizeof(FakeVertex));
    counters["fake_vertices"] = static_cast<int64_t>(table_.edges.size());
    counters["frame_bytes"] = static_cast<int64_t>(vertices_.size() * sizeof(EdgeOnPlane));
    sections_.put(counters);
  }

  EdgeTable table_;
  GrowingBuffer edge_buffer_, cotangent_buffer_, vertex_buffer_, index_buffer_;
  Buffer edges_, cotangents_;
  std::vector<EdgeOnPlane> vertices_;
  std::vector<uint32_t> indices_;
  std::vector<int> last_plane_;        // of each edge: the last plane that it was met with,
  std::vector<uint32_t> last_vertex_;  // and as which vertex: sections that share the edge use it
  SectionCounts sections_;
};

void PreparedHybrid::classify(const ShellFrame& frame) {
  vertices_.clear();
  indices_.clear();
  sections_ = {};
  last_plane_.assign(table_.edges.size(), -1);
  last_vertex_.resize(table_.edges.size());
  corner_depths(shell_, frame, depths_);
  const auto vertex_of = [&](uint32_t edge, int plane) {
    if (last_plane_[edge] != plane) {
      last_plane_[edge] = plane;
      last_vertex_[edge] = static_cast<uint32_t>(vertices_.size());
      vertices_.push_back({static_cast<float>(edge), static_cast<float>(plane)});
    }
    return last_vertex_[edge];
  };
  tests_ = pairs_.visit(shell_, frame, depths_, reject_, [&](int plane, uint32_t number) {
    const Section& section = kSections[sides_of(depths_, shell_.prisms[number], static_cast<float>(plane))];
    if (section.corners == 0) return;
    const std::array<uint32_t, 9>& edges = table_.of_prism[number];
    add_fan(
        section, [&](uint32_t k) { return vertex_of(edges[section.edges[k]], plane); }, indices_);
    sections_.add(section);
  });
}

std::vector<DrawDesc> PreparedHybrid::upload(const ShellFrame&) {
  if (indices_.empty()) return {};
  DrawDesc draw;
  draw.vertex_buffers = {vertex_buffer_.upload(bytes_of(vertices_))};
  draw.index_buffer = index_buffer_.upload(bytes_of(indices_));
  draw.bindings = {bind_storage(5, edges_)};
  if (lit_) draw.bindings.push_back(bind_storage(7, cotangents_));
  draw.count = static_cast<uint32_t>(indices_.size());
  return {draw};
}

class ShellHybrid final : public Method {
 public:
  const MethodInfo& info() const override {
    static const MethodInfo info{
        .name = "shell_hybrid",
        .title = "Shell prisms cut by planes across the view, classified on the host, cut in the vertex program",
        .paper = "lensch2002",
        .parameters = shell_parameter_list({kShareEdges.info()}),
        .effects = {"lighting"},
        .displays = {Display::Shell}};
    return info;
  }
  std::optional<std::string> unsupported(const Scene& scene, const Values&, const BackendInfo& backend) const override {
    // Numbers of edges are floats in the program.
    if (scene.shell && scene.shell->prisms() * kPrismEdges >= (size_t{1} << 24)) return "more than 2^24 edges";
    return shell_unsupported(scene, kPrismEdges * (scene.effects.lighting ? 2 * sizeof(glm::mat3) : sizeof(FakeVertex)),
                             backend);
  }
  std::unique_ptr<PreparedMethod> prepare(const Scene& scene, const Values& values, Device& device) const override {
    return std::make_unique<PreparedHybrid>(scene, values, device);
  }
  Format target_format(const Values& values) const override { return target_format_of(values); }
};

}  // namespace

const Method& shell_hybrid() {
  static const ShellHybrid method;
  return method;
}

}  // namespace volumark
