#include "methods/texture3d_slices/fixed_slices.h"

#include "methods/texture3d_slices/slice_geometry.h"
#include "methods/volume/growing_buffer.h"
#include "programs/texture3d_slices_fixed_frag.h"
#include "programs/texture3d_slices_fixed_vert.h"

namespace volumark {
namespace {

struct FixedVertex {
  float x, y;   // NDC
  float slice;  // its number, nearest first
};

class PreparedFixedSlices final : public PreparedMethod {
 public:
  PreparedFixedSlices(const Scene& scene, const FixedSettings& settings, bool front_to_back, Device& device)
      : scene_(scene),
        device_(device),
        step_(settings.step),
        front_to_back_(front_to_back),
        resources_(scene, fixed_texels(scene, settings), fixed_palette(scene, settings), device),
        uniforms_(device, "slice uniforms"),
        vertices_(device, "slice vertices"),
        indices_(device, "slice indices") {
    ProgramDesc program;
    program.label = "texture3d_slices, fixed point";
    program.stages = {&programs::texture3d_slices_fixed_vert, &programs::texture3d_slices_fixed_frag};
    program.bindings = FixedResources::declarations();
    program.constants = FixedResources::constants(scene, settings);
    program.cpu = &texture3d_slices_fixed_cpu;
    program_ = device.create_program(program);
    PipelineDesc pipeline;
    pipeline.label = program.label;
    pipeline.program = program_;
    pipeline.vertex_layouts = {{sizeof(FixedVertex), false, {{0, 2, 0}, {1, 1, offsetof(FixedVertex, slice)}}}};
    pipeline.blend = front_to_back ? Blend::Under : Blend::Over;
    pipeline.colour_format = Format::RGBA8;
    pipeline_ = device.create_pipeline(pipeline);
  }
  ~PreparedFixedSlices() override {
    device_.destroy(pipeline_);
    device_.destroy(program_);
  }
  PreparedFixedSlices(const PreparedFixedSlices&) = delete;
  PreparedFixedSlices& operator=(const PreparedFixedSlices&) = delete;

  void render(const View& view, Device& device, Texture target) override;
  Counters counters() const override { return counters_; }

 private:
  void build_mesh(const View& view, int width, int height);

  Scene scene_;  // shares the volume
  Device& device_;
  double step_;  // world units
  bool front_to_back_;
  FixedResources resources_;
  GrowingBuffer uniforms_, vertices_, indices_;
  Program program_;
  Pipeline pipeline_;
  std::vector<FixedVertex> mesh_;
  std::vector<uint32_t> mesh_indices_;
  Counters counters_;
};

// Polygons cover every pixel that may have a sample inside, and a few beside it: the program decides which have, since
// rasterizers move corners to grids of their own.
void PreparedFixedSlices::build_mesh(const View& view, int width, int height) {
  const Volume& volume = *scene_.volume;
  const ViewRays rays = view_rays(volume, view, width, height);
  const FixedDepths depths = fixed_depths(volume, rays, step_);
  const double slack = 0.02;  // texels; positions are rounded to 1/256
  std::vector<LocalPlane> planes = local_clip_planes(scene_);
  for (LocalPlane& plane : planes) plane.distance -= slack * glm::dot(glm::abs(plane.normal), volume.spacing);
  const Body body = visible_body(volume.extent() + 2 * slack * volume.spacing, rays, planes);
  const glm::dvec2 margin(1.5 / width, 1.5 / height);
  mesh_.clear();
  mesh_indices_.clear();
  int64_t polygons = 0;
  for (int i = 0; i < depths.count; ++i) {
    const int slice = front_to_back_ ? i : depths.count - 1 - i;
    const double z = depths.first + (slice + 0.5) * step_;
    const std::vector<glm::dvec2> hull = hull_of_slab(body, rays, z, z, margin);
    if (hull.size() < 3) continue;
    const auto base = static_cast<uint32_t>(mesh_.size());
    for (const glm::dvec2& p : hull) {
      mesh_.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(slice)});
    }
    for (uint32_t corner = 2; corner < hull.size(); ++corner) {
      mesh_indices_.insert(mesh_indices_.end(), {base, base + corner - 1, base + corner});
    }
    ++polygons;
  }
  counters_ = {{"slices", depths.count},
               {"polygons", polygons},
               {"vertices", static_cast<int64_t>(mesh_.size())},
               {"texture_bytes", static_cast<int64_t>(resources_.texture_bytes())}};
}

void PreparedFixedSlices::render(const View& view, Device& device, Texture target) {
  const int width = device.desc(target).width, height = device.desc(target).height;
  device.begin_zone("classify");
  build_mesh(view, width, height);
  device.end_zone();
  DrawDesc draw;
  if (!mesh_indices_.empty()) {
    device.begin_zone("upload");
    const FixedUniforms uniforms = fixed_uniforms(scene_, view, width, height, step_);
    draw.pipeline = pipeline_;
    draw.bindings = resources_.bindings(uniforms_.upload(bytes_of(uniforms)));
    draw.vertex_buffers = {vertices_.upload(bytes_of(mesh_))};
    draw.index_buffer = indices_.upload(bytes_of(mesh_indices_));
    draw.count = static_cast<uint32_t>(mesh_indices_.size());
    device.end_zone();
  }
  device.begin_zone("raster");
  PassDesc pass;
  pass.label = "slices";
  pass.colour = target;
  device.begin_pass(pass);
  if (draw.count > 0) device.draw(draw);
  device.end_pass();
  device.end_zone();
}

}  // namespace

std::unique_ptr<PreparedMethod> prepare_fixed_slices(const Scene& scene, const FixedSettings& settings,
                                                     bool front_to_back, Device& device) {
  return std::make_unique<PreparedFixedSlices>(scene, settings, front_to_back, device);
}

}  // namespace volumark
