// Where fragments fall: rows, pixel centres, depth range, winding, clipping, and every pixel of a surface once.
#include <cmath>
#include <random>

#include "tests/conformance/fixture.h"

namespace volumark::conformance {
namespace {

constexpr std::array<float, 4> kRed{1, 0, 0, 1};
constexpr std::array<float, 4> kNothing{0, 0, 0, 0};

TEST(Raster, RowZeroIsTheTopRow) {
  Canvas canvas(4, 4);
  const auto pipeline = canvas.pipeline(Kind::Flat);
  canvas.begin();
  canvas.draw(pipeline, rectangle(-1, 0, 1, 1, kRed));  // NDC +y is up
  canvas.end();
  const auto texels = canvas.read();
  for (int x = 0; x < 4; ++x) {
    expect_texel(canvas.at(texels, x, 0), kRed);
    expect_texel(canvas.at(texels, x, 1), kRed);
    expect_texel(canvas.at(texels, x, 2), kNothing);
    expect_texel(canvas.at(texels, x, 3), kNothing);
  }
}

TEST(Raster, WindowCoordinatesArePixelCentresFromTheTopLeft) {
  Canvas canvas(5, 3);
  const auto pipeline = canvas.pipeline(Kind::Window);
  canvas.begin();
  canvas.draw(pipeline, screen(kRed, 0.25f));
  canvas.end();
  const auto texels = canvas.read();
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) {
      const auto got = canvas.at(texels, x, y);
      EXPECT_EQ(got[0], static_cast<float>(x) + 0.5f);
      EXPECT_EQ(got[1], static_cast<float>(y) + 0.5f);
    }
  }
}

TEST(Raster, DepthRangeIsZeroToOne) {
  Canvas canvas(2, 2);
  const auto pipeline = canvas.pipeline(Kind::Window);
  for (const float z : {0.f, 0.25f, 0.75f, 1.f}) {
    canvas.begin();
    canvas.draw(pipeline, screen(kRed, z));
    canvas.end();
    EXPECT_NEAR(canvas.at(canvas.read(), 0, 0)[2], z, 1e-6f);
  }
  for (const float z : {-0.01f, 1.01f}) {
    canvas.begin();
    canvas.draw(pipeline, screen(kRed, z));
    canvas.end();
    expect_texel(canvas.at(canvas.read(), 0, 0), kNothing);
  }
}

TEST(Raster, CounterClockwiseIsTheFront) {
  Canvas canvas(2, 2);
  auto forward = screen(kRed);
  auto backward = forward;
  for (size_t i = 0; i < backward.size(); i += 3) std::swap(backward[i + 1], backward[i + 2]);
  const auto both = canvas.pipeline(Kind::Window);
  const auto no_back = canvas.pipeline(Kind::Window, [](PipelineDesc& desc) { desc.cull = Cull::Back; });
  const auto no_front = canvas.pipeline(Kind::Window, [](PipelineDesc& desc) { desc.cull = Cull::Front; });
  const auto side = [&](Pipeline pipeline, const std::vector<Vertex>& vertices) {
    canvas.begin();
    canvas.draw(pipeline, vertices);
    canvas.end();
    return canvas.at(canvas.read(), 0, 0)[3];
  };
  EXPECT_EQ(side(both, forward), 1.f);
  EXPECT_EQ(side(both, backward), 2.f);
  EXPECT_EQ(side(no_back, forward), 1.f);
  EXPECT_EQ(side(no_back, backward), 0.f);
  EXPECT_EQ(side(no_front, forward), 0.f);
  EXPECT_EQ(side(no_front, backward), 2.f);
}

// A mesh that covers the whole target: a jittered grid, its cells split along either diagonal.
std::vector<Vertex> jittered_grid(int cells, float jitter, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> offset(-jitter, jitter);
  std::vector<Vertex> points;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const auto place = [&](int k) {
        const float grid = 2.f * static_cast<float>(k) / static_cast<float>(cells) - 1.f;
        return k == 0 || k == cells ? grid * 1.25f : grid + offset(random);
      };
      const float x = place(i), y = place(j);
      points.push_back({{x, y, 0.5f, 1}, {1, 1, 1, 1}});
    }
  }
  std::vector<Vertex> triangles;
  const auto at = [&](int i, int j) { return points[static_cast<size_t>(j * (cells + 1) + i)]; };
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const Vertex a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      const bool flip = ((i * 7 + j * 3 + static_cast<int>(seed)) & 1) != 0;
      const std::array<Vertex, 6> two = flip ? std::array{a, b, d, b, c, d} : std::array{a, b, c, a, c, d};
      triangles.insert(triangles.end(), two.begin(), two.end());
    }
  }
  return triangles;
}

void expect_every_pixel_once(Canvas& canvas, const std::vector<Vertex>& triangles, int width, int height) {
  const auto pipeline = canvas.pipeline(Kind::Flat, [](PipelineDesc& desc) { desc.blend = Blend::Add; });
  canvas.begin();
  canvas.draw(pipeline, triangles);
  canvas.end();
  const auto texels = canvas.read();
  int wrong = 0;
  for (const auto& texel : texels) wrong += texel[0] != 1.f;
  EXPECT_EQ(wrong, 0) << "of " << width * height << " pixels";
}

TEST(Raster, SharedEdgesDrawEveryPixelOnce) {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    Canvas canvas(96, 64);
    expect_every_pixel_once(canvas, jittered_grid(24, 0.03f, seed), 96, 64);
  }
}

TEST(Raster, EdgesThroughPixelCentresDrawEveryPixelOnce) {
  Canvas canvas(16, 16);
  // Vertices on a grid of half pixels: every edge, also the diagonals, runs through pixel centres.
  std::vector<Vertex> triangles;
  const float step = 2.f / 16;
  for (int j = -1; j < 17; ++j) {
    for (int i = -1; i < 17; ++i) {
      const float x = (static_cast<float>(i) + 0.5f) * step - 1, y = (static_cast<float>(j) + 0.5f) * step - 1;
      const auto cell = rectangle(x, y, x + step, y + step, {1, 1, 1, 1});
      triangles.insert(triangles.end(), cell.begin(), cell.end());
    }
  }
  expect_every_pixel_once(canvas, triangles, 16, 16);
}

TEST(Raster, SliversOfAFanDrawEveryPixelOnce) {
  Canvas canvas(64, 64);
  std::vector<Vertex> triangles;
  const int spokes = 720;
  const Vertex centre{{0.013f, -0.021f, 0.5f, 1}, {1, 1, 1, 1}};
  for (int i = 0; i < spokes; ++i) {
    const auto rim = [&](int k) {
      const double angle = 2 * M_PI * (k % spokes) / spokes;
      return Vertex{{static_cast<float>(3 * std::cos(angle)), static_cast<float>(3 * std::sin(angle)), 0.5f, 1},
                    {1, 1, 1, 1}};
    };
    for (const Vertex& vertex : {centre, rim(i), rim(i + 1)}) triangles.push_back(vertex);
  }
  expect_every_pixel_once(canvas, triangles, 64, 64);
}

TEST(Raster, VaryingsArePerspectiveCorrect) {
  Canvas canvas(64, 1);
  // A screen-filling quad whose left side has w = 1 and right side w = 4: colour u runs 0 to 1 in eye space.
  const auto vertex = [](float x, float y, float w, float u) {
    return Vertex{{x * w, y * w, 0.5f * w, w}, {u, 0, 0, 1}};
  };
  const auto pipeline = canvas.pipeline(Kind::Flat);
  canvas.begin();
  canvas.draw(pipeline, {vertex(-1, -1, 1, 0), vertex(1, -1, 4, 1), vertex(1, 1, 4, 1), vertex(-1, -1, 1, 0),
                         vertex(1, 1, 4, 1), vertex(-1, 1, 1, 0)});
  canvas.end();
  const auto texels = canvas.read();
  for (int x = 0; x < 64; ++x) {
    const double s = (x + 0.5) / 64;
    const double expected = (s / 4) / ((1 - s) / 1 + s / 4);
    EXPECT_NEAR(canvas.at(texels, x, 0)[0], expected, 2e-5) << x;
  }
}

TEST(Raster, TrianglesThroughTheEyePlaneAreClipped) {
  Canvas canvas(32, 32);
  // A floor that passes under the eye to behind it, w = -2 .. 2 along depth: only w > 0, z in [0, w] is drawn.
  const auto vertex = [](float x, float w) { return Vertex{{x, -1, 0.5f * w, w}, {1, 1, 1, 1}}; };
  const auto pipeline = canvas.pipeline(Kind::Flat, [](PipelineDesc& desc) { desc.blend = Blend::Add; });
  canvas.begin();
  canvas.draw(pipeline,
              {vertex(-30, -2), vertex(30, -2), vertex(30, 2), vertex(-30, -2), vertex(30, 2), vertex(-30, 2)});
  canvas.end();
  const auto texels = canvas.read();
  // y_ndc = -1 / w: rows below y_ndc = -1/2 (w = 2) are covered, the rest is not.
  for (int y = 0; y < 32; ++y) {
    const float ndc = 1 - 2 * (static_cast<float>(y) + 0.5f) / 32;
    for (int x = 0; x < 32; ++x) EXPECT_EQ(canvas.at(texels, x, y)[0], ndc < -0.5f ? 1.f : 0.f) << x << ' ' << y;
  }
}

TEST(Raster, HugeTrianglesCoverExactly) {
  Canvas canvas(33, 17);
  const auto pipeline = canvas.pipeline(Kind::Flat, [](PipelineDesc& desc) { desc.blend = Blend::Add; });
  canvas.begin();
  canvas.draw(
      pipeline,
      {{{-1, -1, 0.5f, 1}, {1, 1, 1, 1}}, {{3e5f, -1, 0.5f, 1}, {1, 1, 1, 1}}, {{-1, 3e5f, 0.5f, 1}, {1, 1, 1, 1}}});
  canvas.end();
  for (const auto& texel : canvas.read()) EXPECT_EQ(texel[0], 1.f);
}

TEST(Raster, DegenerateAndNonFiniteTrianglesDrawNothing) {
  Canvas canvas(8, 8);
  const auto pipeline = canvas.pipeline(Kind::Flat);
  const Vertex a{{-0.5f, -0.5f, 0.5f, 1}, {1, 1, 1, 1}}, b{{0.5f, 0.5f, 0.5f, 1}, {1, 1, 1, 1}};
  const Vertex zero{{0, 0, 0, 0}, {1, 1, 1, 1}};
  canvas.begin();
  canvas.draw(pipeline, {a, b, b, a, a, a, zero, zero, zero});
  canvas.end();
  for (const auto& texel : canvas.read()) expect_texel(texel, kNothing);
}

TEST(Raster, PointsAndLines) {
  Canvas canvas(8, 8);
  const auto points = canvas.pipeline(Kind::Flat, [](PipelineDesc& desc) { desc.topology = Topology::Points; });
  const auto lines = canvas.pipeline(Kind::Flat, [](PipelineDesc& desc) { desc.topology = Topology::Lines; });
  const auto ndc = [](float pixel) { return 2 * (pixel + 0.5f) / 8 - 1; };
  const auto vertex = [&](float x, float row) { return Vertex{{ndc(x), -ndc(row), 0.5f, 1}, {1, 0, 0, 1}}; };
  canvas.begin();
  canvas.draw(points, {vertex(2, 1)});
  canvas.draw(lines, {vertex(1, 4), vertex(6, 4)});
  canvas.end();
  const auto texels = canvas.read();
  expect_texel(canvas.at(texels, 2, 1), kRed);
  for (int x = 2; x < 6; ++x) expect_texel(canvas.at(texels, x, 4), kRed);  // the ends are the driver's choice
  int covered = 0;
  for (const auto& texel : texels) covered += texel[0] != 0;
  EXPECT_GE(covered, 5);
  EXPECT_LE(covered, 7);
}

TEST(Raster, StripsDrawEveryPixelOnce) {
  Canvas canvas(16, 16);
  const auto strip = canvas.pipeline(Kind::Window, [](PipelineDesc& desc) {
    desc.topology = Topology::TriangleStrip;
    desc.cull = Cull::Back;  // every other triangle of a strip is turned: all must count as front faces
    desc.blend = Blend::Add;
  });
  canvas.begin();
  canvas.draw(strip, {{{-1, -1, 0.5f, 1}, {}},
                      {{1, -1, 0.5f, 1}, {}},
                      {{-1, 0, 0.5f, 1}, {}},
                      {{1, 0, 0.5f, 1}, {}},
                      {{-1, 1, 0.5f, 1}, {}},
                      {{1, 1, 0.5f, 1}, {}}});
  canvas.end();
  for (const auto& texel : canvas.read()) EXPECT_EQ(texel[3], 1.f);
}

}  // namespace
}  // namespace volumark::conformance
