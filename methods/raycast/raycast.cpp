#include "methods/raycast/raycast.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "methods/raycast/bricks.h"
#include "methods/raycast/fixed_raycast.h"
#include "methods/raycast/ray_parameters.h"
#include "methods/raycast/raycast_cpu.h"
#include "methods/volume/volume_parameters.h"
#include "methods/volume/volume_resources.h"
#include "methods/volume/volume_uniforms.h"
#include "programs/raycast_frag.h"
#include "programs/raycast_vert.h"

namespace volumark {
namespace {

using ray_parameters::kBrickSize;
using ray_parameters::kSkipEmpty;
using ray_parameters::kStep;
using ray_parameters::skips;
using volume_parameters::kPreintegratedSize;
using volume_parameters::kTableSize;
using volume_parameters::kTargetFormat;
using volume_parameters::kVolumeFormat;

const Choice kRayClassification{
    "classification",
    "post: transfer function at the middle of each segment; preintegrated: of the linear run of values between its two "
    "ends, with self-attenuation (a shorter last segment: opacity exact, colour to second order)",
    {"post", "preintegrated"},
    "post",
    Ideal<const char*>{"post", "classification"}};
const Number kEarlyTermination{{"early_termination",
                                "",
                                "a ray ends where less than this part of what lies behind can still be seen; 0 = off. "
                                "Errs by at most this times the brightest emission colour",
                                1.0 / 4096,
                                0,
                                0.5,
                                {},
                                Ideal<double>{0, "early termination"}}};
Classification classification(const Values& values) {
  return kRayClassification(values) == "preintegrated" ? Classification::Preintegrated : Classification::Post;
}

VolumeSettings settings_of(const Scene& scene, const Values& values) {
  VolumeSettings settings;
  settings.volume_format = kVolumeFormat(values);
  settings.classification = classification(values);
  settings.table_size = static_cast<int>(kTableSize(values));
  settings.preintegrated_size = static_cast<int>(kPreintegratedSize(values));
  settings.segment = scene.volume ? kStep(values) * smallest_spacing(*scene.volume) : 0;
  return settings;
}

MethodInfo make_info() {
  MethodInfo info;
  info.name = "raycast";
  info.title = "Ray casting in a loop, front to back, with empty-space skipping";
  info.paper = "Levoy 1988; Krueger and Westermann 2003";
  info.parameters = {kStep.info(),        kRayClassification.info(), kEarlyTermination.info(),  kSkipEmpty.info(),
                     kBrickSize.info(),   kTableSize.info(),         kPreintegratedSize.info(), kVolumeFormat.info(),
                     kTargetFormat.info()};
  info.effects = {"lighting", "clip_planes", "fixed_point"};
  info.exempt = {{"eight_bit_accumulation", "samples are summed in float registers, and the target rounds once"}};
  // Midpoint samples on the clipped ray, and pre-integrated segments with self-attenuation, are both of order 2. What
  // no step removes hides it: a target or a volume texture with few bits, rays that end early.
  info.expected_order = [](const Values& values) {
    const std::string& format = kVolumeFormat(values);
    const bool lossless = format == "native" || format == "r32f";
    return target_format_of(values) == Format::RGBA32F && lossless && !(kEarlyTermination(values) > 0) ? 2.0 : 0.0;
  };
  return info;
}

class PreparedRaycast final : public PreparedMethod {
 public:
  PreparedRaycast(const Scene& scene, const Values& values, Device& device)
      : scene_(scene),
        device_(device),
        step_(kStep(values) * smallest_spacing(*scene.volume)),
        early_termination_(kEarlyTermination(values)),
        resources_(scene, settings_of(scene, values), device) {
    create_distances(values);
    create_program(values);
  }
  ~PreparedRaycast() override {
    device_.destroy(pipeline_);
    device_.destroy(program_);
    device_.destroy(uniforms_);
    device_.destroy(distances_);
  }

  void render(const View& view, Device& device, Texture target) override {
    const TextureDesc& image = device.desc(target);
    device.begin_zone("upload");
    const VolumeUniforms uniforms = uniforms_for(view, image.width, image.height);
    device.update_buffer(uniforms_, 0, bytes_of(uniforms));
    device.end_zone();

    device.begin_zone("raster");
    device.begin_pass({.label = "raycast", .colour = target, .depth_stencil = {}});
    DrawDesc draw;
    draw.pipeline = pipeline_;
    draw.bindings = resources_.bindings(uniforms_);
    draw.bindings.push_back(bind_sampled(4, distances_, {Filter::Nearest, Wrap::Clamp}));
    draw.count = 3;
    device.draw(draw);
    device.end_pass();
    device.end_zone();
    counters_["rays"] = static_cast<int64_t>(image.width) * image.height;
  }
  Counters counters() const override { return counters_; }

 private:
  // Where nothing is skipped the program still names the texture: one brick.
  void create_distances(const Values& values) {
    const bool post = classification(values) == Classification::Post;
    const OpaqueValues opaque(scene_.transfer, classification(values),
                              static_cast<int>(post ? kTableSize(values) : kPreintegratedSize(values)));
    opaque_ = opaque.window();
    bricks_.count = {1, 1, 1};
    BrickDistances found{{0}, 1};
    if (skips(values)) {
      device_.begin_zone("classify");
      bricks_ = brick_ranges(*scene_.volume, static_cast<int>(kBrickSize(values)));
      found = brick_distances(bricks_, opaque, texture_rounding(*scene_.volume, kVolumeFormat(values)));
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
    counters_["texture_bytes"] = static_cast<int64_t>(resources_.texture_bytes() + found.distance.size());
  }

  void create_program(const Values& values) {
    uniforms_ = device_.create_buffer({.label = "raycast uniforms", .size = sizeof(VolumeUniforms), .data = {}});
    ProgramDesc program;
    program.label = "raycast";
    program.stages = {&programs::raycast_vert, &programs::raycast_frag};
    program.bindings = VolumeResources::declarations();
    program.bindings.push_back({4, BindingKind::Sampled, 3});
    program.constants = VolumeResources::constants(scene_, classification(values), false);
    program.constants.push_back({"VM_SKIP_EMPTY", skips(values) ? 1 : 0});
    program.cpu = &raycast_cpu;
    program_ = device_.create_program(program);
    PipelineDesc pipeline;
    pipeline.label = "raycast";
    pipeline.program = program_;
    pipeline.colour_format = target_format_of(values);
    pipeline_ = device_.create_pipeline(pipeline);
  }

  VolumeUniforms uniforms_for(const View& view, int width, int height) const {
    VolumeUniforms uniforms = volume_uniforms(scene_, view, width, height);
    resources_.fill(uniforms);
    uniforms.depth[3] = static_cast<float>(step_);
    put_bricks(bricks_, *scene_.volume, uniforms);
    uniforms.own[0][3] = static_cast<float>(early_termination_);
    uniforms.own[2] = {opaque_.lo, opaque_.hi, 0, 0};
    return uniforms;
  }

  Scene scene_;  // shares the volume
  Device& device_;
  double step_;  // world units
  double early_termination_;
  VolumeResources resources_;
  OpaqueValues::Window opaque_;
  BrickRanges bricks_;
  Texture distances_;
  Buffer uniforms_;
  Program program_;
  Pipeline pipeline_;
  Counters counters_;
};

class Raycast final : public Method {
 public:
  const MethodInfo& info() const override {
    static const MethodInfo kInfo = make_info();
    return kInfo;
  }
  std::optional<std::string> unsupported(const Scene& scene, const Values& values,
                                         const BackendInfo& backend) const override {
    if (auto reason = fixed_point_unsupported(scene, classification(values))) return reason;
    if (auto reason = too_many_segments(scene, values, backend)) return reason;
    return volume_unsupported(scene, settings_of(scene, values), backend);
  }
  std::unique_ptr<PreparedMethod> prepare(const Scene& scene, const Values& values, Device& device) const override {
    if (scene.effects.fixed_point) {
      const FixedSettings settings{classification(values), false, kStep(values) * smallest_spacing(*scene.volume)};
      const int bricks = skips(values) ? static_cast<int>(kBrickSize(values)) : 0;
      return prepare_fixed_raycast(scene, settings, {kEarlyTermination(values), bricks}, device);
    }
    return std::make_unique<PreparedRaycast>(scene, values, device);
  }
  Format target_format(const Values& values) const override { return target_format_of(values); }
};

}  // namespace

const Method& raycast() {
  static const Raycast kMethod;
  return kMethod;
}

}  // namespace volumark
