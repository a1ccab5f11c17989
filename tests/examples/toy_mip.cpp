#include "tests/examples/toy_mip.h"

#include "methods/volume/volume_resources.h"
#include "methods/volume/volume_uniforms.h"
#include "programs/toy_mip_frag.h"
#include "programs/toy_mip_vert.h"

namespace volumark {
namespace {

const Integer kSamples{{"samples", "", "evenly spaced along each ray", 64, 1, 4096, {16, 32, 64, 128, 256}}};

class PreparedToyMip final : public PreparedMethod {
 public:
  PreparedToyMip(const Scene& scene, const Values& values, Device& device)
      : scene_(scene), device_(device), samples_(kSamples(values)), resources_(scene, VolumeSettings{}, device) {
    uniforms_ = device.create_buffer({.label = "toy_mip uniforms", .size = sizeof(VolumeUniforms), .data = {}});
    ProgramDesc program;
    program.label = "toy_mip";
    program.stages = {&programs::toy_mip_vert, &programs::toy_mip_frag};
    program.bindings = VolumeResources::declarations();
    program.constants = VolumeResources::constants(scene, Classification::Post, false);
    program.cpu = &toy_mip_cpu;
    program_ = device.create_program(program);
    PipelineDesc pipeline;
    pipeline.label = "toy_mip";
    pipeline.program = program_;
    pipeline_ = device.create_pipeline(pipeline);
  }
  ~PreparedToyMip() override {
    device_.destroy(pipeline_);
    device_.destroy(program_);
    device_.destroy(uniforms_);
  }

  void render(const View& view, Device& device, Texture target) override {
    const TextureDesc& image = device.desc(target);
    VolumeUniforms uniforms = volume_uniforms(scene_, view, image.width, image.height);
    resources_.fill(uniforms);
    uniforms.own[0][0] = static_cast<float>(samples_);
    device.begin_zone("upload");
    device.update_buffer(uniforms_, 0, bytes_of(uniforms));
    device.end_zone();
    device.begin_zone("raster");
    device.begin_pass({.label = "toy_mip", .colour = target, .depth_stencil = {}});
    DrawDesc draw;
    draw.pipeline = pipeline_;
    draw.bindings = resources_.bindings(uniforms_);
    draw.count = 3;
    device.draw(draw);
    device.end_pass();
    device.end_zone();
    counters_["rays"] = static_cast<int64_t>(image.width) * image.height;
  }
  Counters counters() const override { return counters_; }

 private:
  Scene scene_;  // shares the volume
  Device& device_;
  int64_t samples_;
  VolumeResources resources_;
  Buffer uniforms_;
  Program program_;
  Pipeline pipeline_;
  Counters counters_;
};

class ToyMip final : public Method {
 public:
  const MethodInfo& info() const override {
    static const MethodInfo info{.name = "toy_mip",
                                 .title = "Maximum intensity projection",
                                 .paper = "Wallis 1989",
                                 .parameters = {kSamples.info()},
                                 .effects = {"clip_planes"}};
    return info;
  }
  std::optional<std::string> unsupported(const Scene& scene, const Values&, const BackendInfo& backend) const override {
    return volume_unsupported(scene, VolumeSettings{}, backend);
  }
  std::unique_ptr<PreparedMethod> prepare(const Scene& scene, const Values& values, Device& device) const override {
    return std::make_unique<PreparedToyMip>(scene, values, device);
  }
  Format target_format(const Values&) const override { return Format::RGBA32F; }
};

}  // namespace

const Method& toy_mip() {
  static const ToyMip method;
  return method;
}

}  // namespace volumark
