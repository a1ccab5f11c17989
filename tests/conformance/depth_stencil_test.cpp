// Depth and stencil: every comparison, every operation, both faces, and what is read back.
#include <cstring>

#include "tests/conformance/fixture.h"

namespace volumark::conformance {
namespace {

constexpr std::array<float, 4> kGreen{0, 1, 0, 1};

bool holds(Compare compare, int a, int b) {
  switch (compare) {
    case Compare::Never:
      return false;
    case Compare::Less:
      return a < b;
    case Compare::Equal:
      return a == b;
    case Compare::LessEqual:
      return a <= b;
    case Compare::Greater:
      return a > b;
    case Compare::NotEqual:
      return a != b;
    case Compare::GreaterEqual:
      return a >= b;
    case Compare::Always:
      return true;
  }
  return false;
}
constexpr std::array kCompares = {Compare::Never,   Compare::Less,     Compare::Equal,        Compare::LessEqual,
                                  Compare::Greater, Compare::NotEqual, Compare::GreaterEqual, Compare::Always};

struct DepthStencil {
  float depth;
  uint32_t stencil;
};
DepthStencil first_texel(Canvas& canvas) {
  canvas.device.submit_and_wait();
  const auto bytes = canvas.device.read_texture(canvas.pass.depth_stencil);
  DepthStencil out;
  std::memcpy(&out, bytes.data(), sizeof out);
  return out;
}

TEST(Depth, EveryComparison) {
  Canvas canvas(2, 2, Format::RGBA32F, true);
  for (const Compare compare : kCompares) {
    const auto pipeline = canvas.pipeline(Kind::Flat, [&](PipelineDesc& desc) {
      desc.depth_test = true;
      desc.depth_compare = compare;
    });
    for (const int quarter : {1, 2, 3}) {
      canvas.pass.depth_value = 0.5f;
      canvas.begin();
      canvas.draw(pipeline, screen(kGreen, static_cast<float>(quarter) / 4));
      canvas.end();
      EXPECT_EQ(canvas.at(canvas.read(), 0, 0)[1], holds(compare, quarter, 2) ? 1.f : 0.f)
          << static_cast<int>(compare) << ' ' << quarter;
    }
  }
}

TEST(Depth, WritesCanBeOff) {
  for (const bool write : {false, true}) {
    Canvas canvas(2, 2, Format::RGBA32F, true);
    const auto pipeline = canvas.pipeline(Kind::Flat, [&](PipelineDesc& desc) {
      desc.depth_test = true;
      desc.depth_write = write;
    });
    canvas.begin();
    canvas.draw(pipeline, screen(kGreen, 0.25f));
    canvas.end();
    EXPECT_NEAR(first_texel(canvas).depth, write ? 0.25f : 1.f, 1e-6f);
  }
}

TEST(Depth, NearestWinsInAnyOrder) {
  Canvas canvas(8, 8, Format::RGBA32F, true);
  const auto pipeline =
      canvas.pipeline(Kind::Flat, [](PipelineDesc& desc) { desc.depth_test = desc.depth_write = true; });
  canvas.begin();
  canvas.draw(pipeline, screen({0, 0, 1, 1}, 0.25f));
  canvas.draw(pipeline, screen({1, 0, 0, 1}, 0.75f));
  canvas.draw(pipeline, rectangle(-1, -1, 0, 1, kGreen, 0.125f));
  canvas.end();
  const auto texels = canvas.read();
  expect_texel(canvas.at(texels, 1, 4), kGreen);
  expect_texel(canvas.at(texels, 6, 4), {0, 0, 1, 1});
}

uint32_t apply(StencilOp op, uint32_t value, uint32_t reference) {
  switch (op) {
    case StencilOp::Keep:
      return value;
    case StencilOp::Zero:
      return 0;
    case StencilOp::Replace:
      return reference;
    case StencilOp::IncrementClamp:
      return value == 255 ? 255 : value + 1;
    case StencilOp::DecrementClamp:
      return value == 0 ? 0 : value - 1;
    case StencilOp::Invert:
      return ~value & 0xffu;
    case StencilOp::IncrementWrap:
      return (value + 1) & 0xffu;
    case StencilOp::DecrementWrap:
      return (value - 1) & 0xffu;
  }
  return value;
}

TEST(Stencil, EveryOperation) {
  Canvas canvas(2, 2, Format::RGBA32F, true);
  for (const StencilOp op :
       {StencilOp::Keep, StencilOp::Zero, StencilOp::Replace, StencilOp::IncrementClamp, StencilOp::DecrementClamp,
        StencilOp::Invert, StencilOp::IncrementWrap, StencilOp::DecrementWrap}) {
    const auto pipeline = canvas.pipeline(Kind::Flat, [&](PipelineDesc& desc) {
      desc.stencil_test = true;
      desc.stencil_front.pass = op;
      desc.stencil_reference = 77;
    });
    for (const int start : {0, 5, 255}) {
      canvas.pass.stencil_value = static_cast<uint8_t>(start);
      canvas.begin();
      canvas.draw(pipeline, screen(kGreen));
      canvas.end();
      EXPECT_EQ(first_texel(canvas).stencil & 0xffu, apply(op, static_cast<uint32_t>(start), 77))
          << static_cast<int>(op) << ' ' << start;
    }
  }
}

TEST(Stencil, EveryComparisonOfReferenceWithValue) {
  Canvas canvas(2, 2, Format::RGBA32F, true);
  for (const Compare compare : kCompares) {
    const auto pipeline = canvas.pipeline(Kind::Flat, [&](PipelineDesc& desc) {
      desc.stencil_test = true;
      desc.stencil_front.compare = compare;
      desc.stencil_reference = 0xf2;
      desc.stencil_read_mask = 0x0f;
    });
    for (const int value : {1, 2, 3}) {
      canvas.pass.stencil_value = static_cast<uint8_t>(value | 0xa0);  // the high bits are masked away
      canvas.begin();
      canvas.draw(pipeline, screen(kGreen));
      canvas.end();
      EXPECT_EQ(canvas.at(canvas.read(), 0, 0)[1], holds(compare, 2, value) ? 1.f : 0.f)
          << static_cast<int>(compare) << ' ' << value;
    }
  }
}

TEST(Stencil, FailDepthFailAndPassAreToldApart) {
  Canvas canvas(2, 2, Format::RGBA32F, true);
  const auto pipeline = canvas.pipeline(Kind::Flat, [](PipelineDesc& desc) {
    desc.depth_test = desc.stencil_test = true;
    desc.stencil_front = {Compare::Equal, StencilOp::Zero, StencilOp::Invert, StencilOp::IncrementWrap};
    desc.stencil_reference = 9;
  });
  const auto result = [&](uint8_t stencil, float z) {
    canvas.pass.stencil_value = stencil;
    canvas.pass.depth_value = 0.5f;
    canvas.begin();
    canvas.draw(pipeline, screen(kGreen, z));
    canvas.end();
    return first_texel(canvas).stencil & 0xffu;
  };
  EXPECT_EQ(result(8, 0.25f), 0u);
  EXPECT_EQ(result(9, 0.75f), 0xf6u);
  EXPECT_EQ(result(9, 0.25f), 10u);
}

TEST(Stencil, FacesHaveTheirOwnStateAndWritesAreMasked) {
  Canvas canvas(2, 2, Format::RGBA32F, true);
  const auto pipeline = canvas.pipeline(Kind::Flat, [](PipelineDesc& desc) {
    desc.stencil_test = true;
    desc.stencil_front.pass = StencilOp::IncrementWrap;
    desc.stencil_back.pass = StencilOp::DecrementWrap;
    desc.colour_write = false;
    desc.stencil_write_mask = 0x0f;
  });
  auto back = screen(kGreen);
  for (size_t i = 0; i < back.size(); i += 3) std::swap(back[i + 1], back[i + 2]);
  canvas.begin();
  canvas.draw(pipeline, screen(kGreen));
  canvas.draw(pipeline, screen(kGreen));
  canvas.draw(pipeline, back);
  canvas.end();
  EXPECT_EQ(first_texel(canvas).stencil & 0xffu, 1u);
  canvas.begin();
  canvas.draw(pipeline, back);
  canvas.end();
  EXPECT_EQ(first_texel(canvas).stencil & 0xffu, 0x0fu);
}

TEST(DepthStencil, APassKeepsWhatItDoesNotClear) {
  Canvas canvas(2, 2, Format::RGBA32F, true);
  canvas.pass.depth_value = 0.375f;
  canvas.pass.stencil_value = 42;
  canvas.begin();
  canvas.end();
  canvas.pass.clear_depth_stencil = false;
  canvas.begin();
  canvas.end();
  const DepthStencil texel = first_texel(canvas);
  EXPECT_EQ(texel.depth, 0.375f);
  EXPECT_EQ(texel.stencil & 0xffu, 42u);
}

}  // namespace
}  // namespace volumark::conformance
