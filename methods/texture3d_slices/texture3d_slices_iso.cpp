#include "methods/texture3d_slices/texture3d_slices_iso.h"

#include "methods/texture3d_slices/slice_geometry.h"
#include "methods/texture3d_slices/slice_parameters.h"
#include "methods/volume/gradient_texels.h"
#include "methods/volume/growing_buffer.h"
#include "methods/volume/isosurface.h"
#include "methods/volume/volume_parameters.h"
#include "methods/volume/volume_resources.h"
#include "methods/volume/volume_texels.h"
#include "programs/texture3d_slices_iso_frag.h"
#include "programs/texture3d_slices_iso_vert.h"

namespace volumark {
namespace {

namespace parameters {
using namespace volume_parameters;
using namespace isosurface_parameters;
using slice_parameters::kStep;

const Choice kGradients{
    "gradients",
    "computed: central differences at the surface, from a texture of values; stored: in one texture "
    "with the values (normals=interpolated always stores them)",
    {"computed", "stored"},
    "computed",
    Ideal<const char*>{"computed", "stored gradients"}};
}  // namespace parameters

// VM_GRADIENTS.
enum class Gradients { Computed, Stored, Normals };
Gradients gradients_of(const Scene& scene, const Values& values) {
  if (!scene.effects.lighting) return Gradients::Computed;
  if (parameters::kNormals(values) == "interpolated") return Gradients::Normals;
  return parameters::kGradients(values) == "stored" ? Gradients::Stored : Gradients::Computed;
}

double expected_order(const Values& values) {
  // Formats with few bits have an error that no step removes; normals of the voxels are other normals.
  const std::string& format = parameters::kVolumeFormat(values);
  if (parameters::kNormals(values) == "interpolated" || parameters::kGradients(values) == "stored" ||
      (format != "native" && format != "r32f")) {
    return 0;
  }
  return parameters::kRefine(values) == "linear" ? 2 : 1;
}

// The volume as a 3D texture: values, or gradient and value. Owns it; dies before the Device.
class SurfaceVolume {
 public:
  SurfaceVolume(const Scene& scene, const Values& values, Device& device) : device_(device) {
    const Gradients gradients = gradients_of(scene, values);
    if (gradients == Gradients::Computed) {
      VolumeSettings settings;
      settings.volume_format = parameters::kVolumeFormat(values);
      const VolumeTexels texels = volume_texels(scene, settings);
      texels_ = {texels.format, texels.value_origin, texels.value_scale};
      create(*scene.volume, texels.of(*scene.volume));
    } else {
      const GradientTexels texels = gradient_texels(
          scene, {gradients == Gradients::Normals, GradientAlpha::Scalar, parameters::kGradientFormat(values)});
      texels_ = {texels.format, texels.value_origin, texels.value_scale, texels.scale, texels.offset};
      create(*scene.volume, texels.texels);
    }
  }
  ~SurfaceVolume() { device_.destroy(texture_); }
  SurfaceVolume(const SurfaceVolume&) = delete;
  SurfaceVolume& operator=(const SurfaceVolume&) = delete;

  Texture texture() const { return texture_; }
  const SurfaceTexels& texels() const { return texels_; }
  int64_t bytes() const { return bytes_; }

 private:
  void create(const Volume& volume, std::span<const std::byte> data) {
    TextureDesc desc;
    desc.label = "volume";
    desc.dimension = 3;
    desc.format = texels_.format;
    desc.width = volume.size.x;
    desc.height = volume.size.y;
    desc.depth = volume.size.z;
    desc.data = data;
    texture_ = device_.create_texture(desc);
    bytes_ = static_cast<int64_t>(data.size());
  }

  Device& device_;
  SurfaceTexels texels_;
  Texture texture_;
  int64_t bytes_ = 0;
};

class PreparedIsoSlices final : public PreparedMethod {
 public:
  PreparedIsoSlices(const Scene& scene, const Values& values, Device& device)
      : scene_(scene),
        device_(device),
        front_to_back_(parameters::kOrder(values) == "front_to_back"),
        step_(step_in_world(scene, values)),
        volume_(scene, values, device),
        uniforms_(device, "slice uniforms"),
        surface_(device, "surface uniforms"),
        vertices_(device, "slice vertices"),
        depths_(device, "slice depths"),
        indices_(device, "slice indices"),
        depth_target_(device) {
    ProgramDesc program;
    program.label = "texture3d_slices_iso";
    program.stages = {&programs::texture3d_slices_iso_vert, &programs::texture3d_slices_iso_frag};
    program.bindings = {
        {0, BindingKind::Uniform, 0}, {1, BindingKind::Sampled, 3}, {kSurfaceBinding, BindingKind::Uniform, 0}};
    program.constants = VolumeResources::constants(scene, Classification::Post, false);
    program.constants.push_back({"VM_REFINE", parameters::kRefine(values) == "linear" ? 1 : 0});
    program.constants.push_back({"VM_GRADIENTS", static_cast<int32_t>(gradients_of(scene, values))});
    program.cpu = &texture3d_slices_iso_twin;
    program_ = device.create_program(program);
    PipelineDesc pipeline;
    pipeline.label = "texture3d_slices_iso";
    pipeline.program = program_;
    pipeline.vertex_layouts = {{sizeof(SliceVertex), false, {{0, 2, 0}, {1, 1, offsetof(SliceVertex, z)}}},
                               {sizeof(float), false, {{2, 1, 0}}}};
    pipeline.colour_format = target_format_of(values);
    pipeline.has_depth_stencil = pipeline.depth_test = pipeline.depth_write = front_to_back_;
    pipeline_ = device.create_pipeline(pipeline);
  }
  ~PreparedIsoSlices() override {
    device_.destroy(pipeline_);
    device_.destroy(program_);
  }
  PreparedIsoSlices(const PreparedIsoSlices&) = delete;
  PreparedIsoSlices& operator=(const PreparedIsoSlices&) = delete;

  void render(const View& view, Device& device, Texture target) override;
  Counters counters() const override { return counters_; }

 private:
  VolumeUniforms uniforms_of(const View& view, int width, int height) const;

  Scene scene_;  // shares the volume
  Device& device_;
  bool front_to_back_;
  double step_;  // world units
  SurfaceVolume volume_;
  GrowingBuffer uniforms_, surface_, vertices_, depths_, indices_;
  DepthTarget depth_target_;
  Program program_;
  Pipeline pipeline_;
  SliceMesh mesh_;
  Counters counters_;
};

VolumeUniforms PreparedIsoSlices::uniforms_of(const View& view, int width, int height) const {
  VolumeUniforms uniforms = volume_uniforms(scene_, view, width, height);
  uniforms.value = {volume_.texels().value_origin, volume_.texels().value_scale, 0, 0};
  uniforms.depth[3] = static_cast<float>(step_);
  put_window_rays(uniforms, width, height);
  return uniforms;
}

void PreparedIsoSlices::render(const View& view, Device& device, Texture target) {
  const int width = device.desc(target).width, height = device.desc(target).height;
  const glm::dvec3 extent = scene_.volume->extent();
  device.begin_zone("classify");
  const ViewRays rays = view_rays(*scene_.volume, view, width, height);
  const Body body = visible_body(extent, rays, local_clip_planes(scene_));
  // Wider by an eighth of a pixel, so that none is missed: fragments know themselves where the body ends.
  build_slices(body, rays, slabs_of(body, step_), true, front_to_back_, mesh_, glm::dvec2(0.25 / width, 0.25 / height));
  const std::vector<float> depths = drawing_depths(mesh_.indices, mesh_.vertices.size(), mesh_.polygons);
  device.end_zone();

  DrawDesc draw;
  if (!mesh_.indices.empty()) {
    device.begin_zone("upload");
    const SurfaceUniforms surface = surface_uniforms(scene_, volume_.texels());
    draw.pipeline = pipeline_;
    draw.bindings = {bind_uniform(0, uniforms_.upload(bytes_of(uniforms_of(view, width, height)))),
                     bind_sampled(1, volume_.texture(), {Filter::Linear, Wrap::Clamp}),
                     bind_uniform(kSurfaceBinding, surface_.upload(bytes_of(surface)))};
    draw.vertex_buffers = {vertices_.upload(bytes_of(mesh_.vertices)), depths_.upload(bytes_of(depths))};
    draw.index_buffer = indices_.upload(bytes_of(mesh_.indices));
    draw.count = static_cast<uint32_t>(mesh_.indices.size());
    device.end_zone();
  }
  device.begin_zone("raster");
  PassDesc pass;
  pass.label = "slices";
  pass.colour = target;
  if (front_to_back_) pass.depth_stencil = depth_target_.of(width, height);
  device.begin_pass(pass);
  if (draw.count > 0) device.draw(draw);
  device.end_pass();
  device.end_zone();

  counters_ = {{"slices", mesh_.slices},
               {"polygons", mesh_.polygons},
               {"vertices", static_cast<int64_t>(mesh_.vertices.size())},
               {"texture_bytes", volume_.bytes()}};
}

class Texture3dSlicesIso final : public Method {
 public:
  const MethodInfo& info() const override {
    static const MethodInfo info{
        "texture3d_slices_iso",
        "Isosurface by slices of a 3D texture and the alpha test, without blending",
        "westermann1998; rezksalama2000",
        {parameters::kStep.info(), parameters::kOrder.info(), parameters::kRefine.info(), parameters::kNormals.info(),
         parameters::kGradients.info(), parameters::kTargetFormat.info(), parameters::kVolumeFormat.info(),
         parameters::kGradientFormat.info()},
        {"lighting", "clip_planes"},
        expected_order,
        {},
        {Display::Isosurface}};
    return info;
  }
  std::optional<std::string> unsupported(const Scene& scene, const Values&, const BackendInfo& backend) const override {
    VolumeSettings settings;
    settings.table_size = 1;  // no table is made
    return volume_unsupported(scene, settings, backend);
  }
  std::unique_ptr<PreparedMethod> prepare(const Scene& scene, const Values& values, Device& device) const override {
    return std::make_unique<PreparedIsoSlices>(scene, values, device);
  }
  Format target_format(const Values& values) const override { return target_format_of(values); }
};

}  // namespace

const Method& texture3d_slices_iso() {
  static const Texture3dSlicesIso method;
  return method;
}

}  // namespace volumark
