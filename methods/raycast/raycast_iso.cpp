#include "methods/raycast/raycast_iso.h"

#include <algorithm>
#include <cmath>

#include "methods/raycast/bricks.h"
#include "methods/raycast/ray_parameters.h"
#include "methods/volume/growing_buffer.h"
#include "methods/volume/isosurface.h"
#include "methods/volume/volume_parameters.h"
#include "methods/volume/volume_resources.h"
#include "methods/volume/volume_texels.h"
#include "programs/raycast_iso_frag.h"
#include "programs/raycast_vert.h"

namespace volumark {
namespace {

namespace parameters {
using namespace ray_parameters;
using volume_parameters::kTargetFormat;
using volume_parameters::kVolumeFormat;

const Choice kRefine{"refine",
                     "where in the first segment that holds the surface it is met: none: at its far end; linear: on "
                     "the line between the values of both ends; bisection: six halvings, then the line",
                     {"none", "linear", "bisection"},
                     "bisection",
                     Ideal<const char*>{"bisection", "position of the surface"}};
}  // namespace parameters

int refinements(const Values& values) {
  const int counts[] = {0, 1, kBisections + 1};
  return counts[parameters::kRefine.index(values)];
}

VolumeSettings settings_of(const Values& values) {
  VolumeSettings settings;
  settings.volume_format = parameters::kVolumeFormat(values);
  settings.table_size = 1;  // no table is made
  return settings;
}

// Where the surface is met errs by a step or by its square; with bisection the misses of thin parts are all that is
// left, and these have no order.
double expected_order(const Values& values) {
  const std::string& format = parameters::kVolumeFormat(values);
  if ((format != "native" && format != "r32f") || refinements(values) > 1 ||
      target_format_of(values) != Format::RGBA32F)
    return 0;
  return refinements(values) + 1;
}

class PreparedRaycastIso final : public PreparedMethod {
 public:
  PreparedRaycastIso(const Scene& scene, const Values& values, Device& device)
      : scene_(scene),
        device_(device),
        step_(parameters::kStep(values) * smallest_spacing(*scene.volume)),
        uniforms_(device, "raycast uniforms"),
        surface_(device, "surface uniforms") {
    create_volume(values);
    create_distances(values);
    create_program(values);
  }
  ~PreparedRaycastIso() override {
    device_.destroy(pipeline_);
    device_.destroy(program_);
    device_.destroy(distances_);
    device_.destroy(volume_);
  }
  PreparedRaycastIso(const PreparedRaycastIso&) = delete;
  PreparedRaycastIso& operator=(const PreparedRaycastIso&) = delete;

  void render(const View& view, Device& device, Texture target) override {
    const TextureDesc& image = device.desc(target);
    const int width = image.width, height = image.height;
    device.begin_zone("upload");
    const SurfaceUniforms surface = surface_uniforms(scene_, texels_);
    DrawDesc draw;
    draw.pipeline = pipeline_;
    draw.bindings = {bind_uniform(0, uniforms_.upload(bytes_of(uniforms_of(view, width, height)))),
                     bind_sampled(1, volume_, {Filter::Linear, Wrap::Clamp}),
                     bind_sampled(4, distances_, {Filter::Nearest, Wrap::Clamp}),
                     bind_uniform(kSurfaceBinding, surface_.upload(bytes_of(surface)))};
    draw.count = 3;
    device.end_zone();
    device.begin_zone("raster");
    device.begin_pass({.label = "raycast_iso", .colour = target, .depth_stencil = {}});
    device.draw(draw);
    device.end_pass();
    device.end_zone();
    counters_["rays"] = static_cast<int64_t>(width) * height;
  }
  Counters counters() const override { return counters_; }

 private:
  void create_volume(const Values& values) {
    const VolumeTexels texels = volume_texels(scene_, settings_of(values));
    texels_ = {texels.format, texels.value_origin, texels.value_scale};
    const glm::ivec3& size = scene_.volume->size;
    const std::span<const std::byte> data = texels.of(*scene_.volume);
    volume_ = device_.create_texture({.label = "volume",
                                      .dimension = 3,
                                      .format = texels.format,
                                      .width = size.x,
                                      .height = size.y,
                                      .depth = size.z,
                                      .data = data});
    counters_["texture_bytes"] = static_cast<int64_t>(data.size());
  }

  // Bricks without a value in the solid. Where nothing is skipped the program still names the texture: one brick.
  void create_distances(const Values& values) {
    bricks_.count = {1, 1, 1};
    BrickDistances found{{0}, 1};
    if (parameters::skips(values)) {
      device_.begin_zone("classify");
      const Volume& volume = *scene_.volume;
      bricks_ = brick_ranges(volume, static_cast<int>(parameters::kBrickSize(values)));
      // Wider by what texture and filter may round.
      const double size = std::max({std::abs(volume.min_value), std::abs(volume.max_value),
                                    std::abs(scene_.transfer.lo), std::abs(scene_.transfer.hi)});
      const double widen = texture_rounding(volume, parameters::kVolumeFormat(values)) + 0x1p-18 * size;
      std::vector<uint8_t> occupied(bricks_.hi.size());
      std::transform(bricks_.hi.begin(), bricks_.hi.end(), occupied.begin(), [&](float hi) {
        return static_cast<uint8_t>(static_cast<double>(hi) + widen >= scene_.isosurface->value);
      });
      found = brick_distances(bricks_.count, occupied);
      device_.end_zone();
      counters_["bricks"] = static_cast<int64_t>(found.distance.size());
      counters_["bricks_occupied"] = found.occupied;
    }
    distances_ = device_.create_texture({.label = "brick distances",
                                         .dimension = 3,
                                         .format = Format::R8,
                                         .width = bricks_.count.x,
                                         .height = bricks_.count.y,
                                         .depth = bricks_.count.z,
                                         .data = bytes_of(found.distance)});
    counters_["texture_bytes"] += static_cast<int64_t>(found.distance.size());
  }

  void create_program(const Values& values) {
    ProgramDesc program;
    program.label = "raycast_iso";
    program.stages = {&programs::raycast_vert, &programs::raycast_iso_frag};
    program.bindings = {{0, BindingKind::Uniform, 0},
                        {1, BindingKind::Sampled, 3},
                        {4, BindingKind::Sampled, 3},
                        {kSurfaceBinding, BindingKind::Uniform, 0}};
    program.constants = VolumeResources::constants(scene_, Classification::Post, false);
    program.constants.push_back({"VM_SKIP_EMPTY", parameters::skips(values) ? 1 : 0});
    // Without light it does not show where.
    program.constants.push_back({"VM_REFINE", scene_.effects.lighting ? refinements(values) : 0});
    program.cpu = &raycast_iso_cpu;
    program_ = device_.create_program(program);
    PipelineDesc pipeline;
    pipeline.label = "raycast_iso";
    pipeline.program = program_;
    pipeline.colour_format = target_format_of(values);
    pipeline_ = device_.create_pipeline(pipeline);
  }

  VolumeUniforms uniforms_of(const View& view, int width, int height) const {
    VolumeUniforms uniforms = volume_uniforms(scene_, view, width, height);
    uniforms.value = {texels_.value_origin, texels_.value_scale, 0, 0};
    uniforms.depth[3] = static_cast<float>(step_);
    put_bricks(bricks_, *scene_.volume, uniforms);
    return uniforms;
  }

  Scene scene_;  // shares the volume
  Device& device_;
  double step_;  // world units
  GrowingBuffer uniforms_, surface_;
  SurfaceTexels texels_;
  BrickRanges bricks_;
  Texture volume_, distances_;
  Program program_;
  Pipeline pipeline_;
  Counters counters_;
};

class RaycastIso final : public Method {
 public:
  const MethodInfo& info() const override {
    static const MethodInfo info{
        "raycast_iso",
        "Isosurface by ray casting: the first segment that holds it, then a search inside, with empty-space skipping",
        "Levoy 1988; Hadwiger et al. 2005",
        {parameters::kStep.info(), parameters::kRefine.info(), parameters::kSkipEmpty.info(),
         parameters::kBrickSize.info(), parameters::kVolumeFormat.info(), parameters::kTargetFormat.info()},
        {"lighting", "clip_planes"},
        expected_order,
        {},
        {Display::Isosurface}};
    return info;
  }
  std::optional<std::string> unsupported(const Scene& scene, const Values& values,
                                         const BackendInfo& backend) const override {
    if (auto reason = too_many_segments(scene, values, backend)) return reason;
    return volume_unsupported(scene, settings_of(values), backend);
  }
  std::unique_ptr<PreparedMethod> prepare(const Scene& scene, const Values& values, Device& device) const override {
    return std::make_unique<PreparedRaycastIso>(scene, values, device);
  }
  Format target_format(const Values& values) const override { return target_format_of(values); }
};

}  // namespace

const Method& raycast_iso() {
  static const RaycastIso kMethod;
  return kMethod;
}

}  // namespace volumark
