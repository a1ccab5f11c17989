#include "tests/conformance/fixture.h"

#include <functional>

#include "programs/flat_frag.h"
#include "programs/flat_vert.h"
#include "programs/sample1d_frag.h"
#include "programs/sample2d_frag.h"
#include "programs/sample3d_frag.h"
#include "programs/special_frag.h"
#include "programs/window_frag.h"

namespace volumark::conformance {
namespace {

struct KindRow {
  const ShaderText* fragment;
  const CpuProgram* twin;
  std::vector<BindingDecl> bindings;
};

KindRow row_of(Kind kind) {
  switch (kind) {
    case Kind::Flat:
      return {&programs::flat_frag, &kFlat, {}};
    case Kind::Window:
      return {&programs::window_frag, &kWindow, {}};
    case Kind::Special:
      return {&programs::special_frag, &kSpecial, {{3, BindingKind::Uniform, 0}}};
    case Kind::Sample1D:
      return {&programs::sample1d_frag, &kSample[0], {{1, BindingKind::Sampled, 1}}};
    case Kind::Sample2D:
      return {&programs::sample2d_frag, &kSample[1], {{1, BindingKind::Sampled, 2}}};
    case Kind::Sample3D:
      return {&programs::sample3d_frag, &kSample[2], {{1, BindingKind::Sampled, 3}}};
  }
  return {};
}

}  // namespace

Canvas::Canvas(int width, int height, Format format, bool depth_stencil)
    : device(make_device(backend_id(), device_options())), width_(width), height_(height), format_(format) {
  pass.label = "canvas";
  pass.colour =
      device.create_texture({.label = "canvas", .format = format, .width = width, .height = height, .target = true});
  if (depth_stencil) {
    pass.depth_stencil = device.create_texture(
        {.label = "canvas depth", .format = Format::D32FS8, .width = width, .height = height, .target = true});
  }
}

Program Canvas::program(Kind kind, std::vector<SpecConstant> constants) {
  const KindRow row = row_of(kind);
  return device.create_program({.label = row.twin->name,
                                .stages = {&programs::flat_vert, row.fragment},
                                .bindings = row.bindings,
                                .constants = std::move(constants),
                                .cpu = row.twin});
}

Pipeline Canvas::pipeline(Kind kind, const std::function<void(PipelineDesc&)>& edit,
                          std::vector<SpecConstant> constants) {
  PipelineDesc desc;
  desc.label = "test pipeline";
  desc.program = program(kind, std::move(constants));
  desc.vertex_layouts = {{.stride = sizeof(Vertex), .attributes = {{0, 4, 0}, {1, 4, 16}}}};
  desc.colour_format = format_;
  desc.has_depth_stencil = static_cast<bool>(pass.depth_stencil);
  if (edit) edit(desc);
  return device.create_pipeline(desc);
}

Buffer Canvas::vertices(const std::vector<Vertex>& vertices) {
  return device.create_buffer(
      {.label = "vertices", .size = vertices.size() * sizeof(Vertex), .data = bytes_of(vertices)});
}

void Canvas::draw(Pipeline pipeline, const std::vector<Vertex>& vertex_list, std::vector<Binding> bindings) {
  DrawDesc draw;
  draw.pipeline = pipeline;
  draw.vertex_buffers = {vertices(vertex_list)};
  draw.bindings = std::move(bindings);
  draw.count = static_cast<uint32_t>(vertex_list.size());
  device.draw(draw);
}

std::vector<std::array<float, 4>> Canvas::read() {
  device.submit_and_wait();
  const auto bytes = device.read_texture(pass.colour);
  std::vector<std::array<float, 4>> texels;
  for (size_t at = 0; at < bytes.size(); at += texel_bytes(format_)) {
    texels.push_back(decode_texel(format_, bytes.data() + at));
  }
  return texels;
}

std::vector<Vertex> rectangle(float x0, float y0, float x1, float y1, std::array<float, 4> c, float z) {
  const auto vertex = [&](float x, float y) { return Vertex{{x, y, z, 1}, {c[0], c[1], c[2], c[3]}}; };
  return {vertex(x0, y0), vertex(x1, y0), vertex(x1, y1), vertex(x0, y0), vertex(x1, y1), vertex(x0, y1)};
}

std::vector<Vertex> screen(std::array<float, 4> colour, float z) { return rectangle(-1, -1, 1, 1, colour, z); }

void expect_texel(const std::array<float, 4>& got, const std::array<float, 4>& want, float tolerance) {
  for (size_t c = 0; c < 4; ++c) EXPECT_NEAR(got[c], want[c], tolerance) << "channel " << c;
}

}  // namespace volumark::conformance
