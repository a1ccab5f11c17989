// What the Device costs on gl: the same 256 blended, textured slices drawn through it and by a bare loop of GL calls in
// a context of its own. Compare Slices/device with Slices/bare; the image is small, so that the calls weigh most.
#include <benchmark/benchmark.h>

#include <stdexcept>

#include "backends/backend.h"
#include "backends/gl/gl_context.h"
#include "backends/gl/gl_functions.h"

namespace volumark {
namespace {

constexpr int kSlices = 256, kVolume = 64, kImage = 64;
constexpr const char* kVertex = R"(#version 450
layout(location = 0) in vec4 corner;
layout(location = 0) out vec3 place;
void main() {
  gl_Position = vec4(corner.xy, 0, 1);
  place = vec3(corner.xy * 0.5 + 0.5, corner.z);
})";
constexpr const char* kFragment = R"(#version 450
layout(binding = 0) uniform sampler3D volume;
layout(location = 0) in vec3 place;
layout(location = 0) out vec4 colour;
void main() { colour = vec4(texture(volume, place).r * 0.01); })";

std::vector<float> slices() {
  constexpr float kCorners[6][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}};
  std::vector<float> out;
  for (int i = 0; i < kSlices; ++i) {
    const float z = (static_cast<float>(i) + 0.5f) / kSlices;
    for (const auto& corner : kCorners) out.insert(out.end(), {corner[0], corner[1], z, 1});
  }
  return out;
}

std::vector<float> volume() { return std::vector<float>(size_t{kVolume} * kVolume * kVolume, 0.5f); }

void device_slices(benchmark::State& state) {
  Device device(make_gl_backend({}));
  const std::vector<float> texels = volume(), corners = slices();
  const Texture source = device.create_texture({.label = "volume",
                                                .dimension = 3,
                                                .format = Format::R32F,
                                                .width = kVolume,
                                                .height = kVolume,
                                                .depth = kVolume,
                                                .data = bytes_of(texels)});
  const Texture target = device.create_texture({.label = "target", .width = kImage, .height = kImage, .target = true});
  const Buffer buffer =
      device.create_buffer({.label = "slices", .size = corners.size() * 4, .data = bytes_of(corners)});
  const ShaderText vertex{"slices_vert", Stage::Vertex, kVertex, {}};
  const ShaderText fragment{"slices_frag", Stage::Fragment, kFragment, {}};
  ProgramDesc program;
  program.label = "slices";
  program.stages = {&vertex, &fragment};
  program.bindings = {{0, BindingKind::Sampled, 3}};
  PipelineDesc desc;
  desc.label = "slices";
  desc.program = device.create_program(program);
  desc.vertex_layouts = {{.stride = 16, .attributes = {{0, 4, 0}}}};
  desc.blend = Blend::Over;
  DrawDesc draw;
  draw.pipeline = device.create_pipeline(desc);
  draw.vertex_buffers = {buffer};
  draw.bindings = {bind_sampled(0, source)};
  draw.count = 6;
  PassDesc pass;
  pass.label = "slices";
  pass.colour = target;
  for (auto _ : state) {
    device.begin_pass(pass);
    for (uint32_t i = 0; i < kSlices; ++i) {
      draw.first = i * 6;
      device.draw(draw);
    }
    device.end_pass();
    device.submit_and_wait();
  }
  state.SetItemsProcessed(state.iterations() * kSlices);
}

GLuint bare_program(const GlFunctions& gl) {
  const GLuint program = gl.CreateProgram();
  for (const auto& [stage, text] : {std::pair{GL_VERTEX_SHADER, kVertex}, std::pair{GL_FRAGMENT_SHADER, kFragment}}) {
    const GLuint shader = gl.CreateShader(static_cast<GLenum>(stage));
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    gl.AttachShader(program, shader);
    gl.DeleteShader(shader);
  }
  gl.LinkProgram(program);
  GLint ok = GL_FALSE;
  gl.GetProgramiv(program, GL_LINK_STATUS, &ok);
  if (ok != GL_TRUE) throw std::runtime_error("the bare loop's program does not link");
  return program;
}

// Sets all state once; returns the framebuffer.
GLuint bare_setup(const GlFunctions& gl) {
  const std::vector<float> texels = volume(), corners = slices();
  GLuint source = 0, target = 0, framebuffer = 0, buffer = 0, vertex_array = 0, sampler = 0;
  gl.CreateTextures(GL_TEXTURE_3D, 1, &source);
  gl.TextureStorage3D(source, 1, GL_R32F, kVolume, kVolume, kVolume);
  gl.TextureSubImage3D(source, 0, 0, 0, 0, kVolume, kVolume, kVolume, GL_RED, GL_FLOAT, texels.data());
  gl.CreateTextures(GL_TEXTURE_2D, 1, &target);
  gl.TextureStorage2D(target, 1, GL_RGBA32F, kImage, kImage);
  gl.CreateFramebuffers(1, &framebuffer);
  gl.NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, target, 0);
  gl.CreateBuffers(1, &buffer);
  gl.NamedBufferStorage(buffer, static_cast<GLsizeiptr>(corners.size() * 4), corners.data(), 0);
  gl.CreateVertexArrays(1, &vertex_array);
  gl.EnableVertexArrayAttrib(vertex_array, 0);
  gl.VertexArrayAttribFormat(vertex_array, 0, 4, GL_FLOAT, GL_FALSE, 0);
  gl.CreateSamplers(1, &sampler);
  gl.SamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
    gl.SamplerParameteri(sampler, axis, GL_CLAMP_TO_EDGE);
  }
  gl.BindVertexArray(vertex_array);
  gl.BindVertexBuffer(0, buffer, 0, 16);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.Viewport(0, 0, kImage, kImage);
  gl.UseProgram(bare_program(gl));
  gl.BindTextureUnit(0, source);
  gl.BindSampler(0, sampler);
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl.Disable(GL_DITHER);
  return framebuffer;
}

void bare_slices(benchmark::State& state) {
  make_gl_backend({});  // for the driver's environment, as the Device has it
  const auto context = make_osmesa_context();
  context->make_current();
  const GlFunctions gl = load_gl_functions(*context);
  const GLuint framebuffer = bare_setup(gl);
  const float black[4] = {};
  for (auto _ : state) {
    gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, black);
    for (GLint i = 0; i < kSlices; ++i) gl.DrawArraysInstanced(GL_TRIANGLES, i * 6, 6, 1);
    gl.Finish();
  }
  if (const GLenum error = gl.GetError(); error != GL_NO_ERROR) state.SkipWithError("GL error");
  state.SetItemsProcessed(state.iterations() * kSlices);
}

BENCHMARK(device_slices)
    ->Name("Slices/device/gl")
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(bare_slices)->Name("Slices/bare/gl")->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace volumark
