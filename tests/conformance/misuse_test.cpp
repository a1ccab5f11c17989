// Everything that Device refuses, on a live backend: the call is named, nothing changes, and the Device works on.
#include "programs/flat_frag.h"
#include "programs/flat_vert.h"
#include "programs/scale_comp.h"
#include "tests/conformance/fixture.h"

namespace volumark::conformance {
namespace {

using K = DeviceErrorKind;

class Misuse : public testing::Test {
 protected:
  // Whatever was refused before: a correct frame must come out.
  void TearDown() override {
    canvas.begin();
    canvas.draw(flat, screen({1, 2, 3, 4}));
    canvas.end();
    expect_texel(canvas.at(canvas.read(), 1, 1), {1, 2, 3, 4});
  }
  DrawDesc good_draw() {
    DrawDesc draw;
    draw.pipeline = flat;
    draw.vertex_buffers = {canvas.vertices(screen({}))};
    draw.count = 6;
    return draw;
  }
  void refuse_draw(K kind, const DrawDesc& draw) {
    canvas.begin();
    expect_refused(kind, "draw", [&] { canvas.device.draw(draw); });
    canvas.end();
  }
  Canvas canvas{4, 4};
  Device& device = canvas.device;
  Pipeline flat = canvas.pipeline(Kind::Flat);
};

TEST_F(Misuse, Buffers) {
  const std::array<std::byte, 8> bytes{};
  expect_refused(K::BadArgument, "create_buffer", [&] { device.create_buffer({.label = "b", .size = 0, .data = {}}); });
  expect_refused(K::SizeMismatch, "create_buffer",
                 [&] { device.create_buffer({.label = "b", .size = 9, .data = bytes}); });
  const Buffer buffer = device.create_buffer({.label = "b", .size = 8, .data = bytes});
  expect_refused(K::OutOfRange, "update_buffer", [&] { device.update_buffer(buffer, 1, bytes); });
  expect_refused(K::OutOfRange, "update_buffer", [&] { device.update_buffer(buffer, ~size_t{0}, bytes); });
  expect_refused(K::OutOfRange, "read_buffer", [&] { device.read_buffer(buffer, 4, 5); });
  device.destroy(buffer);
  expect_refused(K::InvalidHandle, "update_buffer", [&] { device.update_buffer(buffer, 0, bytes); });
  expect_refused(K::InvalidHandle, "destroy", [&] { device.destroy(buffer); });
  expect_refused(K::InvalidHandle, "read_buffer", [&] { device.read_buffer(Buffer{}, 0, 1); });
}

TEST_F(Misuse, HandlesOfTheDeadAreNotHandlesOfTheirSuccessors) {
  const Buffer first = device.create_buffer({.label = "first", .size = 8, .data = {}});
  device.destroy(first);
  const Buffer second = device.create_buffer({.label = "second", .size = 8, .data = {}});
  EXPECT_EQ(first.index, second.index);
  expect_refused(K::InvalidHandle, "read_buffer", [&] { device.read_buffer(first, 0, 8); });
}

TEST_F(Misuse, Textures) {
  const auto refuse = [&](K kind, TextureDesc desc) {
    desc.label = "t";
    expect_refused(kind, "create_texture", [&] { device.create_texture(desc); });
  };
  const std::array<std::byte, 5> bytes{};
  refuse(K::BadArgument, {.dimension = 4});
  refuse(K::BadArgument, {.width = 0});
  refuse(K::BadArgument, {.width = -3});
  refuse(K::BadArgument, {.dimension = 2, .width = 2, .height = 2, .depth = 2});
  refuse(K::BadArgument, {.dimension = 1, .width = 2, .height = 2});
  refuse(K::BadArgument, {.dimension = 3, .width = 2, .height = 2, .depth = 2, .target = true});
  refuse(K::BadArgument, {.format = Format::D32FS8, .target = false});
  refuse(K::BadArgument, {.format = Format::R8, .storage = true});
  refuse(K::SizeMismatch, {.format = Format::R8, .width = 2, .height = 2, .data = bytes});
  expect_refused(K::InvalidHandle, "read_texture", [&] { device.read_texture(Texture{}); });
}

TEST_F(Misuse, Programs) {
  const auto refuse = [&](K kind, ProgramDesc desc) {
    desc.label = "p";
    desc.cpu = &kFlat;
    expect_refused(kind, "create_program", [&] { device.create_program(desc); });
  };
  refuse(K::BadArgument, {});
  refuse(K::BadArgument, {.stages = {&programs::flat_vert}});
  refuse(K::BadArgument, {.stages = {&programs::flat_frag}});
  refuse(K::BadArgument, {.stages = {nullptr}});
  refuse(K::BadArgument, {.stages = {&programs::flat_vert, &programs::flat_frag, &programs::scale_comp}});
  refuse(K::BadArgument,
         {.stages = {&programs::flat_vert, &programs::flat_frag}, .bindings = {{0, BindingKind::Sampled, 0}}});
  refuse(K::BadArgument, {.stages = {&programs::flat_vert, &programs::flat_frag},
                          .bindings = {{1, BindingKind::Uniform, 0}, {1, BindingKind::Storage, 0}}});
  refuse(K::OutOfRange,
         {.stages = {&programs::flat_vert, &programs::flat_frag}, .bindings = {{16, BindingKind::Uniform, 0}}});
}

TEST_F(Misuse, Pipelines) {
  const Program program = canvas.program(Kind::Flat);
  const auto refuse = [&](K kind, PipelineDesc desc) {
    desc.label = "p";
    if (!desc.program) desc.program = program;
    expect_refused(kind, "create_pipeline", [&] { device.create_pipeline(desc); });
  };
  refuse(K::BadArgument, {.colour_format = Format::D32FS8});
  refuse(K::BadArgument, {.depth_test = true});
  refuse(K::BadArgument, {.stencil_test = true});
  refuse(K::OutOfRange, {.vertex_layouts = {{.stride = 12, .attributes = {{0, 4, 0}}}}});
  refuse(K::OutOfRange, {.vertex_layouts = {{.stride = 64, .attributes = {{8, 4, 0}}}}});
  refuse(K::BadArgument, {.vertex_layouts = {{.stride = 64, .attributes = {{0, 5, 0}}}}});
  refuse(K::BadArgument, {.vertex_layouts = {{.stride = 64, .attributes = {{0, 4, 0}, {0, 4, 16}}}}});
  refuse(K::LimitExceeded, {.vertex_layouts = std::vector<VertexLayout>(5, VertexLayout{.stride = 16})});
  expect_refused(K::InvalidHandle, "create_pipeline", [&] { device.create_pipeline({.label = "p"}); });
  expect_refused(K::WrongState, "destroy", [&] {
    const Pipeline user =
        device.create_pipeline({.label = "user",
                                .program = program,
                                .vertex_layouts = {{.stride = sizeof(Vertex), .attributes = {{0, 4, 0}, {1, 4, 16}}}}});
    try {
      device.destroy(program);
    } catch (...) {
      device.destroy(user);
      throw;
    }
  });
  device.destroy(program);
}

TEST_F(Misuse, Passes) {
  expect_refused(K::WrongState, "end_pass", [&] { device.end_pass(); });
  expect_refused(K::InvalidHandle, "begin_pass", [&] { device.begin_pass({.label = "none"}); });
  const Texture plain = device.create_texture({.label = "plain", .width = 4, .height = 4});
  expect_refused(K::BadArgument, "begin_pass", [&] { device.begin_pass({.label = "plain", .colour = plain}); });
  const Texture small_depth =
      device.create_texture({.label = "depth", .format = Format::D32FS8, .width = 2, .height = 2, .target = true});
  expect_refused(K::SizeMismatch, "begin_pass", [&] {
    device.begin_pass({.label = "sizes", .colour = canvas.pass.colour, .depth_stencil = small_depth});
  });
  expect_refused(K::BadArgument, "begin_pass", [&] { device.begin_pass({.label = "depth", .colour = small_depth}); });
  canvas.begin();
  expect_refused(K::WrongState, "begin_pass", [&] { device.begin_pass(canvas.pass); });
  expect_refused(K::WrongState, "submit_and_wait", [&] { device.submit_and_wait(); });
  expect_refused(K::WrongState, "read_texture", [&] { device.read_texture(plain); });
  expect_refused(K::WrongState, "destroy", [&] { device.destroy(plain); });
  expect_refused(K::WrongState, "begin_zone", [&] { device.begin_zone("inside"); });
  canvas.end();
  expect_refused(K::WrongState, "draw", [&] { device.draw(good_draw()); });
}

TEST_F(Misuse, Draws) {
  DrawDesc draw = good_draw();
  draw.pipeline = {};
  refuse_draw(K::InvalidHandle, draw);
  draw = good_draw();
  draw.vertex_buffers.clear();
  refuse_draw(K::BadArgument, draw);
  draw = good_draw();
  draw.vertex_buffers[0] = {};
  refuse_draw(K::InvalidHandle, draw);
  draw = good_draw();
  draw.count = 7;
  refuse_draw(K::OutOfRange, draw);
  draw = good_draw();
  draw.first = 1;
  refuse_draw(K::OutOfRange, draw);
  draw = good_draw();
  draw.index_buffer = device.create_buffer({.label = "five", .size = 20, .data = {}});
  refuse_draw(K::OutOfRange, draw);
  draw = good_draw();
  draw.pipeline = canvas.pipeline(Kind::Flat, [](PipelineDesc& desc) { desc.colour_format = Format::RGBA8; });
  refuse_draw(K::BadArgument, draw);
  draw.pipeline = canvas.pipeline(Kind::Flat, [](PipelineDesc& desc) { desc.has_depth_stencil = true; });
  refuse_draw(K::BadArgument, draw);
}

TEST_F(Misuse, Bindings) {
  DrawDesc draw = good_draw();
  draw.pipeline = canvas.pipeline(Kind::Sample2D);
  refuse_draw(K::BadArgument, draw);  // missing
  draw.bindings = {bind_sampled(2, canvas.pass.colour)};
  refuse_draw(K::BadArgument, draw);  // another slot
  draw.bindings = {bind_uniform(1, draw.vertex_buffers[0])};
  refuse_draw(K::BadArgument, draw);  // another kind
  draw.bindings = {bind_sampled(1, {})};
  refuse_draw(K::InvalidHandle, draw);
  draw.bindings = {bind_sampled(1, canvas.pass.colour)};
  refuse_draw(K::WrongState, draw);  // the target itself
  draw.bindings = {bind_sampled(1, device.create_texture({.label = "3D", .dimension = 3, .width = 2}))};
  refuse_draw(K::BadArgument, draw);
  draw.pipeline = canvas.pipeline(Kind::Special, {}, {{"kMode", 0}, {"kScale", 1}});
  const Buffer colours = device.create_buffer({.label = "colours", .size = 300, .data = {}});
  draw.bindings = {bind_uniform(3, colours, 16, 32)};
  refuse_draw(K::OutOfRange, draw);
  draw.bindings = {bind_uniform(3, colours, 256, 64)};
  refuse_draw(K::OutOfRange, draw);
}

TEST_F(Misuse, DispatchesAndZones) {
  expect_refused(K::InvalidHandle, "dispatch", [&] { device.dispatch({}); });
  expect_refused(K::BadArgument, "dispatch", [&] { device.dispatch({.program = canvas.program(Kind::Flat)}); });
  const Program scale = device.create_program(
      {.label = "scale",
       .stages = {&programs::scale_comp},
       .bindings = {{0, BindingKind::Uniform, 0}, {1, BindingKind::Storage, 0}, {2, BindingKind::Storage, 0}},
       .cpu = &kScale});
  expect_refused(K::LimitExceeded, "dispatch", [&] { device.dispatch({.program = scale, .groups = {65536, 1, 1}}); });
  expect_refused(K::BadArgument, "dispatch", [&] { device.dispatch({.program = scale}); });
  expect_refused(K::BadArgument, "create_pipeline",
                 [&] { device.create_pipeline({.label = "compute", .program = scale}); });
  expect_refused(K::BadArgument, "begin_zone", [&] { device.begin_zone(""); });
  expect_refused(K::WrongState, "end_zone", [&] { device.end_zone(); });
  device.begin_zone("open");
  expect_refused(K::WrongState, "submit_and_wait", [&] { device.submit_and_wait(); });
  device.end_zone();
}

TEST_F(Misuse, AbandonClosesWhatIsOpen) {
  const Texture texture = device.create_texture({.label = "plain", .width = 4, .height = 4});
  device.begin_zone("outer");
  device.begin_zone("raster");
  canvas.begin();
  canvas.device.draw(good_draw());
  device.abandon();
  device.destroy(texture);  // allowed again
  device.submit_and_wait();
  device.abandon();  // nothing is open: nothing happens
}

}  // namespace
}  // namespace volumark::conformance
