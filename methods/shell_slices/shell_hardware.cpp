// lensch2002, section 6: six vertices a prism and plane, and everything decided in the vertex program.
#include "methods/shell_slices/shell_slicer.h"
#include "methods/shell_slices/shell_slices.h"
#include "methods/shell_slices/shell_twin.h"
#include "programs/shell_hardware_lit_vert.h"
#include "programs/shell_hardware_vert.h"

namespace volumark {
namespace {

const Choice kSelection{"selection",
                        "how the vertex program takes one of five edges; select: all are computed and weighted by 0 or "
                        "1, as without flow control; branch: by conditions",
                        {"select", "branch"},
                        "select"};

// Positions, then texture coordinates, of three normal edges: own, primary, secondary.
struct CornerVertex {
  std::array<glm::vec3, 12> values;
};
static_assert(sizeof(CornerVertex) == 144);

// Normal edges of vertex 0..5: own, primary, secondary.
std::array<size_t, 3> normals_of(size_t vertex) {
  const size_t own = vertex / 2, step = vertex % 2 == 1 ? 1 : 2;
  return {own, (own + step) % 3, (own + 2 * step) % 3};
}

// v0l, v0r, v1l, v1r, v2l, v2r: left ones look to the normal edge before theirs first, right ones to the one after.
std::vector<CornerVertex> corner_vertices(const ShellPrisms& shell) {
  std::vector<CornerVertex> out;
  for (const Prism& prism : shell.prisms) {
    for (size_t vertex = 0; vertex < 6; ++vertex) {
      const std::array<size_t, 3> normals = normals_of(vertex);
      CornerVertex& corner = out.emplace_back();
      for (size_t k = 0; k < 3; ++k) {
        for (size_t end = 0; end < 2; ++end) {
          const size_t index = normals[k] + 3 * end;
          corner.values[2 * k + end] = shell.corner(prism, static_cast<int>(index));
          corner.values[6 + 2 * k + end] = prism.texture[index];
        }
      }
    }
  }
  return out;
}

// Cotangents of the same six corners.
std::vector<std::array<glm::mat3, 6>> corner_cotangents(const ShellPrisms& shell) {
  std::vector<std::array<glm::mat3, 6>> out;
  for (const std::array<glm::mat3, 6>& prism : shell.cotangents) {
    for (size_t vertex = 0; vertex < 6; ++vertex) {
      const std::array<size_t, 3> normals = normals_of(vertex);
      std::array<glm::mat3, 6>& corner = out.emplace_back();
      for (size_t k = 0; k < 6; ++k) corner[k] = prism[normals[k / 2] + 3 * (k % 2)];
    }
  }
  return out;
}

constexpr uint32_t kChunk = 65536;  // pairs in one draw: bounds the index buffer, which all draws share

class PreparedHardware final : public ShellSlicer {
 public:
  PreparedHardware(const Scene& scene, const Values& values, Device& device)
      : ShellSlicer(scene, values, device,
                    {"shell_hardware",
                     &programs::shell_hardware_vert,
                     &programs::shell_hardware_lit_vert,
                     &shell_hardware_twin,
                     storage_bindings({5, 6}, scene),
                     {{"VM_BRANCHES", static_cast<int32_t>(kSelection.index(values))},
                      {"VM_LISTED", shell_parameters::kReject.index(values) == 0 ? 0 : 1}},
                     {}}),
        corner_buffer_(device, "prism corners"),
        cotangent_buffer_(device, "cotangents of prism corners"),
        pair_buffer_(device, "prisms on planes"),
        index_buffer_(device, "fans of six corners") {
    const std::vector<CornerVertex> corners = corner_vertices(shell_);
    vertex_bytes_ = corners.size() * sizeof(CornerVertex);
    if (!corners.empty()) corners_ = corner_buffer_.upload(bytes_of(corners));
    const std::vector<std::array<glm::mat3, 6>> cotangents = corner_cotangents(shell_);
    if (!cotangents.empty()) cotangents_ = cotangent_buffer_.upload(bytes_of(cotangents));
  }

 private:
  struct Pair {
    uint32_t prism, plane;
  };
  void classify(const ShellFrame& frame) override;
  std::vector<DrawDesc> upload(const ShellFrame& frame) override;
  void count(Counters& counters) const override {
    counters["vertices"] = 6 * (tests_.tests - tests_.rejected);
    counters["vertex_bytes"] = static_cast<int64_t>(vertex_bytes_);
    counters["frame_bytes"] = static_cast<int64_t>(list_.size() * sizeof(Pair));
  }
  Buffer fans(uint32_t count);

  GrowingBuffer corner_buffer_, cotangent_buffer_, pair_buffer_, index_buffer_;
  Buffer corners_, cotangents_, fans_;
  uint32_t fans_made_ = 0;
  size_t vertex_bytes_ = 0;
  std::vector<Pair> list_;
};

void PreparedHardware::classify(const ShellFrame& frame) {
  list_.clear();
  if (reject_ == Reject::None) {
    tests_.tests = static_cast<int64_t>(frame.planes) * static_cast<int64_t>(shell_.prisms.size());
    return;
  }
  corner_depths(shell_, frame, depths_);
  tests_ = pairs_.visit(shell_, frame, depths_, reject_, [&](int plane, uint32_t prism) {
    list_.push_back({prism, static_cast<uint32_t>(plane)});
  });
}

// Indices of the first `count` groups of six vertices, each as a fan around the first of the group.
Buffer PreparedHardware::fans(uint32_t count) {
  if (count <= fans_made_) return fans_;
  std::vector<uint32_t> indices;
  for (uint32_t base = 0; base < 6 * count; base += 6) {
    for (uint32_t k = 2; k < 6; ++k) indices.insert(indices.end(), {base, base + k - 1, base + k});
  }
  fans_made_ = count;
  fans_ = index_buffer_.upload(bytes_of(indices));
  return fans_;
}

std::vector<DrawDesc> PreparedHardware::upload(const ShellFrame& frame) {
  DrawDesc draw;
  if (frame.planes == 0 || shell_.prisms.empty()) return {};
  if (reject_ == Reject::None) {
    const auto prisms = static_cast<uint32_t>(shell_.prisms.size());
    draw.index_buffer = fans(prisms);
    draw.bindings = {bind_storage(5, corners_), bind_storage(6, corners_)};  // the list is not read
    if (lit_) draw.bindings.push_back(bind_storage(7, cotangents_));
    draw.count = 12 * prisms;
    draw.instances = static_cast<uint32_t>(frame.planes);
    return {draw};
  }
  if (list_.empty()) return {};
  std::vector<DrawDesc> draws;
  const Buffer pairs = pair_buffer_.upload(bytes_of(list_));
  draw.index_buffer = fans(static_cast<uint32_t>(std::min<size_t>(list_.size(), kChunk)));
  for (size_t first = 0; first < list_.size(); first += kChunk) {
    const size_t count = std::min<size_t>(list_.size() - first, kChunk);
    draw.bindings = {bind_storage(5, corners_), bind_storage(6, pairs, first * sizeof(Pair), count * sizeof(Pair))};
    if (lit_) draw.bindings.push_back(bind_storage(7, cotangents_));
    draw.count = static_cast<uint32_t>(12 * count);
    draws.push_back(draw);
  }
  return draws;
}

class ShellHardware final : public Method {
 public:
  const MethodInfo& info() const override {
    static const MethodInfo info{
        .name = "shell_hardware",
        .title = "Shell prisms cut by planes across the view, classified and cut in the vertex program",
        .paper = "lensch2002",
        .parameters = shell_parameter_list({kSelection.info()}),
        .effects = {"lighting"},
        .displays = {Display::Shell}};
    return info;
  }
  std::optional<std::string> unsupported(const Scene& scene, const Values&, const BackendInfo& backend) const override {
    return shell_unsupported(scene, 6 * (scene.effects.lighting ? 6 * sizeof(glm::mat3) : sizeof(CornerVertex)),
                             backend);
  }
  std::unique_ptr<PreparedMethod> prepare(const Scene& scene, const Values& values, Device& device) const override {
    return std::make_unique<PreparedHardware>(scene, values, device);
  }
  Format target_format(const Values& values) const override { return target_format_of(values); }
};

}  // namespace

const Method& shell_hardware() {
  static const ShellHardware method;
  return method;
}

}  // namespace volumark
