// lensch2002, section 4: all intersections on the host.
#include "methods/shell_slices/shell_slicer.h"
#include "methods/shell_slices/shell_slices.h"
#include "methods/shell_slices/shell_twin.h"
#include "programs/shell_software_lit_vert.h"
#include "programs/shell_software_vert.h"

namespace volumark {
namespace {

struct SectionVertex {
  glm::vec2 ndc;
  glm::vec3 texture;
};

// What a lit corner has besides.
struct SectionLight {
  glm::vec3 box;
  glm::mat3 cotangent;
};

std::vector<VertexLayout> layouts(bool lit) {
  std::vector<VertexLayout> out = {
      {sizeof(SectionVertex), false, {{0, 2, 0}, {1, 3, offsetof(SectionVertex, texture)}}}};
  if (!lit) return out;
  constexpr uint32_t kColumns = offsetof(SectionLight, cotangent), kColumn = sizeof(glm::vec3);
  out.push_back({sizeof(SectionLight),
                 false,
                 {{2, 3, 0}, {3, 3, kColumns}, {4, 3, kColumns + kColumn}, {5, 3, kColumns + 2 * kColumn}}});
  return out;
}

class PreparedSoftware final : public ShellSlicer {
 public:
  PreparedSoftware(const Scene& scene, const Values& values, Device& device)
      : ShellSlicer(scene, values, device,
                    {"shell_software",
                     &programs::shell_software_vert,
                     &programs::shell_software_lit_vert,
                     &shell_software_twin,
                     {},
                     {},
                     layouts(scene.effects.lighting.has_value())}),
        vertex_buffer_(device, "section corners"),
        light_buffer_(device, "light at section corners"),
        index_buffer_(device, "section triangles") {}

 private:
  void classify(const ShellFrame& frame) override;
  std::vector<DrawDesc> upload(const ShellFrame&) override;
  void count(Counters& counters) const override {
    counters["vertices"] = static_cast<int64_t>(vertices_.size());
    counters["vertex_bytes"] =
        static_cast<int64_t>(vertices_.size() * sizeof(SectionVertex) + lights_.size() * sizeof(SectionLight));
    sections_.put(counters);
  }

  GrowingBuffer vertex_buffer_, light_buffer_, index_buffer_;
  std::vector<SectionVertex> vertices_;
  std::vector<SectionLight> lights_;  // as many, or none
  std::vector<uint32_t> indices_;
  SectionCounts sections_;
};

void PreparedSoftware::classify(const ShellFrame& frame) {
  vertices_.clear();
  lights_.clear();
  indices_.clear();
  sections_ = {};
  corner_depths(shell_, frame, depths_);
  const auto depth_of = [&](const Prism& prism, int corner) {
    const uint32_t position = prism.position[static_cast<size_t>(corner % 3)];
    return corner < 3 ? depths_.lower[position] : depths_.upper[position];
  };
  tests_ = pairs_.visit(shell_, frame, depths_, reject_, [&](int plane, uint32_t number) {
    const Prism& prism = shell_.prisms[number];
    const auto at = static_cast<float>(plane);
    const Section& section = kSections[sides_of(depths_, prism, at)];
    if (section.corners == 0) return;
    const auto base = static_cast<uint32_t>(vertices_.size());
    for (size_t k = 0; k < section.corners; ++k) {
      const int a = kEdgeEnds[section.edges[k]][0], b = kEdgeEnds[section.edges[k]][1];
      const EdgeWeights weights = edge_weights(depth_of(prism, a) - at, depth_of(prism, b) - at);
      const glm::vec3 p = on_edge(weights, shell_.corner(prism, a), shell_.corner(prism, b));
      const auto from = static_cast<size_t>(a), to = static_cast<size_t>(b);
      vertices_.push_back({to_ndc(frame.uniforms, p, at), on_edge(weights, prism.texture[from], prism.texture[to])});
      if (!lit_) continue;
      const glm::mat3 &ca = shell_.cotangents[number][from], &cb = shell_.cotangents[number][to];
      lights_.push_back({to_box(frame.uniforms, p), on_edge(weights, ca, cb)});
    }
    add_fan(
        section, [&](uint32_t k) { return base + k; }, indices_);
    sections_.add(section);
  });
}

std::vector<DrawDesc> PreparedSoftware::upload(const ShellFrame&) {
  if (indices_.empty()) return {};
  DrawDesc draw;
  draw.vertex_buffers = {vertex_buffer_.upload(bytes_of(vertices_))};
  if (lit_) draw.vertex_buffers.push_back(light_buffer_.upload(bytes_of(lights_)));
  draw.index_buffer = index_buffer_.upload(bytes_of(indices_));
  draw.count = static_cast<uint32_t>(indices_.size());
  return {draw};
}

class ShellSoftware final : public Method {
 public:
  const MethodInfo& info() const override {
    static const MethodInfo info{.name = "shell_software",
                                 .title = "Shell prisms cut by planes across the view, all intersections on the host",
                                 .paper = "lensch2002",
                                 .parameters = shell_parameter_list({}),
                                 .effects = {"lighting"},
                                 .displays = {Display::Shell}};
    return info;
  }
  std::optional<std::string> unsupported(const Scene& scene, const Values&, const BackendInfo& backend) const override {
    return shell_unsupported(scene, 0, backend);
  }
  std::unique_ptr<PreparedMethod> prepare(const Scene& scene, const Values& values, Device& device) const override {
    return std::make_unique<PreparedSoftware>(scene, values, device);
  }
  Format target_format(const Values& values) const override { return target_format_of(values); }
};

}  // namespace

const Method& shell_software() {
  static const ShellSoftware method;
  return method;
}

}  // namespace volumark
