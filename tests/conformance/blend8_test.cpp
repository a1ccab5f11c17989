// 8-bit targets: every pair of levels, every blend, bit for bit against Mesa's integers written down a second time
// here. OpenGL and Vulkan leave the rounding of 8-bit blending to the GPU: on software drivers and on the cpu backend
// one bit is an error, on other GPUs the largest deviation is printed, and one level is the bound.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "tests/conformance/fixture.h"

namespace volumark::conformance {
namespace {

constexpr int kLevels = 256;
using Level4 = std::array<int, 4>;

// lp_build_mul_norm of Mesa's gallivm: an 8-bit product by shifts.
int product(int a, int b) {
  const int p = a * b;
  return (p + (p >> 8) + 128) >> 8;
}

Level4 blended(Blend blend, const Level4& s, const Level4& d) {
  Level4 out{};
  for (size_t c = 0; c < 4; ++c) {
    switch (blend) {
      case Blend::Opaque:
        out[c] = s[c];
        break;
      case Blend::Over:
        out[c] = s[c] + product(d[c], 255 - s[3]);
        break;
      case Blend::Under:
        out[c] = d[c] + product(s[c], 255 - d[3]);
        break;
      case Blend::Add:
        out[c] = s[c] + d[c];
        break;
    }
    out[c] = std::min(out[c], 255);
  }
  return out;
}

std::array<float, 4> as_float(const Level4& levels) {
  std::array<float, 4> value{};
  for (size_t c = 0; c < 4; ++c) value[c] = static_cast<float>(levels[c]) / 255.f;
  return value;
}

// NDC of the left (lower) edge of strip i.
float edge(int i) { return static_cast<float>(i) / (kLevels / 2.f) - 1; }

// Column i of a 256 x 256 target is filled with column(i), then row j is blended with row(j).
template <class Column, class Row>
int largest_deviation(Blend blend, Column&& column, Row&& row) {
  Canvas canvas(kLevels, kLevels, Format::RGBA8);
  std::vector<Vertex> columns, rows;
  for (int i = 0; i < kLevels; ++i) {
    const auto below = rectangle(edge(i), -1, edge(i + 1), 1, as_float(column(i)));
    const auto above = rectangle(-1, -edge(i + 1), 1, -edge(i), as_float(row(i)));  // row 0 is the top
    columns.insert(columns.end(), below.begin(), below.end());
    rows.insert(rows.end(), above.begin(), above.end());
  }
  const auto opaque = canvas.pipeline(Kind::Flat);
  const auto blending = canvas.pipeline(Kind::Flat, [&](PipelineDesc& desc) { desc.blend = blend; });
  canvas.begin();
  canvas.draw(opaque, columns);
  canvas.draw(blending, rows);
  canvas.end();
  canvas.device.submit_and_wait();
  const auto bytes = canvas.device.read_texture(canvas.pass.colour);
  int largest = 0;
  for (int j = 0; j < kLevels; ++j) {
    for (int i = 0; i < kLevels; ++i) {
      const Level4 want = blended(blend, row(j), column(i));
      for (size_t c = 0; c < 4; ++c) {
        const int got = std::to_integer<int>(bytes[static_cast<size_t>(j * kLevels + i) * 4 + c]);
        const int deviation = std::abs(got - want[c]);
        if (deviation > largest) {
          std::printf("source %d (alpha %d) onto %d (alpha %d): %d, Mesa's integers %d\n", row(j)[c], row(j)[3],
                      column(i)[c], column(i)[3], got, want[c]);
        }
        largest = std::max(largest, deviation);
      }
    }
  }
  return largest;
}

void expect_bits(int deviation) {
  Canvas canvas(1, 1);
  const bool software = canvas.device.info().software;
  std::printf("largest deviation of 8-bit blending: %d levels\n", deviation);
  EXPECT_LE(deviation, software ? 0 : 1);
}

TEST(Blending8, OverIsTheSameForEveryAlphaAndLevel) {
  // Colours of black, of white premultiplied, and of one that saturates.
  const auto source = [](int a) { return Level4{0, a, 255, a}; };
  expect_bits(largest_deviation(
      Blend::Over,
      [](int i) {
        return Level4{i, i, i, i};
      },
      source));
}

TEST(Blending8, OverOntoOtherLevelsOfAlpha) {
  const auto source = [](int a) { return Level4{a / 2, a / 3, a, a}; };
  expect_bits(largest_deviation(
      Blend::Over,
      [](int i) {
        return Level4{i / 2, i / 5, 255 - i, i};
      },
      source));
}

TEST(Blending8, UnderIsTheSameForEveryAlphaAndLevel) {
  const auto target = [](int a) { return Level4{0, a, 255, a}; };
  expect_bits(largest_deviation(Blend::Under, target, [](int j) { return Level4{j, j, j, j}; }));
  expect_bits(largest_deviation(Blend::Under, target, [](int j) { return Level4{j, j / 2, 255 - j, 255 - j}; }));
}

TEST(Blending8, AddSaturates) {
  expect_bits(largest_deviation(
      Blend::Add,
      [](int i) {
        return Level4{i, 255 - i, i / 2, i};
      },
      [](int j) {
        return Level4{j, j, j / 3, 255 - j};
      }));
}

// A fragment's float becomes the nearest level before it is blended: the sum does not see what was below it.
TEST(Blending8, SourcesAreRoundedFirst) {
  Canvas canvas(kLevels, 8, Format::RGBA8);
  const auto opaque = canvas.pipeline(Kind::Flat);
  const auto over = canvas.pipeline(Kind::Flat, [](PipelineDesc& desc) { desc.blend = Blend::Over; });
  const auto add = canvas.pipeline(Kind::Flat, [](PipelineDesc& desc) { desc.blend = Blend::Add; });
  // Row by row: how far each source is from its level, in levels.
  constexpr std::array<float, 8> kOff{-0.45f, -0.3f, -0.1f, 0, 0.1f, 0.3f, 0.45f, 0.499f};
  std::vector<Vertex> sources;
  for (int j = 0; j < 8; ++j) {
    for (int i = 0; i < kLevels; ++i) {
      const float value = (static_cast<float>(i) + kOff[static_cast<size_t>(j)]) / 255.f;
      const float y = 1 - static_cast<float>(j) / 4;
      const auto one = rectangle(edge(i), y - 0.25f, edge(i + 1), y, {value, value / 2, value / 3, value});
      sources.insert(sources.end(), one.begin(), one.end());
    }
  }
  const auto source = [&](int i, int j, float part) {
    const float value = (static_cast<float>(i) + kOff[static_cast<size_t>(j)]) / 255.f;
    return static_cast<int>(std::lrint(std::clamp(value * part, 0.f, 1.f) * 255.f));
  };
  const Level4 target{200, 100, 50, 150};
  int largest = 0;
  for (const auto& [blend, pipeline] : {std::pair(Blend::Opaque, opaque), {Blend::Over, over}, {Blend::Add, add}}) {
    canvas.begin();
    canvas.draw(opaque, screen(as_float(target)));
    canvas.draw(pipeline, sources);
    canvas.end();
    canvas.device.submit_and_wait();
    const auto bytes = canvas.device.read_texture(canvas.pass.colour);
    for (int j = 0; j < 8; ++j) {
      for (int i = 0; i < kLevels; ++i) {
        const Level4 s{source(i, j, 1), source(i, j, 0.5f), source(i, j, 1.f / 3), source(i, j, 1)};
        const Level4 want = blended(blend, s, target);
        // A third or a half of a level may itself lie on a tie: only the exact channels count.
        for (const size_t c : {size_t{0}, size_t{3}}) {
          const int got = std::to_integer<int>(bytes[static_cast<size_t>(j * kLevels + i) * 4 + c]);
          largest = std::max(largest, std::abs(got - want[c]));
        }
      }
    }
  }
  expect_bits(largest);
}

// Case 9 of the suite in small: white at k / 255 over itself stalls where the product takes back what a layer adds.
// With products to nearest that is ceil(255 - 127.5 / k): 128, 192, 224, 240, 248; Mesa's come one level earlier for k
// > 1.
TEST(Blending8, AccumulationStallsWhereTheProductRounds) {
  for (const auto& [level, stalls] : {std::pair(1, 128), {2, 191}, {4, 223}, {8, 239}, {16, 247}}) {
    Canvas canvas(4, 4, Format::RGBA8);
    const auto over = canvas.pipeline(Kind::Flat, [](PipelineDesc& desc) { desc.blend = Blend::Over; });
    std::vector<Vertex> layers;
    for (int i = 0; i < 512; ++i) {
      const auto one = screen(as_float({level, level, level, level}));
      layers.insert(layers.end(), one.begin(), one.end());
    }
    canvas.begin();
    canvas.draw(over, layers);
    canvas.end();
    canvas.device.submit_and_wait();
    const int got = std::to_integer<int>(canvas.device.read_texture(canvas.pass.colour)[0]);
    EXPECT_NEAR(got, stalls, canvas.device.info().software ? 0 : 1) << "white at " << level << "/255";
  }
}

}  // namespace
}  // namespace volumark::conformance
