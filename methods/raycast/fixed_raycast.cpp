#include "methods/raycast/fixed_raycast.h"

#include <algorithm>

#include "programs/raycast_fixed_frag.h"
#include "programs/raycast_vert.h"

namespace volumark {
namespace {

class PreparedFixedRaycast final : public PreparedMethod {
 public:
  PreparedFixedRaycast(const Scene& scene, const FixedSettings& settings, double early_termination, Device& device)
      : scene_(scene),
        device_(device),
        step_(settings.step),
        // Below one level nothing passes: what is left then is 0.
        end_levels_(static_cast<float>(std::max(255 * early_termination, 0.5))),
        resources_(scene, settings, device) {
    uniforms_ = device_.create_buffer({.label = "raycast uniforms", .size = sizeof(FixedUniforms), .data = {}});
    ProgramDesc program;
    program.label = "raycast, fixed point";
    program.stages = {&programs::raycast_vert, &programs::raycast_fixed_frag};
    program.bindings = FixedResources::declarations();
    program.constants = FixedResources::constants(scene, settings);
    program.cpu = &raycast_fixed_cpu;
    program_ = device_.create_program(program);
    PipelineDesc pipeline;
    pipeline.label = program.label;
    pipeline.program = program_;
    pipeline.colour_format = Format::RGBA8;
    pipeline_ = device_.create_pipeline(pipeline);
  }
  ~PreparedFixedRaycast() override {
    device_.destroy(pipeline_);
    device_.destroy(program_);
    device_.destroy(uniforms_);
  }
  PreparedFixedRaycast(const PreparedFixedRaycast&) = delete;
  PreparedFixedRaycast& operator=(const PreparedFixedRaycast&) = delete;

  void render(const View& view, Device& device, Texture target) override {
    const TextureDesc& image = device.desc(target);
    device.begin_zone("upload");
    FixedUniforms uniforms = fixed_uniforms(scene_, view, image.width, image.height, step_);
    const ViewRays rays = view_rays(*scene_.volume, view, image.width, image.height);
    // In perspective, rays beside the middle are longer than the volume is deep; their last sample is found by its
    // place.
    uniforms.limit[3] = rays.perspective ? 4e6F : static_cast<float>(fixed_depths(*scene_.volume, rays, step_).count);
    uniforms.lighting[3] = end_levels_;
    device.update_buffer(uniforms_, 0, bytes_of(uniforms));
    device.end_zone();

    device.begin_zone("raster");
    device.begin_pass({.label = "raycast", .colour = target, .depth_stencil = {}});
    DrawDesc draw;
    draw.pipeline = pipeline_;
    draw.bindings = resources_.bindings(uniforms_);
    draw.count = 3;
    device.draw(draw);
    device.end_pass();
    device.end_zone();
    counters_ = {{"rays", static_cast<int64_t>(image.width) * image.height},
                 {"texture_bytes", static_cast<int64_t>(resources_.texture_bytes())}};
  }
  Counters counters() const override { return counters_; }

 private:
  Scene scene_;  // shares the volume
  Device& device_;
  double step_;  // world units
  float end_levels_;
  FixedResources resources_;
  Buffer uniforms_;
  Program program_;
  Pipeline pipeline_;
  Counters counters_;
};

}  // namespace

std::unique_ptr<PreparedMethod> prepare_fixed_raycast(const Scene& scene, const FixedSettings& settings,
                                                      double early_termination, Device& device) {
  return std::make_unique<PreparedFixedRaycast>(scene, settings, early_termination, device);
}

}  // namespace volumark
