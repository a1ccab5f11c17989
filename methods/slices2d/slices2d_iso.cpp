#include "methods/slices2d/slices2d_iso.h"

#include <algorithm>

#include "methods/slices2d/page_uniforms.h"
#include "methods/slices2d/slice_polygons.h"
#include "methods/slices2d/stacks.h"
#include "methods/volume/growing_buffer.h"
#include "methods/volume/isosurface.h"
#include "methods/volume/volume_parameters.h"
#include "programs/slices2d_iso_frag.h"
#include "programs/slices2d_iso_vert.h"

namespace volumark {
namespace {

namespace parameters {
using namespace volume_parameters;
using namespace isosurface_parameters;

const Integer kSlices{{"slices",
                       "percent",
                       "slices to draw for each 100 stored ones; those between are interpolated",
                       100,
                       100,
                       12800,
                       {100, 200, 400, 800},
                       Ideal<int64_t>{800, "step"}}};
const Flag kInterpolation{"interpolation",
                          "on: slices between two stored ones are blended from them; off: the nearest stored one", true,
                          Ideal<bool>{true, "interpolation of slices"}};
}  // namespace parameters

// VM_GRADIENTS.
enum class Gradients { None, Gradients, Normals };
Gradients gradients_of(const Scene& scene, const Values& values) {
  if (!scene.effects.lighting) return Gradients::None;
  return parameters::kNormals(values) == "interpolated" ? Gradients::Normals : Gradients::Gradients;
}

double expected_order(const Values& values) {
  // Formats with few bits have an error that no number of slices removes; slices that are not interpolated and normals
  // of the voxels tend to other pictures.
  const std::string& format = parameters::kVolumeFormat(values);
  if (parameters::kNormals(values) == "interpolated" || !parameters::kInterpolation(values) ||
      parameters::kGradientFormat(values) != "rgba32f" || (format != "native" && format != "r32f")) {
    return 0;
  }
  return parameters::kRefine(values) == "linear" ? 2 : 1;
}

StackSettings settings_of(const Scene& scene, const Values& values) {
  StackSettings settings;
  settings.volume.volume_format = parameters::kVolumeFormat(values);
  settings.volume.table_size = 2;  // no table is read
  const Gradients gradients = gradients_of(scene, values);
  if (gradients != Gradients::None) {
    settings.data = false;
    settings.gradient =
        GradientSettings{gradients == Gradients::Normals, GradientAlpha::Scalar, parameters::kGradientFormat(values)};
  }
  return settings;
}

bool half_floats(const Scene& scene, const Values& values) {
  return scene.effects.lighting ? parameters::kGradientFormat(values) == "rgba16f"
                                : parameters::kVolumeFormat(values) == "r16f";
}

// Slabs between slices: one from each slice to the next, one before the first and one behind the last, which for more
// than one stored slice are nothing but these slices. Slab k lies around position(k).
Slices slabs_between(const Slices& slices) {
  Slices slabs = slices;
  slabs.count = slices.count + 1;
  slabs.first = slices.first - 0.5 * slices.distance;
  return slabs;
}

class PreparedIsoSlices2d final : public PreparedMethod {
 public:
  PreparedIsoSlices2d(const Scene& scene, const Values& values, Device& device)
      : scene_(scene),
        device_(device),
        front_to_back_(parameters::kOrder(values) == "front_to_back"),
        half_floats_(half_floats(scene, values)),
        percent_(parameters::kSlices(values)),
        stacks_(scene, settings_of(scene, values), device),
        uniforms_(device, "slice uniforms"),
        surface_(device, "surface uniforms"),
        vertices_(device, "slice vertices"),
        depths_(device, "slice depths"),
        indices_(device, "slice indices"),
        depth_target_(device) {
    ProgramDesc program;
    program.label = "slices2d_iso";
    program.stages = {&programs::slices2d_iso_vert, &programs::slices2d_iso_frag};
    program.bindings = SliceStacks::declarations();
    program.bindings.push_back({kSurfaceBinding, BindingKind::Uniform, 0});
    program.constants = VolumeResources::constants(scene, Classification::Post, false);
    program.constants.push_back({"VM_REFINE", parameters::kRefine(values) == "linear" ? 1 : 0});
    program.constants.push_back({"VM_GRADIENTS", static_cast<int32_t>(gradients_of(scene, values))});
    program.constants.push_back({"VM_INTERPOLATE", parameters::kInterpolation(values) ? 1 : 0});
    program.cpu = &slices2d_iso_twin;
    program_ = device.create_program(program);
    PipelineDesc pipeline;
    pipeline.label = "slices2d_iso";
    pipeline.program = program_;
    pipeline.vertex_layouts = {{sizeof(PolygonVertex), false, {{0, 2, 0}, {1, 1, offsetof(PolygonVertex, first)}}},
                               {sizeof(float), false, {{2, 1, 0}}}};
    pipeline.colour_format = target_format_of(values);
    pipeline.has_depth_stencil = pipeline.depth_test = pipeline.depth_write = front_to_back_;
    pipeline_ = device.create_pipeline(pipeline);
  }
  ~PreparedIsoSlices2d() override {
    device_.destroy(pipeline_);
    device_.destroy(program_);
  }
  PreparedIsoSlices2d(const PreparedIsoSlices2d&) = delete;
  PreparedIsoSlices2d& operator=(const PreparedIsoSlices2d&) = delete;

  void render(const View& view, Device& device, Texture target) override;
  Counters counters() const override { return counters_; }

 private:
  VolumeUniforms uniforms_of(const View& view, const Slices& slabs, int axis, int width, int height) const;
  SurfaceUniforms surface_of(const VolumeUniforms& uniforms) const;

  Scene scene_;  // shares the volume
  Device& device_;
  bool front_to_back_, half_floats_;
  int64_t percent_;
  SliceStacks stacks_;
  GrowingBuffer uniforms_, surface_, vertices_, depths_, indices_;
  DepthTarget depth_target_;
  Program program_;
  Pipeline pipeline_;
  SliceGroupMesh mesh_;
  Counters counters_;
};

VolumeUniforms PreparedIsoSlices2d::uniforms_of(const View& view, const Slices& slabs, int axis, int width,
                                                int height) const {
  VolumeUniforms uniforms = turned(volume_uniforms(scene_, view, width, height), axis);
  stacks_.fill(uniforms);
  uniforms.own[0] = {2.F / static_cast<float>(width), -2.F / static_cast<float>(height), 0,
                     static_cast<float>(slabs.stored - 1)};
  uniforms.own[3] = {static_cast<float>(slabs.first), static_cast<float>(slabs.distance), 0, 0};
  return uniforms;
}

SurfaceUniforms PreparedIsoSlices2d::surface_of(const VolumeUniforms& uniforms) const {
  return surface_uniforms(scene_, {half_floats_ ? Format::RGBA16F : Format::RGBA32F, uniforms.value[0],
                                   uniforms.value[1], uniforms.texel[0], uniforms.texel[1]});
}

void PreparedIsoSlices2d::render(const View& view, Device& device, Texture target) {
  const int width = device.desc(target).width, height = device.desc(target).height;
  device.begin_zone("classify");
  const ViewRays rays = view_rays(*scene_.volume, view, width, height);
  const int axis = best_stack(*scene_.volume, rays);
  const StackLayout& layout = stacks_.layout(axis);
  const Slices slices = slices_of(layout.slices, percent_), slabs = slabs_between(slices);
  const ViewRays stack_rays = turned(rays, axis);
  const glm::dvec3 extent = turned(scene_.volume->extent(), axis);
  std::vector<SliceGroup> groups = slice_groups(slabs, layout, stack_rays, extent, 1);
  if (front_to_back_) std::reverse(groups.begin(), groups.end());
  // An eighth of a pixel more: rasterizers move corners, and fragments know themselves where the volume ends.
  build_groups(slabs, groups, stack_rays, extent, true, {0.25 / width, 0.25 / height}, mesh_);
  const std::vector<float> depths = drawing_depths(mesh_.indices, mesh_.vertices.size(), mesh_.polygons);
  device.end_zone();

  DrawDesc draw;
  Buffer blocks, surface;
  if (!mesh_.indices.empty()) {
    device.begin_zone("upload");
    const VolumeUniforms uniforms = uniforms_of(view, slabs, axis, width, height);
    blocks = uniforms_.upload(page_blocks(layout, uniforms));
    surface = surface_.upload(bytes_of(surface_of(uniforms)));
    draw.pipeline = pipeline_;
    draw.vertex_buffers = {vertices_.upload(bytes_of(mesh_.vertices)), depths_.upload(bytes_of(depths))};
    draw.index_buffer = indices_.upload(bytes_of(mesh_.indices));
    device.end_zone();
  }
  device.begin_zone("raster");
  PassDesc pass;
  pass.label = "slices";
  pass.colour = target;
  if (front_to_back_) pass.depth_stencil = depth_target_.of(width, height);
  device.begin_pass(pass);
  for (const SliceRun& run : mesh_.runs) {
    draw.bindings = stacks_.bindings(axis, run.page, bind_page_block(blocks, run.page));
    draw.bindings.push_back(bind_uniform(kSurfaceBinding, surface));
    draw.first = run.first_index;
    draw.count = run.index_count;
    device.draw(draw);
  }
  device.end_pass();
  device.end_zone();

  counters_ = {{"stack_axis", axis},
               {"slices", slices.count},
               {"polygons", mesh_.polygons},
               {"vertices", static_cast<int64_t>(mesh_.vertices.size())},
               {"draws", static_cast<int64_t>(mesh_.runs.size())},
               {"texture_bytes", static_cast<int64_t>(stacks_.texture_bytes())}};
}

class Slices2dIso final : public Method {
 public:
  const MethodInfo& info() const override {
    static const MethodInfo info{
        "slices2d_iso",
        "Isosurface by object-aligned slices of 2D textures and the alpha test, without blending",
        "rezksalama2000",
        {parameters::kSlices.info(), parameters::kOrder.info(), parameters::kRefine.info(), parameters::kNormals.info(),
         parameters::kInterpolation.info(), parameters::kTargetFormat.info(), parameters::kVolumeFormat.info(),
         parameters::kGradientFormat.info()},
        {"lighting", "clip_planes"},
        expected_order,
        {},
        {Display::Isosurface}};
    return info;
  }
  std::optional<std::string> unsupported(const Scene& scene, const Values& values,
                                         const BackendInfo& backend) const override {
    return stacks_unsupported(scene, settings_of(scene, values).volume, backend);
  }
  std::unique_ptr<PreparedMethod> prepare(const Scene& scene, const Values& values, Device& device) const override {
    return std::make_unique<PreparedIsoSlices2d>(scene, values, device);
  }
  Format target_format(const Values& values) const override { return target_format_of(values); }
};

}  // namespace

const Method& slices2d_iso() {
  static const Slices2dIso method;
  return method;
}

}  // namespace volumark
