// Compute: buffers, images, order with passes.
#include <cstring>
#include <numeric>

#include "programs/paint_comp.h"
#include "programs/scale_comp.h"
#include "tests/conformance/fixture.h"

namespace volumark::conformance {
namespace {

struct Scaler {
  explicit Scaler(Device& on, uint32_t n) : device(on), count(n) {
    program = device.create_program(
        {.label = "scale",
         .stages = {&programs::scale_comp},
         .bindings = {{0, BindingKind::Uniform, 0}, {1, BindingKind::Storage, 0}, {2, BindingKind::Storage, 0}},
         .cpu = &kScale});
    std::vector<float> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0.f);
    struct {
      float factor;
      uint32_t count;
      uint32_t pad[2];
    } parameters{2.f, count, {}};
    uniforms = device.create_buffer({.label = "uniforms", .size = sizeof parameters, .data = bytes_of(parameters)});
    source = device.create_buffer({.label = "source", .size = count * 4, .data = bytes_of(numbers)});
    result = device.create_buffer({.label = "result", .size = count * 4, .data = {}});
  }
  void run(Buffer from, Buffer to) {
    device.dispatch({.program = program,
                     .bindings = {bind_uniform(0, uniforms), bind_storage(1, from), bind_storage(2, to)},
                     .groups = {(count + 63) / 64, 1, 1}});
  }
  std::vector<float> read(Buffer buffer) {
    const auto bytes = device.read_buffer(buffer, 0, count * 4);
    std::vector<float> out(count);
    std::memcpy(out.data(), bytes.data(), bytes.size());
    return out;
  }
  Device& device;
  uint32_t count;
  Program program;
  Buffer uniforms, source, result;
};

TEST(Compute, EveryInvocationRunsOnce) {
  Canvas canvas(2, 2);
  Scaler scaler(canvas.device, 1000);  // the last group is not full
  scaler.run(scaler.source, scaler.result);
  const auto got = scaler.read(scaler.result);
  for (uint32_t i = 0; i < scaler.count; ++i)
    ASSERT_EQ(got[i], 2.f * static_cast<float>(i) + static_cast<float>(i / 64));
}

TEST(Compute, DispatchesSeeWhatCameBefore) {
  Canvas canvas(2, 2);
  Scaler scaler(canvas.device, 64);
  scaler.run(scaler.source, scaler.result);
  scaler.run(scaler.result, scaler.source);
  scaler.run(scaler.source, scaler.result);
  const auto got = scaler.read(scaler.result);
  for (uint32_t i = 0; i < 64; ++i) ASSERT_EQ(got[i], 8.f * static_cast<float>(i));
}

TEST(Compute, ImagesAreWrittenRowZeroFirst) {
  Canvas canvas(20, 11);
  const Program paint = canvas.device.create_program(
      {.label = "paint", .stages = {&programs::paint_comp}, .bindings = {{0, BindingKind::Image, 2}}, .cpu = &kPaint});
  const Texture picture =
      canvas.device.create_texture({.label = "picture", .width = 20, .height = 11, .storage = true});
  canvas.device.dispatch({.program = paint, .bindings = {bind_image(0, picture)}, .groups = {3, 2, 1}});
  const auto bytes = canvas.device.read_texture(picture);
  for (int y = 0; y < 11; ++y) {
    for (int x = 0; x < 20; ++x) {
      const auto texel = decode_texel(Format::RGBA32F, bytes.data() + static_cast<size_t>(y * 20 + x) * 16);
      ASSERT_EQ(texel, (std::array<float, 4>{static_cast<float>(x), static_cast<float>(y), 3, 4}));
    }
  }
  // And a pass that samples it comes after.
  const auto copy = canvas.pipeline(Kind::Sample2D);
  std::vector<Vertex> corners;
  for (Vertex vertex : screen({})) {
    vertex.colour[0] = (vertex.position[0] + 1) / 2;
    vertex.colour[1] = (1 - vertex.position[1]) / 2;
    corners.push_back(vertex);
  }
  canvas.begin();
  canvas.draw(copy, corners, {bind_sampled(1, picture, {Filter::Nearest, Wrap::Clamp})});
  canvas.end();
  expect_texel(canvas.at(canvas.read(), 17, 9), {17, 9, 3, 4});
}

}  // namespace
}  // namespace volumark::conformance
