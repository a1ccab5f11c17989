#include "methods/shell_slices/shell_slicer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <glm/packing.hpp>

#include "methods/volume/volume_resources.h"
#include "programs/shell_slices_frag.h"
#include "programs/shell_slices_lit_frag.h"

namespace volumark {
namespace {

constexpr Format kFormats[] = {Format::RGBA32F, Format::RGBA16F, Format::RGBA8};

float largest_channel(const ShellTexture& texture) {
  float largest = 0;
  for (const glm::vec4& texel : texture.texels) {
    largest = std::max({largest, texel.r, texel.g, texel.b, texel.a});
  }
  return largest;
}

// Texels in units of `scale`.
std::vector<std::byte> packed(const ShellTexture& texture, Format format, float scale) {
  const size_t size = texel_bytes(format);
  std::vector<std::byte> out(texture.texels.size() * size);
  for (size_t i = 0; i < texture.texels.size(); ++i) {
    const glm::vec4 texel = texture.texels[i] / scale;
    std::byte* at = out.data() + i * size;
    if (format == Format::RGBA32F) {
      std::memcpy(at, &texel, size);
    } else if (format == Format::RGBA16F) {
      const uint64_t bits = glm::packHalf4x16(texel);
      std::memcpy(at, &bits, size);
    } else {
      const uint32_t bits = glm::packUnorm4x8(texel);
      std::memcpy(at, &bits, size);
    }
  }
  return out;
}

}  // namespace

std::vector<ParameterInfo> shell_parameter_list(const std::vector<ParameterInfo>& own) {
  using namespace shell_parameters;
  std::vector<ParameterInfo> out = {kPlanes.info()};
  out.insert(out.end(), own.begin(), own.end());
  for (const ParameterInfo& info :
       {kReject.info(), kOpacityCorrection.info(), kTargetFormat.info(), kTextureFormat.info()}) {
    out.push_back(info);
  }
  return out;
}

std::optional<std::string> shell_unsupported(const Scene& scene, size_t bytes_a_prism, const BackendInfo& backend) {
  if (!scene.shell) return "the scene's shell is not loaded";
  const size_t lights = scene.effects.lighting ? scene.effects.lighting->lights.size() : 0;
  if (lights > kMaxLights) return fmt::format("{} lights; at most {}", lights, kMaxLights);
  const glm::ivec3 size = scene.shell->colours->size;
  if (std::max({size.x, size.y, size.z}) > backend.limits.texture_3d) {
    return fmt::format("a texture of {} x {} x {} texels; {} takes {} an axis", size.x, size.y, size.z, backend.id,
                       backend.limits.texture_3d);
  }
  const size_t bytes = bytes_a_prism * scene.shell->prisms();
  if (bytes > backend.limits.storage_buffer_bytes) {
    return fmt::format("{} bytes of vertices; {} takes {} in a storage buffer", bytes, backend.id,
                       backend.limits.storage_buffer_bytes);
  }
  return std::nullopt;
}

ShellSlicer::ShellSlicer(const Scene& scene, const Values& values, Device& device, const Variant& variant)
    : device_(device),
      lit_(scene.effects.lighting.has_value()),
      shell_(shell_prisms(*scene.shell, lit_)),
      reject_(static_cast<Reject>(shell_parameters::kReject.index(values))),
      scene_(scene),
      label_(variant.label),
      planes_(static_cast<int>(shell_parameters::kPlanes(values))),
      uniforms_(device, "shell uniforms"),
      light_(device, "shell lights") {
  try {
    create_texture(*scene.shell->colours, shell_parameters::kTextureFormat.index(values));
    create_pipeline(values, variant);
  } catch (...) {
    release();
    throw;
  }
}

ShellSlicer::~ShellSlicer() { release(); }

void ShellSlicer::release() {
  if (pipeline_) device_.destroy(pipeline_);
  if (program_) device_.destroy(program_);
  if (texture_) device_.destroy(texture_);
}

void ShellSlicer::create_texture(const ShellTexture& texture, size_t format) {
  texture_size_ = texture.size;
  const float largest = largest_channel(texture);
  if (format > 0 && largest > 0) texture_scale_ = largest;
  greatest_extinction_ = std::max(texture.greatest_extinction(), 1e-30F);
  const std::vector<std::byte> data = packed(texture, kFormats[format], texture_scale_);
  TextureDesc desc;
  desc.label = "volumetric texture";
  desc.dimension = 3;
  desc.format = kFormats[format];
  desc.width = texture.size.x;
  desc.height = texture.size.y;
  desc.depth = texture.size.z;
  desc.data = data;
  texture_ = device_.create_texture(desc);
  texture_bytes_ = data.size();
}

void ShellSlicer::create_pipeline(const Values& values, const Variant& variant) {
  ProgramDesc program;
  program.label = variant.label;
  program.stages = {variant.vertex, &programs::shell_slices_frag};
  program.bindings = {{4, BindingKind::Uniform}, {1, BindingKind::Sampled, 3}};
  if (lit_) {
    program.stages = {variant.lit_vertex, &programs::shell_slices_lit_frag};
    program.bindings.push_back({0, BindingKind::Uniform});
  }
  program.bindings.insert(program.bindings.end(), variant.bindings.begin(), variant.bindings.end());
  const bool linear = shell_parameters::kOpacityCorrection.index(values) == 1;
  program.constants = VolumeResources::constants(scene_, Classification::Post, linear);
  program.constants.insert(program.constants.end(), variant.constants.begin(), variant.constants.end());
  program.cpu = variant.cpu;
  program_ = device_.create_program(program);
  PipelineDesc pipeline;
  pipeline.label = variant.label;
  pipeline.program = program_;
  pipeline.vertex_layouts = variant.vertex_layouts;
  pipeline.blend = Blend::Over;
  pipeline.colour_format = target_format_of(values);
  pipeline_ = device_.create_pipeline(pipeline);
}

// What of the block does not depend on planes.
void ShellSlicer::fill(ShellFrame& frame) const {
  const glm::vec3 size(texture_size_);
  ShellUniforms& u = frame.uniforms;
  u.texture = {.5F / size.z, 1 - .5F / size.z, static_cast<float>(frame.step), texture_scale_};
  u.texel = {1 / size.x, 1 / size.y, 1 / size.z, 0};
  // Gradients in greatest extinctions a radius of the shell: of a size that floats can square at any scale.
  const float unit = .5F * texture_scale_ / greatest_extinction_;
  u.slope = {unit * size.x, unit * size.y, unit * size.z, 0};
}

// What add_lights() and normal_of() of volume_common.glsl read, in world axes around the shell's middle.
VolumeUniforms ShellSlicer::light(const View& view) const {
  const Lighting& lighting = *scene_.effects.lighting;
  const auto float4 = [](const glm::dvec3& v, double w) {
    return Float4{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
  };
  VolumeUniforms uniforms;
  fill_lights(lighting, shell_.middle, glm::dmat3(1), uniforms);
  uniforms.extent = float4(glm::dvec3(2 * shell_.radius), 0);
  uniforms.eye = float4(view.eye - shell_.middle, view.perspective ? 1 : 0);
  uniforms.forward = float4(frame_of(view).forward, 0);
  uniforms.gradient_scale[3] = static_cast<float>(gradient_floor(lighting, *scene_.shell) * shell_.radius /
                                                  static_cast<double>(greatest_extinction_));
  return uniforms;
}

void ShellSlicer::render(const View& view, Device& device, Texture target) {
  const int width = device.desc(target).width, height = device.desc(target).height;
  device.begin_zone("classify");
  ShellFrame frame = shell_frame(shell_, view, width, height, planes_);
  tests_ = {};
  classify(frame);
  device.end_zone();

  device.begin_zone("upload");
  fill(frame);
  std::vector<DrawDesc> draws = upload(frame);
  if (!draws.empty()) {
    const Buffer block = uniforms_.upload(bytes_of(frame.uniforms));
    const Buffer lights = lit_ ? light_.upload(bytes_of(light(view))) : Buffer{};
    for (DrawDesc& draw : draws) {
      draw.pipeline = pipeline_;
      draw.bindings.push_back(bind_uniform(4, block));
      if (lit_) draw.bindings.push_back(bind_uniform(0, lights));
      draw.bindings.push_back(bind_sampled(1, texture_, {Filter::Linear, Wrap::Repeat}));
    }
  }
  device.end_zone();

  device.begin_zone("raster");
  PassDesc pass;
  pass.label = label_;
  pass.colour = target;
  device.begin_pass(pass);
  for (const DrawDesc& draw : draws) device.draw(draw);
  device.end_pass();
  device.end_zone();

  counters_ = {{"prisms", static_cast<int64_t>(shell_.prisms.size())},
               {"excluded", shell_.degenerate + shell_.self_intersecting},
               {"self_intersecting", shell_.self_intersecting},
               {"degenerate", shell_.degenerate},
               {"planes", frame.planes},
               {"tests", tests_.tests},
               {"rejected", tests_.rejected},
               {"draws", static_cast<int64_t>(draws.size())},
               {"texture_bytes", static_cast<int64_t>(texture_bytes_)}};
  count(counters_);
}

std::vector<BindingDecl> storage_bindings(std::initializer_list<uint32_t> slots, const Scene& scene) {
  std::vector<BindingDecl> out;
  for (const uint32_t slot : slots) out.push_back({slot, BindingKind::Storage});
  if (scene.effects.lighting) out.push_back({7, BindingKind::Storage});
  return out;
}

void SectionCounts::put(Counters& counters) const {
  counters["triangles"] = by_corners[3];
  counters["quadrilaterals"] = by_corners[4];
  counters["pentagons"] = by_corners[5];
  counters["twisted"] = twisted;
}

}  // namespace volumark
