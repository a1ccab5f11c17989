#include "methods/texture3d_slices/texture3d_slices.h"

#include "methods/texture3d_slices/fixed_slices.h"
#include "methods/texture3d_slices/slice_geometry.h"
#include "methods/texture3d_slices/slice_parameters.h"
#include "methods/volume/growing_buffer.h"
#include "methods/volume/volume_parameters.h"
#include "methods/volume/volume_resources.h"
#include "programs/texture3d_slices_frag.h"
#include "programs/texture3d_slices_vert.h"

namespace volumark {
namespace {

namespace parameters {
using namespace volume_parameters;
using namespace slice_parameters;
}  // namespace parameters

bool linear_opacity(const Values& values) { return parameters::kOpacityCorrection(values) == "linear"; }

double expected_order(const Values& values) {
  // Formats with few bits have an error that no step removes; pre-classified volumes tend to another picture.
  const std::string& format = parameters::kVolumeFormat(values);
  if (classification_of(values) == Classification::Pre || parameters::kTargetFormat(values) != "rgba32f" ||
      (format != "native" && format != "r32f")) {
    return 0;
  }
  return clips_slabs(values) && !linear_opacity(values) ? 2 : 1;
}

VolumeSettings settings_of(const Scene& scene, const Values& values) {
  VolumeSettings settings;
  settings.volume_format = parameters::kVolumeFormat(values);
  settings.classification = classification_of(values);
  settings.table_size = static_cast<int>(parameters::kTableSize(values));
  settings.preintegrated_size = static_cast<int>(parameters::kPreintegratedSize(values));
  if (scene.volume) settings.segment = step_in_world(scene, values);
  return settings;
}

class PreparedSlices final : public PreparedMethod {
 public:
  PreparedSlices(const Scene& scene, const Values& values, Device& device)
      : scene_(scene),
        device_(device),
        clips_(clips_slabs(values)),
        front_to_back_(parameters::kOrder.index(values) == 1),
        step_(step_in_world(scene, values)),
        resources_(scene, settings_of(scene, values), device),
        uniforms_(device, "slice uniforms"),
        vertices_(device, "slice vertices"),
        indices_(device, "slice indices") {
    ProgramDesc program;
    program.label = "texture3d_slices";
    program.stages = {&programs::texture3d_slices_vert, &programs::texture3d_slices_frag};
    program.bindings = VolumeResources::declarations();
    program.constants = VolumeResources::constants(scene, classification_of(values), linear_opacity(values));
    program.constants.push_back({"VM_CLIP_SLABS", clips_ ? 1 : 0});
    program.cpu = &texture3d_slices_twin;
    program_ = device.create_program(program);
    PipelineDesc pipeline;
    pipeline.label = "texture3d_slices";
    pipeline.program = program_;
    pipeline.vertex_layouts = {{sizeof(SliceVertex), false, {{0, 2, 0}, {1, 1, offsetof(SliceVertex, z)}}}};
    pipeline.blend = front_to_back_ ? Blend::Under : Blend::Over;
    pipeline.colour_format = target_format_of(values);
    pipeline_ = device.create_pipeline(pipeline);
  }
  ~PreparedSlices() override {
    device_.destroy(pipeline_);
    device_.destroy(program_);
  }
  PreparedSlices(const PreparedSlices&) = delete;
  PreparedSlices& operator=(const PreparedSlices&) = delete;

  void render(const View& view, Device& device, Texture target) override;
  Counters counters() const override { return counters_; }

 private:
  VolumeUniforms uniforms_of(const View& view, const Body& body, int width, int height) const;

  Scene scene_;  // shares the volume
  Device& device_;
  bool clips_, front_to_back_;
  double step_;  // world units
  VolumeResources resources_;
  GrowingBuffer uniforms_, vertices_, indices_;
  Program program_;
  Pipeline pipeline_;
  SliceMesh mesh_;
  Counters counters_;
};

VolumeUniforms PreparedSlices::uniforms_of(const View& view, const Body& body, int width, int height) const {
  VolumeUniforms uniforms = volume_uniforms(scene_, view, width, height);
  resources_.fill(uniforms);
  uniforms.depth[1] = static_cast<float>(body.z_first);
  uniforms.depth[2] = static_cast<float>(body.z_last);
  uniforms.depth[3] = static_cast<float>(step_);
  put_window_rays(uniforms, width, height);
  return uniforms;
}

void PreparedSlices::render(const View& view, Device& device, Texture target) {
  const int width = device.desc(target).width, height = device.desc(target).height;
  const glm::dvec3 extent = scene_.volume->extent();
  device.begin_zone("classify");
  const ViewRays rays = view_rays(*scene_.volume, view, width, height);
  const Body body = visible_body(extent, rays, local_clip_planes(scene_));
  // Fragments that clip their stretch of the ray may lie outside the body: an eighth of a pixel, so that none is
  // missed.
  const glm::dvec2 margin = clips_ ? glm::dvec2(0.25 / width, 0.25 / height) : glm::dvec2(0);
  build_slices(body, rays, slabs_of(body, step_), clips_, front_to_back_, mesh_, margin);
  device.end_zone();

  DrawDesc draw;
  if (!mesh_.indices.empty()) {
    device.begin_zone("upload");
    draw.pipeline = pipeline_;
    draw.bindings = resources_.bindings(uniforms_.upload(bytes_of(uniforms_of(view, body, width, height))));
    draw.vertex_buffers = {vertices_.upload(bytes_of(mesh_.vertices))};
    draw.index_buffer = indices_.upload(bytes_of(mesh_.indices));
    draw.count = static_cast<uint32_t>(mesh_.indices.size());
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

  counters_ = {{"slices", mesh_.slices},
               {"polygons", mesh_.polygons},
               {"vertices", static_cast<int64_t>(mesh_.vertices.size())},
               {"texture_bytes", static_cast<int64_t>(resources_.texture_bytes())}};
}

class Texture3dSlices final : public Method {
 public:
  const MethodInfo& info() const override {
    static const MethodInfo info{
        "texture3d_slices",
        "Slices of a 3D texture perpendicular to the view, blended in order",
        "cabral1994; westermann1998",
        {parameters::kStep.info(), parameters::kOrder.info(), parameters::kEndSlabs.info(),
         parameters::kClassification.info(), parameters::kOpacityCorrection.info(), parameters::kTargetFormat.info(),
         parameters::kVolumeFormat.info(), parameters::kTableSize.info(), parameters::kPreintegratedSize.info()},
        {"lighting", "clip_planes", "fixed_point"},
        expected_order};
    return info;
  }
  std::optional<std::string> unsupported(const Scene& scene, const Values& values,
                                         const BackendInfo& backend) const override {
    if (auto reason = fixed_point_unsupported(scene, classification_of(values))) return reason;
    return volume_unsupported(scene, settings_of(scene, values), backend);
  }
  std::unique_ptr<PreparedMethod> prepare(const Scene& scene, const Values& values, Device& device) const override {
    if (scene.effects.fixed_point) {
      const FixedSettings settings{classification_of(values), linear_opacity(values), step_in_world(scene, values)};
      return prepare_fixed_slices(scene, settings, parameters::kOrder.index(values) == 1, device);
    }
    return std::make_unique<PreparedSlices>(scene, values, device);
  }
  Format target_format(const Values& values) const override { return target_format_of(values); }
};

}  // namespace

const Method& texture3d_slices() {
  static const Texture3dSlices method;
  return method;
}

}  // namespace volumark
