// What the three variants of lensch2002 have in common: the shell as prisms, its texture, the planes of a view, one
// pass that draws all of them from back to front. A variant says what it uploads and how it draws.
#pragma once

#include <string>

#include "methods/method.h"
#include "methods/shell_slices/plane_pairs.h"
#include "methods/shell_slices/prisms.h"
#include "methods/shell_slices/shell_frame.h"
#include "methods/volume/growing_buffer.h"
#include "methods/volume/volume_parameters.h"

namespace volumark {

namespace shell_parameters {
using volume_parameters::kOpacityCorrection;
using volume_parameters::kTargetFormat;

inline const Integer kPlanes{{"planes",
                              "",
                              "slices, evenly spaced over the depth that the shell fills in a view",
                              500,
                              1,
                              10000,
                              {125, 250, 500, 1000, 2000},
                              Ideal<int64_t>{4000, "planes"}}};
inline const Choice kReject{"reject",
                            "which prisms are held against a plane; none: all; spheres: those whose bounding sphere it "
                            "meets; active_list: those between whose nearest and farthest corner it lies, found by "
                            "sorting",
                            {"none", "spheres", "active_list"},
                            "active_list"};
inline const Choice kTextureFormat{"texture_format",
                                   "texels of the volumetric texture; rgba16f and rgba8 are stored in units of the "
                                   "largest one",
                                   {"rgba32f", "rgba16f", "rgba8"},
                                   "rgba32f",
                                   Ideal<const char*>{"rgba32f", "texture format"}};
}  // namespace shell_parameters

// The parameters above, and `own` ones after the first.
std::vector<ParameterInfo> shell_parameter_list(const std::vector<ParameterInfo>& own);

// Why these textures and buffers cannot be had; nothing where they can.
std::optional<std::string> shell_unsupported(const Scene& scene, size_t bytes_a_prism, const BackendInfo& backend);

class ShellSlicer : public PreparedMethod {
 public:
  ~ShellSlicer() override;
  ShellSlicer(const ShellSlicer&) = delete;
  ShellSlicer& operator=(const ShellSlicer&) = delete;

  void render(const View& view, Device& device, Texture target) final;
  Counters counters() const final { return counters_; }

 protected:
  // A vertex program, and what it has besides the bindings (0, 1, 4) and constants (0 to 5) of the fragment program.
  struct Variant {
    const char* label;
    const ShaderText* vertex;
    const ShaderText* lit_vertex;
    const CpuProgram* cpu;
    std::vector<BindingDecl> bindings;
    std::vector<SpecConstant> constants;
    std::vector<VertexLayout> vertex_layouts;
  };
  ShellSlicer(const Scene& scene, const Values& values, Device& device, const Variant& variant);

  // Host work of a frame, in zone classify. `frame` has planes.
  virtual void classify(const ShellFrame& frame) = 0;
  // Uploads in zone upload; the draws to do, without pipeline and the bindings that all have.
  virtual std::vector<DrawDesc> upload(const ShellFrame& frame) = 0;
  // Adds vertices, vertex_bytes and polygons.
  virtual void count(Counters& counters) const = 0;

  Device& device_;
  bool lit_;
  ShellPrisms shell_;
  Reject reject_;
  CornerDepths depths_;  // of the frame, if a variant asks for them
  PlanePairs pairs_;
  PairCounts tests_;

 private:
  void create_texture(const ShellTexture& texture, size_t format);
  void create_pipeline(const Values& values, const Variant& variant);
  void release();

  void fill(ShellFrame& frame) const;
  VolumeUniforms light(const View& view) const;

  Scene scene_;  // shares the shell
  std::string label_;
  int planes_;
  GrowingBuffer uniforms_, light_;
  Texture texture_;
  size_t texture_bytes_ = 0;
  glm::ivec3 texture_size_{0};
  float texture_scale_ = 1, greatest_extinction_ = 1;
  Program program_;
  Pipeline pipeline_;
  Counters counters_;
};

// The storage buffers of a vertex program: `slots`, and 7 for the cotangents of a lit shell.
std::vector<BindingDecl> storage_bindings(std::initializer_list<uint32_t> slots, const Scene& scene);

// Polygons of a frame by their number of corners.
struct SectionCounts {
  int64_t by_corners[6] = {};
  int64_t twisted = 0;
  void add(const Section& section) {
    ++by_corners[section.corners];
    twisted += section.twisted ? 1 : 0;
  }
  void put(Counters& counters) const;
};

// Triangles of a section: a fan around its first corner, whose number is index(0).
template <class Index>
void add_fan(const Section& section, const Index& index, std::vector<uint32_t>& out) {
  for (uint32_t k = 2; k < section.corners; ++k) out.insert(out.end(), {index(0), index(k - 1), index(k)});
}

}  // namespace volumark
