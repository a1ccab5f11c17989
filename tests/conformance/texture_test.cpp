// Textures of every format, filter, wrap and dimension against a model in double precision.
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/conformance/fixture.h"

namespace volumark::conformance {
namespace {

constexpr std::array kFormats = {Format::R8,  Format::R16,   Format::R16F,    Format::R32F,
                                 Format::RG8, Format::RGBA8, Format::RGBA16F, Format::RGBA32F};

struct Picture {
  TextureDesc desc;
  std::vector<std::byte> bytes;

  std::array<float, 4> texel(int x, int y, int z) const {
    const size_t at = static_cast<size_t>((z * desc.height + y) * desc.width + x);
    return decode_texel(desc.format, bytes.data() + at * texel_bytes(desc.format));
  }
};

Picture random_picture(int dimension, Format format, unsigned seed) {
  Picture out;
  out.desc.label = "source";
  out.desc.dimension = dimension;
  out.desc.format = format;
  out.desc.width = 7;  // odd sizes: rows are not aligned to 4 bytes
  out.desc.height = dimension > 1 ? 5 : 1;
  out.desc.depth = dimension > 2 ? 3 : 1;
  const size_t texels = static_cast<size_t>(out.desc.width * out.desc.height * out.desc.depth);
  out.bytes.resize(texels * texel_bytes(format));
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(0, 1);
  for (size_t i = 0; i < texels; ++i) {
    encode_texel(format, {value(random), value(random), value(random), value(random)},
                 out.bytes.data() + i * texel_bytes(format));
  }
  return out;
}

// One axis of a look-up: up to two texels (-1 = border) and their weights.
struct Taps {
  int index[2];
  double weight[2];
};
Taps taps(double u, int n, Sampler sampler) {
  const auto wrapped = [&](int i) {
    if (sampler.wrap == Wrap::Repeat) return ((i % n) + n) % n;
    if (sampler.wrap == Wrap::Clamp) return std::clamp(i, 0, n - 1);
    return i < 0 || i >= n ? -1 : i;
  };
  if (sampler.filter == Filter::Nearest) return {{wrapped(static_cast<int>(std::floor(u * n))), 0}, {1, 0}};
  const double t = u * n - 0.5;
  const int base = static_cast<int>(std::floor(t));
  return {{wrapped(base), wrapped(base + 1)}, {1 - (t - base), t - base}};
}

std::array<double, 4> model(const Picture& picture, const std::array<double, 3>& u, Sampler sampler) {
  const Taps x = taps(u[0], picture.desc.width, sampler);
  const Taps none{{0, 0}, {1, 0}};
  const Taps y = picture.desc.dimension > 1 ? taps(u[1], picture.desc.height, sampler) : none;
  const Taps z = picture.desc.dimension > 2 ? taps(u[2], picture.desc.depth, sampler) : none;
  std::array<double, 4> out{};
  for (int i = 0; i < 8; ++i) {
    const int a = i & 1, b = i >> 1 & 1, c = i >> 2;
    const double weight = x.weight[a] * y.weight[b] * z.weight[c];
    if (weight == 0) continue;
    const bool border = x.index[a] < 0 || y.index[b] < 0 || z.index[c] < 0;
    // The border is transparent black; channels that a format lacks read as 0, and alpha as 1, also there.
    std::array<float, 4> texel{0, 0, 0, channel_count(picture.desc.format) < 4 ? 1.f : 0.f};
    if (!border) texel = picture.texel(x.index[a], y.index[b], z.index[c]);
    for (size_t k = 0; k < 4; ++k) out[k] += weight * static_cast<double>(texel[k]);
  }
  return out;
}

constexpr int kTargetWidth = 61, kTargetHeight = 17;

// Texture coordinates of a pixel: affine over the screen, from outside to outside the texture.
std::array<double, 3> coordinates(int px, int py) {
  const double s = (px + 0.5) / kTargetWidth, t = (py + 0.5) / kTargetHeight;
  return {-0.7 + 2.3 * s, -0.6 + 2.1 * t + 0.11 * s, 0.2 * s + 1.3 * t - 0.3};
}

// Filter weights have 8 fraction bits at least on hardware; the software drivers compute in float.
double tolerance(const BackendInfo& info, Format format) {
  const double filter = info.software ? 4e-6 : 2.0 / 256;
  return filter + (format == Format::R16F || format == Format::RGBA16F ? 1e-6 : 0);
}

void check(Canvas& canvas, Pipeline pipeline, const Picture& picture, Texture texture, Sampler sampler) {
  std::vector<Vertex> corners;
  for (const Vertex& corner : screen({})) {
    const double s = (corner.position[0] + 1) / 2, t = (1 - corner.position[1]) / 2;
    const std::array<double, 3> u{-0.7 + 2.3 * s, -0.6 + 2.1 * t + 0.11 * s, 0.2 * s + 1.3 * t - 0.3};
    Vertex vertex = corner;
    for (size_t c = 0; c < 3; ++c) vertex.colour[c] = static_cast<float>(u[c]);
    corners.push_back(vertex);
  }
  canvas.begin();
  canvas.draw(pipeline, corners, {bind_sampled(1, texture, sampler)});
  canvas.end();
  const auto texels = canvas.read();
  const double bound = tolerance(canvas.device.info(), picture.desc.format);
  double worst = 0;
  for (int y = 0; y < kTargetHeight; ++y) {
    for (int x = 0; x < kTargetWidth; ++x) {
      const auto u = coordinates(x, y);
      bool at_step = false;  // nearest, within rounding of a texel's edge: either neighbour is right
      const int extents[3] = {picture.desc.width, picture.desc.height, picture.desc.depth};
      for (int axis = 0; axis < picture.desc.dimension; ++axis) {
        const double place = u[static_cast<size_t>(axis)] * extents[axis];
        at_step |= std::abs(place - std::nearbyint(place)) < 1e-4;
      }
      if (sampler.filter == Filter::Nearest && at_step) continue;
      const auto want = model(picture, u, sampler);
      for (size_t c = 0; c < 4; ++c) {
        worst = std::max(worst, std::abs(want[c] - static_cast<double>(canvas.at(texels, x, y)[c])));
      }
    }
  }
  EXPECT_LE(worst, bound) << to_string(picture.desc.format) << ' ' << picture.desc.dimension << "D, filter "
                          << static_cast<int>(sampler.filter) << ", wrap " << static_cast<int>(sampler.wrap);
}

class Textures : public testing::TestWithParam<int> {};

TEST_P(Textures, EveryFormatFilterAndWrap) {
  const int dimension = GetParam();
  Canvas canvas(kTargetWidth, kTargetHeight);
  const auto kind = dimension == 1 ? Kind::Sample1D : dimension == 2 ? Kind::Sample2D : Kind::Sample3D;
  const auto pipeline = canvas.pipeline(kind);
  for (const Format format : kFormats) {
    Picture picture = random_picture(dimension, format, 11u + static_cast<unsigned>(format));
    TextureDesc desc = picture.desc;
    desc.data = picture.bytes;
    const Texture texture = canvas.device.create_texture(desc);
    for (const Filter filter : {Filter::Nearest, Filter::Linear}) {
      for (const Wrap wrap : {Wrap::Clamp, Wrap::Border, Wrap::Repeat}) {
        check(canvas, pipeline, picture, texture, {filter, wrap});
      }
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Dimension, Textures, testing::Values(1, 2, 3));

TEST(TextureData, ReadsBackAsWritten) {
  Canvas canvas(2, 2);
  for (int dimension = 1; dimension <= 3; ++dimension) {
    for (const Format format : kFormats) {
      Picture picture = random_picture(dimension, format, 5);
      TextureDesc desc = picture.desc;
      desc.data = picture.bytes;
      EXPECT_EQ(canvas.device.read_texture(canvas.device.create_texture(desc)), picture.bytes)
          << to_string(format) << ' ' << dimension;
    }
  }
}

TEST(TextureData, WithoutDataIsZero) {
  Canvas canvas(2, 2);
  for (const Format format : kFormats) {
    const Texture texture = canvas.device.create_texture(
        {.label = "empty", .dimension = 3, .format = format, .width = 9, .height = 4, .depth = 3});
    for (const std::byte byte : canvas.device.read_texture(texture)) ASSERT_EQ(byte, std::byte{0});
  }
}

TEST(TextureData, APictureDrawnCanBeSampled) {
  Canvas canvas(4, 4);
  const auto flat = canvas.pipeline(Kind::Flat);
  const auto copy = canvas.pipeline(Kind::Sample2D);
  const Texture first = canvas.pass.colour;
  canvas.begin();
  canvas.draw(flat, rectangle(-1, 0, 1, 1, {0.25f, 0.5f, 0.75f, 1}));  // the upper half
  canvas.end();
  canvas.pass.colour = canvas.device.create_texture({.label = "second", .width = 4, .height = 4, .target = true});
  std::vector<Vertex> corners;
  for (Vertex vertex : screen({})) {
    vertex.colour[0] = (vertex.position[0] + 1) / 2;
    vertex.colour[1] = (1 - vertex.position[1]) / 2;  // v = 0 is row 0, the top
    corners.push_back(vertex);
  }
  canvas.begin();
  canvas.draw(copy, corners, {bind_sampled(1, first, {Filter::Nearest, Wrap::Clamp})});
  canvas.end();
  const auto texels = canvas.read();
  expect_texel(canvas.at(texels, 1, 1), {0.25f, 0.5f, 0.75f, 1});
  expect_texel(canvas.at(texels, 1, 2), {0, 0, 0, 0});
}

}  // namespace
}  // namespace volumark::conformance
