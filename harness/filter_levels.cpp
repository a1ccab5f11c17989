#include "harness/filter_levels.h"

#include <array>
#include <cstring>
#include <set>

#include "backends/texel.h"
#include "harness/filter_levels_twin.h"
#include "programs/filter_levels_frag.h"
#include "programs/filter_levels_vert.h"

namespace volumark {
namespace {

constexpr int kEdge = 64;  // of the target, pixels; as in filter_levels.frag
static_assert(kEdge * kEdge == kFilterPlaces);

// What the measurement makes on a device, destroyed whatever happens.
struct Objects {
  explicit Objects(Device& made_on) : device(made_on) {}
  ~Objects() {
    device.abandon();
    try {
      if (pipeline) device.destroy(pipeline);
      if (program) device.destroy(program);
      if (target) device.destroy(target);
    } catch (const DeviceError&) {  // a lost device has nothing left to destroy
    }
  }
  Objects(const Objects&) = delete;

  Device& device;
  Program program;
  Pipeline pipeline;
  Texture target;
};

void make(Objects& objects) {
  Device& device = objects.device;
  ProgramDesc program;
  program.label = "filter levels";
  program.stages = {&programs::filter_levels_vert, &programs::filter_levels_frag};
  program.bindings = {{0, BindingKind::Sampled, 3}};
  program.cpu = &filter_levels_cpu;
  objects.program = device.create_program(program);
  PipelineDesc pipeline;
  pipeline.label = program.label;
  pipeline.program = objects.program;
  objects.pipeline = device.create_pipeline(pipeline);
  TextureDesc target;
  target.label = "filter levels target";
  target.width = target.height = kEdge;
  target.target = true;
  objects.target = device.create_texture(target);
}

// Two texels along x: 0 and 1.
Texture two_texels(Device& device, Format format) {
  std::vector<std::byte> texels(2 * texel_bytes(format));
  encode_texel(format, {0, 0, 0, 0}, texels.data());
  encode_texel(format, {1, 1, 1, 1}, texels.data() + texel_bytes(format));
  TextureDesc desc;
  desc.label = std::string("filter levels ") + to_string(format);
  desc.dimension = 3;
  desc.format = format;
  desc.width = 2;
  desc.data = texels;
  return device.create_texture(desc);
}

double levels(Objects& objects, Texture source) {
  Device& device = objects.device;
  PassDesc pass;
  pass.label = "filter levels";
  pass.colour = objects.target;
  device.begin_pass(pass);
  DrawDesc draw;
  draw.pipeline = objects.pipeline;
  draw.bindings = {bind_sampled(0, source)};
  draw.count = 3;
  device.draw(draw);
  device.end_pass();
  device.submit_and_wait();
  const std::vector<std::byte> texels = device.read_texture(objects.target);
  std::set<float> distinct;
  for (size_t i = 0; i < kFilterPlaces; ++i) {
    float red;
    std::memcpy(&red, texels.data() + i * texel_bytes(Format::RGBA32F), sizeof red);
    distinct.insert(red);
  }
  return static_cast<double>(distinct.size());
}

}  // namespace

std::map<std::string, double> measure_filter_levels(Device& device) {
  Objects objects(device);
  make(objects);
  std::map<std::string, double> out;
  for (const Format format : {Format::R8, Format::R16, Format::R16F, Format::R32F}) {
    Texture source;
    try {
      source = two_texels(device, format);
    } catch (const DeviceError& error) {
      if (error.kind != DeviceErrorKind::MissingCapability) throw;
      continue;
    }
    out[to_string(format)] = levels(objects, source);
    device.destroy(source);
  }
  return out;
}

}  // namespace volumark
