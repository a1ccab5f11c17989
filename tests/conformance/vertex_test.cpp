// Where vertices come from: buffers, offsets, indices, instances, the geometry stage.
#include "programs/expand_geom.h"
#include "programs/flat_frag.h"
#include "programs/flat_vert.h"
#include "programs/instanced_vert.h"
#include "tests/conformance/fixture.h"

namespace volumark::conformance {
namespace {

constexpr std::array<float, 4> kRed{1, 0, 0, 1};

TEST(Vertices, FirstSkipsVertices) {
  Canvas canvas(4, 2);
  const auto pipeline = canvas.pipeline(Kind::Flat);
  auto all = rectangle(-1, -1, 0, 1, {0, 1, 0, 1});
  const auto right = rectangle(0, -1, 1, 1, kRed);
  all.insert(all.end(), right.begin(), right.end());
  DrawDesc draw;
  draw.pipeline = pipeline;
  draw.vertex_buffers = {canvas.vertices(all)};
  draw.first = 6;
  draw.count = 6;
  canvas.begin();
  canvas.device.draw(draw);
  canvas.end();
  const auto texels = canvas.read();
  expect_texel(canvas.at(texels, 0, 0), {0, 0, 0, 0});
  expect_texel(canvas.at(texels, 3, 0), kRed);
}

TEST(Vertices, Indexed) {
  Canvas canvas(4, 4);
  const auto pipeline = canvas.pipeline(Kind::Flat, [](PipelineDesc& desc) { desc.blend = Blend::Add; });
  const std::vector<Vertex> corners = {{{-1, -1, 0.5f, 1}, {1, 0, 0, 1}},
                                       {{1, -1, 0.5f, 1}, {1, 0, 0, 1}},
                                       {{1, 1, 0.5f, 1}, {1, 0, 0, 1}},
                                       {{-1, 1, 0.5f, 1}, {1, 0, 0, 1}}};
  const std::vector<uint32_t> indices = {9, 9, 9, 0, 1, 2, 0, 2, 3};
  DrawDesc draw;
  draw.pipeline = pipeline;
  draw.vertex_buffers = {canvas.vertices(corners)};
  draw.index_buffer =
      canvas.device.create_buffer({.label = "indices", .size = indices.size() * 4, .data = bytes_of(indices)});
  draw.first = 3;
  draw.count = 6;
  canvas.begin();
  canvas.device.draw(draw);
  canvas.end();
  for (const auto& texel : canvas.read()) expect_texel(texel, kRed);
}

struct InstancedCanvas : Canvas {
  InstancedCanvas() : Canvas(8, 1) {
    const Program instanced = device.create_program(
        {.label = "instanced", .stages = {&programs::instanced_vert, &programs::flat_frag}, .cpu = &kInstanced});
    PipelineDesc desc;
    desc.label = "instanced";
    desc.program = instanced;
    desc.vertex_layouts = {{.stride = 16, .attributes = {{0, 4, 0}}},
                           {.stride = 16, .per_instance = true, .attributes = {{1, 4, 0}}}};
    instanced_pipeline = device.create_pipeline(desc);
  }
  Pipeline instanced_pipeline;
};

TEST(Vertices, InstancesHaveTheirOwnAttributesAndIndex) {
  InstancedCanvas canvas;
  const auto cell = rectangle(-1, -1, -0.75f, 1, {});
  std::vector<std::array<float, 4>> positions, offsets;
  for (const Vertex& vertex : cell) {
    positions.push_back({vertex.position[0], vertex.position[1], vertex.position[2], vertex.position[3]});
  }
  for (int i = 0; i < 8; ++i) offsets.push_back({0.25f * static_cast<float>(i), 0, 0, 0});
  DrawDesc draw;
  draw.pipeline = canvas.instanced_pipeline;
  draw.vertex_buffers = {
      canvas.device.create_buffer({.label = "cell", .size = positions.size() * 16, .data = bytes_of(positions)}),
      canvas.device.create_buffer({.label = "offsets", .size = offsets.size() * 16, .data = bytes_of(offsets)})};
  draw.count = 6;
  draw.instances = 8;
  canvas.begin();
  canvas.device.draw(draw);
  canvas.end();
  const auto texels = canvas.read();
  for (int x = 0; x < 8; ++x) {
    const auto got = canvas.at(texels, x, 0);
    EXPECT_EQ(got[0], static_cast<float>(x));
    EXPECT_GE(got[1], 0.f);  // the vertex index, interpolated
    EXPECT_LE(got[1], 5.f);
    EXPECT_EQ(got[3], 1.f);
  }
}

TEST(Vertices, VertexIndexCountsFromFirstAndIsTheIndexValue) {
  InstancedCanvas canvas;
  const std::vector<std::array<float, 4>> positions(4, {-1.f, -1.f, 0.5f, 1.f});
  std::vector<std::array<float, 4>> offsets = {{0, 0, 0, 0}};
  std::vector<std::array<float, 4>> triangle = {{-1, -1, 0.5f, 1}, {-1, -1, 0.5f, 1}, {-1, -1, 0.5f, 1},
                                                {-1, -1, 0.5f, 1}, {7, -1, 0.5f, 1},  {-1, 7, 0.5f, 1}};
  const std::vector<uint32_t> indices = {3, 4, 5};
  DrawDesc draw;
  draw.pipeline = canvas.instanced_pipeline;
  draw.vertex_buffers = {
      canvas.device.create_buffer({.label = "triangle", .size = triangle.size() * 16, .data = bytes_of(triangle)}),
      canvas.device.create_buffer({.label = "offsets", .size = offsets.size() * 16, .data = bytes_of(offsets)})};
  draw.count = 3;
  for (const bool indexed : {false, true}) {
    draw.first = indexed ? 0 : 3;
    if (indexed) {
      draw.index_buffer = canvas.device.create_buffer({.label = "indices", .size = 12, .data = bytes_of(indices)});
    }
    canvas.begin();
    canvas.device.draw(draw);
    canvas.end();
    // Vertices 3, 4, 5 at (-1,-1), (7,-1), (-1,7): the value at (x, y) is 3 + (x+1)/8 + 2 (y+1)/8.
    const auto texels = canvas.read();
    for (int x = 0; x < 8; ++x) {
      const float ndc = 2 * (static_cast<float>(x) + 0.5f) / 8 - 1;
      EXPECT_NEAR(canvas.at(texels, x, 0)[1], 3 + (ndc + 1) / 8 + 2 * 1.f / 8, 1e-5f) << indexed;
    }
  }
}

TEST(Vertices, GeometryStageOrAReason) {
  Canvas canvas(4, 4);
  const ProgramDesc expand{
      .label = "expand", .stages = {&programs::flat_vert, &programs::expand_geom, &programs::flat_frag}, .cpu = &kFlat};
  if (!canvas.device.has(Capability::GeometryStage)) {
    expect_refused(DeviceErrorKind::MissingCapability, "create_program", [&] { canvas.device.create_program(expand); });
    bool reasoned = false;
    for (const auto& [capability, why] : canvas.device.info().absent) {
      reasoned |= capability == Capability::GeometryStage && !why.empty();
    }
    EXPECT_TRUE(reasoned);
    return;
  }
  PipelineDesc desc;
  desc.label = "expand";
  desc.program = canvas.device.create_program(expand);
  desc.vertex_layouts = {{.stride = sizeof(Vertex), .attributes = {{0, 4, 0}, {1, 4, 16}}}};
  desc.topology = Topology::Points;
  const auto pipeline = canvas.device.create_pipeline(desc);
  canvas.begin();
  canvas.draw(pipeline, {{{-1, 0, 0.5f, 1}, {1, 0, 0, 1}}});
  canvas.end();
  const auto texels = canvas.read();
  expect_texel(canvas.at(texels, 0, 0), kRed);
  expect_texel(canvas.at(texels, 1, 1), kRed);
  expect_texel(canvas.at(texels, 2, 1), {0, 0, 0, 0});
  expect_texel(canvas.at(texels, 1, 2), {0, 0, 0, 0});
}

}  // namespace
}  // namespace volumark::conformance
